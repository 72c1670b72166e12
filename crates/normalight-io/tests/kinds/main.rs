//! Kinds of images that programs write, made here byte by byte.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
#[path = "../common/mod.rs"]
mod common;

mod color;
mod exr;
mod jpeg;
mod limits;
mod moving;
mod portable;
mod stacks;
mod tiff;
mod unread;
mod writer;

use normalight_io::{ColorMode, DecodedImage, IoError, decode_image};

fn decode(name: &str, bytes: &[u8]) -> Result<DecodedImage, IoError> {
    decode_image(name, bytes, ColorMode::Auto)
}
