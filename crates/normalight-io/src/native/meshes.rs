//! Meshes on a disk.
use super::files::{display, read_error, read_file};
use crate::IoError;
use crate::limits::MAX_MESH_BYTES;
use crate::mesh::{MESH_FORMATS, mesh_format, read_mesh};
use normalight_core::TriangleMesh;
use std::path::{Path, PathBuf};

/// The meshes of a folder (not of folders in it) in the order a person expects: 2 before 10.
///
/// # Errors
/// [`IoError::Read`]; [`IoError::NotAMesh`] for a folder without any.
pub fn mesh_files(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let failed = |reason| read_error(folder, reason);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if mesh_format(&display(&path)).is_some() && path.is_file() {
            files.push(path);
        }
    }
    if files.is_empty() {
        return Err(IoError::NotAMesh {
            name: display(folder),
            found: "a folder without any".to_owned(),
            expected: MESH_FORMATS,
        });
    }
    files.sort_by(|one, other| {
        let by_name = natord::compare_ignore_case(&display(one), &display(other));
        by_name.then_with(|| one.cmp(other))
    });
    Ok(files)
}

/// Reads a mesh file, see [`read_mesh`].
///
/// # Errors
/// [`IoError::Read`] and those of [`read_mesh`]; the file is named with its path.
pub fn read_mesh_file(path: &Path) -> Result<TriangleMesh, IoError> {
    read_mesh(&display(path), &read_file(path, MAX_MESH_BYTES)?)
}
