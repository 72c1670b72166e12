//! The folders of a tree, each with the files in it.
use crate::{BatchError, PassedOver, PassedOverReason};
use normalight_io::is_helper;
use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use walkdir::{DirEntry, WalkDir};

/// A folder of a tree.
#[derive(Debug, Default)]
pub(crate) struct Folder {
    /// Its path below the root; empty for the root.
    pub(crate) path: PathBuf,
    /// Names of the files, links to files among them.
    pub(crate) files: Vec<OsString>,
    /// Positions of the folders in it among all folders.
    pub(crate) folders: Vec<usize>,
}

/// All folders below a root, itself first, and what cannot be looked at. Links to folders are not followed: they may be
/// circles, or lead to the same captures again. Hidden folders and those of operating systems are nobody's concern.
///
/// # Errors
/// [`BatchError::Read`] for the root itself.
pub(crate) fn walk(root: &Path) -> Result<(Vec<Folder>, Vec<PassedOver>), BatchError> {
    let mut folders = vec![Folder::default()];
    let mut passed_over = Vec::new();
    // Positions of the folders on the way down to the entry at hand, one for each step.
    let mut way = vec![0];
    let is_meant = |entry: &DirEntry| {
        entry.depth() == 0
            || !entry.file_type().is_dir()
            || !is_helper(&entry.file_name().to_string_lossy())
    };
    for entry in WalkDir::new(root).into_iter().filter_entry(is_meant) {
        let entry = match entry {
            Ok(entry) => entry,
            Err(error) if error.depth() == 0 => {
                return Err(BatchError::Read {
                    path: root.to_owned(),
                    reason: error.into(),
                });
            }
            Err(error) => {
                let path = error.path().unwrap_or(root);
                passed_over.push(PassedOver {
                    path: below(root, path),
                    reason: PassedOverReason::Unreadable(reason_of(error)),
                });
                continue;
            }
        };
        let depth = entry.depth();
        if depth == 0 {
            continue;
        }
        way.truncate(depth);
        let above = way[depth - 1];
        if entry.file_type().is_dir() {
            let position = folders.len();
            folders[above].folders.push(position);
            way.push(position);
            folders.push(Folder {
                path: below(root, entry.path()),
                ..Folder::default()
            });
            continue;
        }
        let is_file = match entry.file_type().is_symlink() {
            false => entry.file_type().is_file(),
            true => match fs::metadata(entry.path()) {
                Ok(behind) if behind.is_dir() => {
                    passed_over.push(PassedOver {
                        path: below(root, entry.path()),
                        reason: PassedOverReason::LinkToFolder,
                    });
                    false
                }
                Ok(behind) => behind.is_file(),
                Err(error) => {
                    passed_over.push(PassedOver {
                        path: below(root, entry.path()),
                        reason: PassedOverReason::Unreadable(error.to_string()),
                    });
                    false
                }
            },
        };
        if is_file {
            folders[above].files.push(entry.file_name().to_owned());
        }
    }
    for folder in &mut folders {
        // The system hands names out in any order.
        folder.files.sort();
    }
    Ok((folders, passed_over))
}

fn below(root: &Path, path: &Path) -> PathBuf {
    path.strip_prefix(root).unwrap_or(path).to_owned()
}

/// What the system said, without the path, which stands elsewhere.
fn reason_of(error: walkdir::Error) -> String {
    match error.io_error() {
        Some(reason) => reason.to_string(),
        None => io::Error::from(error).to_string(),
    }
}
