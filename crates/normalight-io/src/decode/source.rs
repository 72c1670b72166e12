//! A file that is being decoded, with the errors that name it.
use crate::{IoError, Limits};

/// A file that is being decoded.
pub(super) struct Source<'a> {
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    /// How people call its format.
    pub(super) format: &'static str,
    pub(super) limits: &'a Limits,
}

impl Source<'_> {
    /// The file is damaged or cut off.
    pub(super) fn damaged(&self, reason: impl Into<String>) -> IoError {
        // Decoders quote what they found, which may be long and of any letters.
        let reason: String = reason.into().chars().take(200).collect();
        IoError::Decode {
            name: self.name.to_owned(),
            format: self.format,
            reason: reason.replace(char::is_control, " "),
        }
    }

    /// The file is whole but of a variant that is not read; `instead` says what to do.
    pub(super) fn unread(&self, found: impl Into<String>, instead: &'static str) -> IoError {
        IoError::Unread {
            name: self.name.to_owned(),
            format: self.format,
            found: found.into(),
            instead,
        }
    }

    /// The decoder would need more memory than the limits grant.
    pub(super) fn too_much_memory(&self) -> IoError {
        self.damaged(format!(
            "it needs too much memory; images of at most {} pixels are read",
            self.limits.pixels
        ))
    }

    /// Checks a size before anything is allocated for it.
    pub(super) fn check_size(&self, width: u32, height: u32) -> Result<(), IoError> {
        match u64::from(width) * u64::from(height) {
            0 => Err(self.damaged(format!("it has {width}x{height} pixels"))),
            pixels if pixels > self.limits.pixels => Err(IoError::TooManyPixels {
                name: self.name.to_owned(),
                width,
                height,
                limit: self.limits.pixels,
            }),
            _ => Ok(()),
        }
    }
}
