//! How much is read: in one place, as a value that is passed down.
use crate::IoError;
use serde::{Deserialize, Serialize};

/// Most pixels of one image: 100 megapixels, above any camera a phone or a studio uses for this. Under
/// the fuzzer it is one, so that memory or time beyond the limit stands out.
pub const MAX_PIXELS: u64 = if cfg!(fuzzing) { 1 << 20 } else { 100_000_000 };

/// Largest file that is read: 2 GiB, above the largest uncompressed image within [`MAX_PIXELS`].
pub const MAX_FILE_BYTES: u64 = 2 << 30;

/// Largest text file (lists, lights) that is read: 4 MiB.
pub const MAX_TEXT_BYTES: u64 = 4 << 20;

/// Most bytes that the samples of one stack may take: 32 GiB, and 2 GiB where addresses have 32
/// bits (the browser).
pub const MAX_STACK_BYTES: u64 = if usize::BITS > 32 { 32 << 30 } else { 2 << 30 };

/// Most files of one input, images or not: above any dome, any folder of a camera and any set.
pub const MAX_FILES: usize = 100_000;

/// Largest mesh file that is read: 256 MiB, above the largest text of as many triangles as are
/// taken.
pub const MAX_MESH_BYTES: u64 = 256 << 20;

/// Most vertices of one mesh: as many as its triangles can use.
pub(crate) const MAX_MESH_VERTICES: usize = 3 * normalight_core::MAX_TRIANGLES;

/// Most entries of an archive, folders included.
pub const MAX_ARCHIVE_FILES: usize = 10_000;

/// Most bytes that an archive may unpack to: as many as the samples of a stack may take.
pub const MAX_ARCHIVE_BYTES: u64 = MAX_STACK_BYTES;

/// How many times its own size an archive may unpack to. Photographs shrink little; renderings on
/// black, stored without compression of their own, shrink some fifty times.
pub const MAX_ARCHIVE_RATIO: u64 = 200;

/// Unpacked bytes that no ratio is asked of: a handful of empty masks shrinks a thousand times.
pub(crate) const ARCHIVE_BYTES_AT_ANY_RATIO: u64 = 16 << 20;

/// Most bytes between two files of a tar archive: headers, long names and attributes.
pub(crate) const MAX_TAR_HEADER_BYTES: u64 = 1 << 20;
/// How much of photographs is read, for the command and the page alike. The defaults are the
/// constants beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Limits {
    /// Most pixels of one image ([`MAX_PIXELS`]).
    pub pixels: u64,
    /// Largest image file, in bytes ([`MAX_FILE_BYTES`]).
    pub file_bytes: u64,
    /// Largest list or light file, in bytes ([`MAX_TEXT_BYTES`]).
    pub text_bytes: u64,
    /// Most bytes of all samples of a stack ([`MAX_STACK_BYTES`]).
    pub stack_bytes: u64,
    /// Most files of one input ([`MAX_FILES`]).
    pub files: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            pixels: MAX_PIXELS,
            file_bytes: MAX_FILE_BYTES,
            text_bytes: MAX_TEXT_BYTES,
            stack_bytes: MAX_STACK_BYTES,
            files: MAX_FILES,
        }
    }
}

impl Limits {
    /// # Errors
    /// [`IoError::TooManyFiles`].
    pub(crate) fn check_files(&self, place: &str, found: usize) -> Result<(), IoError> {
        match found > self.files {
            true => Err(IoError::TooManyFiles {
                name: place.to_owned(),
                found,
                limit: self.files,
            }),
            false => Ok(()),
        }
    }

    /// Most bytes that decoding one image may take, output and scratch: the largest image in
    /// floating-point RGBA, and a quarter more.
    pub(crate) fn decode_bytes(&self) -> u64 {
        self.pixels.saturating_mul(20)
    }
}
