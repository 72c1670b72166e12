//! Meshes on a disk.
use super::files::{display, read_error, read_file};
use crate::IoError;
use crate::limits::{MAX_MESH_BYTES, MAX_TEXT_BYTES};
use crate::mesh::{MESH_FORMATS, mesh_format, read_mesh};
use normalight_core::TriangleMesh;
use std::path::{Path, PathBuf};

/// Folders within each other that are searched: links may go round in circles.
const MAX_FOLDERS_DEEP: usize = 16;

/// The meshes of a folder and all folders in it, in the order a person expects: 2 before 10; or those of a
/// list, a text file with one path a line, relative to the list, in its order. Empty lines and lines that
/// begin with `#` are passed over.
///
/// # Errors
/// [`IoError::Read`]; [`IoError::NotAMesh`] for a folder or list without any and for a line that names
/// something else; [`IoError::FileTooLarge`] for a list.
pub fn mesh_files(path: &Path) -> Result<Vec<PathBuf>, IoError> {
    let mut files = Vec::new();
    let what = if path.is_dir() {
        search(path, MAX_FOLDERS_DEEP, &mut files)?;
        files.sort_by(|one, other| {
            let by_name = natord::compare_ignore_case(&display(one), &display(other));
            by_name.then_with(|| one.cmp(other))
        });
        "a folder without any"
    } else {
        read_list(path, &mut files)?;
        "a list without any"
    };
    if files.is_empty() {
        return Err(not_a_mesh(path, what));
    }
    Ok(files)
}

fn search(folder: &Path, levels: usize, files: &mut Vec<PathBuf>) -> Result<(), IoError> {
    let failed = |reason| read_error(folder, reason);
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            if levels > 1 {
                search(&path, levels - 1, files)?;
            }
        } else if mesh_format(&display(&path)).is_some() {
            files.push(path);
        }
    }
    Ok(())
}

fn read_list(list: &Path, files: &mut Vec<PathBuf>) -> Result<(), IoError> {
    let bytes = read_file(list, MAX_TEXT_BYTES)?;
    let folder = list.parent().unwrap_or(Path::new(""));
    for line in String::from_utf8_lossy(&bytes).lines().map(str::trim) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if mesh_format(line).is_none() {
            // A picture or a mesh given as a list has long lines.
            let line: String = line.chars().take(80).collect();
            let line = line.replace(char::is_control, " ");
            return Err(not_a_mesh(list, &format!("a list with {line:?}")));
        }
        files.push(folder.join(line));
    }
    Ok(())
}

fn not_a_mesh(path: &Path, found: &str) -> IoError {
    IoError::NotAMesh {
        name: display(path),
        found: found.to_owned(),
        expected: MESH_FORMATS,
    }
}

/// Reads a mesh file, see [`read_mesh`].
///
/// # Errors
/// [`IoError::Read`] and those of [`read_mesh`]; the file is named with its path.
pub fn read_mesh_file(path: &Path) -> Result<TriangleMesh, IoError> {
    read_mesh(&display(path), &read_file(path, MAX_MESH_BYTES)?)
}
