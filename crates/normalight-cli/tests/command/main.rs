//! The command as people and scripts call it. One program, since each would be compiled with all that it uses.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod average;
mod bad_input;
mod batch;
mod common;
mod devices;
mod estimate;
mod evaluate;
mod inputs;
#[cfg(unix)]
mod interrupt;
mod render;
mod report;
mod search;
mod train;
