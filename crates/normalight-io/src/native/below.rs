//! Where photographs are when there are none in a folder.
use super::files::{display, file_name, read_error};
use crate::IoError;
use crate::limits::MAX_FILES;
use crate::plan::{is_helper, plan_stack};
use normalight_core::MIN_IMAGES;
use std::fs;
use std::path::{Path, PathBuf};

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
            // A list there may be wrong: that is said when the folder is given.
            let photographs = plan_stack(&files, None).map_or(0, |plan| plan.images.len());
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
pub(super) fn one_in_each(folder: &Path) -> std::io::Result<Option<Vec<PathBuf>>> {
    let (names, folders) = entries(folder)?;
    let photographs =
        |names: &[String]| plan_stack(names, None).map_or(0, |plan| plan.images.len());
    let folders: Vec<PathBuf> = folders
        .into_iter()
        .filter(|path| !is_helper(&file_name(path)))
        .collect();
    if photographs(&names) > 0 || folders.len() < MIN_IMAGES || folders.len() > MAX_FILES {
        return Ok(None);
    }
    let mut paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
    for below in folders {
        let (names, _) = entries(&below)?;
        if photographs(&names) != 1 {
            return Ok(None);
        }
        paths.extend(names.iter().map(|name| below.join(name)));
    }
    Ok((paths.len() <= MAX_FILES).then_some(paths))
}

/// Names of the files in a folder, and paths of the folders; links to folders are not followed, which may be circles.
fn entries(folder: &Path) -> std::io::Result<(Vec<String>, Vec<PathBuf>)> {
    let (mut files, mut folders) = (Vec::new(), Vec::new());
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_type()?.is_dir() {
            folders.push(path);
        } else if path.is_file() {
            files.push(file_name(&path));
        }
    }
    Ok((files, folders))
}
