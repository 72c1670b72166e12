//! Where photographs are when there are none in a folder.
use super::files::{display, file_name, read_error};
use crate::IoError;
use crate::limits::MAX_FILES;
use crate::plan::{is_helper, plan_stack};
use normalight_core::MIN_IMAGES;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// How many folders down are looked at: projects of RTI programs need one or two.
const DEEP: usize = 3;

/// An error that says where photographs lie below a folder, or that there is nothing in it.
pub(super) fn look_below(folder: &Path) -> Result<(), IoError> {
    let (files, folders) = entries(folder).map_err(|reason| read_error(folder, reason))?;
    let mut below = Vec::new();
    let (mut seen, mut level) = (0, folders.clone());
    for _ in 0..DEEP {
        let mut next = Vec::new();
        for path in level {
            // What cannot be read holds nothing for us.
            let Ok((files, folders)) = entries(&path) else {
                continue;
            };
            seen += files.len() + folders.len();
            if seen > MAX_FILES {
                break;
            }
            let photographs = photographs(&files);
            if photographs > 0 {
                let place = path.strip_prefix(folder).unwrap_or(&path);
                below.push(format!("{photographs} in {}", place.display()));
            }
            next.extend(folders);
        }
        level = next;
    }
    below.sort();
    let name = display(folder);
    if !below.is_empty() {
        let below = below.join(", ");
        return Err(IoError::PhotographsBelow { name, below });
    }
    if files.is_empty() {
        let folders = folders.len();
        return Err(IoError::NothingHere {
            name,
            folders,
            expected: MIN_IMAGES,
        });
    }
    Ok(())
}

/// The files in a folder without photographs and in the folders in it, where each of those holds one photograph: one
/// folder for each light.
pub(super) fn one_in_each(
    files: &[PathBuf],
    folders: &[PathBuf],
) -> io::Result<Option<Vec<PathBuf>>> {
    let folders: Vec<&PathBuf> = folders
        .iter()
        .filter(|path| !is_helper(&file_name(path)))
        .collect();
    if folders.len() < MIN_IMAGES || folders.len() > MAX_FILES || photographs(files) > 0 {
        return Ok(None);
    }
    let mut paths = files.to_vec();
    for below in folders {
        let (files, _) = entries(below)?;
        if photographs(&files) != 1 {
            return Ok(None);
        }
        paths.extend(files);
    }
    Ok((paths.len() <= MAX_FILES).then_some(paths))
}

/// How many of some files are photographs by their names. A list there may be wrong: that is said when the folder is given.
fn photographs(files: &[PathBuf]) -> usize {
    let names: Vec<String> = files.iter().map(|path| file_name(path)).collect();
    plan_stack(&names, None).map_or(0, |plan| plan.images.len())
}

/// Paths of the files in a folder, and of the folders; links to folders are not followed, which may be circles.
pub(super) fn entries(folder: &Path) -> io::Result<(Vec<PathBuf>, Vec<PathBuf>)> {
    let (mut files, mut folders) = (Vec::new(), Vec::new());
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_type()?.is_dir() {
            folders.push(path);
        } else if path.is_file() {
            files.push(path);
        }
    }
    Ok((files, folders))
}
