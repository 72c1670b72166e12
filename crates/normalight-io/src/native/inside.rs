//! Paths that lead into an archive: `capture.zip/photos/1.png`.
use super::disk::DiskFiles;
use super::files::{display, read_error};
use crate::archive::{Archive, ArchiveKind, HEAD, ReadLimits};
use crate::limits::Limits;
use crate::packed::Packed;
use crate::source::{FileSource, LooseFiles};
use crate::{IoError, ReadOptions, StackInput};
use std::io;
use std::path::{Path, PathBuf};

/// The archive that a path leads into, and the way within it; `None` for other paths.
fn split(path: &Path) -> Option<(PathBuf, String)> {
    let archive = path.ancestors().skip(1).find(|above| above.is_file())?;
    let inner = path.strip_prefix(archive).ok()?.components();
    let parts: Vec<_> = inner
        .map(|part| part.as_os_str().to_string_lossy())
        .collect();
    Some((archive.to_owned(), parts.join("/")))
}

/// The stack in a folder of an archive; `None` for a path that leads into none.
pub(super) fn read_folder_inside(
    path: &Path,
    options: &ReadOptions,
) -> Option<Result<StackInput, IoError>> {
    let (archive, folder) = split(path)?;
    let files = DiskFiles::new(vec![archive], Limits::default());
    let missing = || Err(read_error(path, io::ErrorKind::NotFound.into()));
    Some(match Packed::open(Box::new(files), &folder) {
        Ok(Ok(packed)) => packed.read(options),
        Ok(Err(_)) => missing(),
        Err(error) => Err(error),
    })
}

/// The bytes of a file in an archive, at most `limit`; `None` for a path that leads into none.
pub(super) fn read_file_inside(path: &Path, limit: u64) -> Option<Result<Vec<u8>, IoError>> {
    let (archive, inner) = split(path)?;
    let mut files = DiskFiles::new(vec![archive], Limits::default());
    let mut read = || {
        let missing = || read_error(path, io::ErrorKind::NotFound.into());
        let kind = ArchiveKind::of_content(&files.head(0, HEAD)?).ok_or_else(missing)?;
        let mut archive = Archive::open(&display(&files.paths[0]), kind, files.open(0)?)?;
        let index = archive.files.iter().position(|file| *file == inner);
        let limits = ReadLimits {
            most: limit,
            again: false,
        };
        archive.read(index.ok_or_else(missing)?, &limits)
    };
    Some(read())
}
