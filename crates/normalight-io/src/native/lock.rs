use super::write::write_error;
use crate::IoError;
use std::fs::{File, TryLockError};
use std::io::ErrorKind;
use std::path::Path;

/// Makes a file that one process holds at a time, until it closes it; `None` when another one does.
///
/// File systems that know no locks, as some of clusters, hold nobody back.
///
/// # Errors
/// [`IoError::Write`].
pub fn lock_file(path: &Path) -> Result<Option<File>, IoError> {
    let failed = |reason| write_error(path, reason);
    let file = File::create(path).map_err(failed)?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => Ok(Some(file)),
        Err(TryLockError::Error(reason)) => Err(failed(reason)),
    }
}
