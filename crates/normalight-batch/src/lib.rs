//! Many captures at once.
//!
//! [`find_captures`] walks a tree and says what in it is a capture; [`run_batch`] has each of them estimated by a process
//! of its own, side by side within a limit of memory, and puts the results into one folder each with the same relative
//! path; [`collect`] makes table and page of what is there.
//!
//! # What lies in the output
//! A result folder holds what `normalight estimate` leaves, two small pictures for the page, and `batch.json`: what it was
//! made of. That file comes last, so where it is, the others are complete. Everything is made in `.batch-work`, a hidden
//! folder of the output, and moved from there; what a killed batch leaves in it goes with the next call. One folder
//! for all leaves nothing to be searched for, and a capture's name may be as long as the file system allows.
//!
//! # Which results are current
//! A result is taken as it is while program, arguments and the photographs are the same: files whose size and times are
//! those of the time before are believed to be the same (on Unix that includes the time of the last change of the file's
//! entry, which nobody sets by hand); of all others the content decides.
//! [`BatchSettings::check_contents`] has every content read.
//!
//! # Several machines
//! Each takes a [`Shard`] of the captures and needs to know nothing of the others. A lock held by the system keeps the
//! same shard from running twice, and batches of another division from running at the same time; it ends with the process
//! and works on network drives that know locks. Where they do not, that is said. The tree should stay as it is while
//! several machines are at it: a further capture moves those after it to other shards.
#![deny(missing_docs)]

mod batch;
mod capture;
mod child;
mod claim;
mod collect;
mod error;
mod find;
mod gate;
mod inputs;
mod install;
mod job;
mod memory;
mod observer;
mod output;
mod page;
mod parent;
mod record;
mod row;
mod settings;
mod shard;
mod table;
mod thumbnails;
mod walk;

pub use batch::run_batch;
pub use capture::{Capture, CaptureKind, Found, PassedOver, PassedOverReason};
pub use collect::collect;
pub use error::BatchError;
pub use find::find_captures;
pub use memory::available_memory;
pub use observer::{BatchObserver, Progress};
pub use parent::{JOB_VARIABLE, end_with_batch};
pub use row::{BatchSummary, Details, Outcome, Row, Stopped};
pub use settings::{BatchSettings, Program};
pub use shard::{Shard, ShardError};
