use super::inside::read_file_inside;
use crate::limits::MAX_FILE_BYTES;
use crate::{IoError, NamedBytes};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Reads a file as [`NamedBytes`], for example a mask that was given. The path may lead into an
/// archive: `capture.zip/mask.png`.
///
/// # Errors
/// [`IoError::Read`], [`IoError::FileTooLarge`] or [`IoError::Archive`].
pub fn read_named(path: &Path) -> Result<NamedBytes, IoError> {
    Ok(NamedBytes {
        name: file_name(path),
        bytes: read_file(path, MAX_FILE_BYTES)?,
    })
}

/// Content of a file of at most `limit` bytes; the path may lead into an archive.
pub(crate) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, IoError> {
    let failed = |reason| read_error(path, reason);
    let file = match File::open(path) {
        Ok(file) => file,
        Err(reason) => {
            let inside = read_file_inside(path, limit);
            return inside.unwrap_or_else(|| Err(failed(reason)));
        }
    };
    let found = file.metadata().map_err(failed)?.len();
    let too_large = |found| IoError::FileTooLarge {
        name: display(path),
        found,
        limit,
    };
    if found > limit {
        return Err(too_large(found));
    }
    let mut bytes = Vec::with_capacity(found as usize);
    // Pipes and growing files do not tell their size.
    file.take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(too_large(bytes.len() as u64));
    }
    Ok(bytes)
}

pub(crate) fn display(path: &Path) -> String {
    path.display().to_string()
}

pub(crate) fn file_name(path: &Path) -> String {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

pub(crate) fn read_error(path: &Path, reason: io::Error) -> IoError {
    IoError::Read {
        name: display(path),
        reason,
    }
}
