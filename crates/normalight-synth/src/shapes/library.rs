use super::mesh::Mesh;
use crate::SynthError;
use crate::random::Random;
use crate::recipe::MeshFolder;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The meshes of a recipe, in folders of different weight.
#[derive(Debug, Clone, Default)]
pub(crate) struct Library(Vec<Folder>);

/// Never empty, and of positive weight.
#[derive(Debug, Clone)]
struct Folder {
    weight: f32,
    meshes: Vec<Arc<Mesh>>,
}

impl Library {
    /// Reads the meshes of all folders of positive weight; `crease`: angle in degrees above which faces
    /// meet in an edge.
    ///
    /// # Errors
    /// A folder without meshes, a file that cannot be read or is not a mesh.
    pub(crate) fn read(folders: &[MeshFolder], crease: f32) -> Result<Self, SynthError> {
        let used = folders.iter().filter(|folder| folder.weight > 0.0);
        let read = |folder: &MeshFolder| {
            let files = normalight_io::mesh_files(&folder.path)?;
            Ok(Folder {
                weight: folder.weight,
                meshes: read_all(&files, crease)?,
            })
        };
        Ok(Self(used.map(read).collect::<Result<_, SynthError>>()?))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Number of meshes.
    pub(crate) fn len(&self) -> usize {
        self.0.iter().map(|folder| folder.meshes.len()).sum()
    }

    /// A folder by its weight, then any of its meshes; `None` when there are none.
    pub(crate) fn draw(&self, random: &mut Random) -> Option<&Mesh> {
        let weights: Vec<f32> = self.0.iter().map(|folder| folder.weight).collect();
        if weights.is_empty() {
            return None;
        }
        let folder = &self.0[random.weighted(&weights)];
        Some(&folder.meshes[random.below(folder.meshes.len())])
    }

    /// Every second mesh, counted through all folders: `half` is 0 or 1.
    pub(crate) fn half(&self, half: usize) -> Self {
        let mut number = 0;
        let mut ours = || {
            number += 1;
            (number - 1) % 2 == half
        };
        let folders = self.0.iter().map(|folder| Folder {
            weight: folder.weight,
            meshes: folder.meshes.iter().filter(|_| ours()).cloned().collect(),
        });
        Self(folders.filter(|folder| !folder.meshes.is_empty()).collect())
    }
}

/// Reads on all cores: hundreds of scans take seconds.
fn read_all(files: &[PathBuf], crease: f32) -> Result<Vec<Arc<Mesh>>, SynthError> {
    let read = |file: &PathBuf| -> Result<Arc<Mesh>, SynthError> {
        let mesh = normalight_io::read_mesh_file(file)?;
        Ok(Arc::new(Mesh::new(mesh, crease)))
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let share = files.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        let parts: Vec<_> = files
            .chunks(share)
            .map(|files| scope.spawn(move || files.iter().map(read).collect::<Result<Vec<_>, _>>()))
            .collect();
        let mut meshes = Vec::with_capacity(files.len());
        for part in parts {
            let part = part
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            meshes.extend(part?);
        }
        Ok(meshes)
    })
}

/// Fails for a file that both lists of folders hold, by whatever path.
///
/// # Errors
/// A file that is in both lists; a folder that cannot be read.
pub(crate) fn check_apart(
    training: &[MeshFolder],
    validation: &[MeshFolder],
) -> Result<(), SynthError> {
    let seen: HashSet<PathBuf> = files_of(training)?.collect();
    match files_of(validation)?.find(|file| seen.contains(file)) {
        None => Ok(()),
        Some(file) => Err(SynthError::OutOfRange {
            field: "shapes.validation_meshes",
            found: file.display().to_string(),
            expected: "only meshes that shapes.mesh_folders does not hold",
        }),
    }
}

fn files_of(folders: &[MeshFolder]) -> Result<impl Iterator<Item = PathBuf>, SynthError> {
    let used = folders.iter().filter(|folder| folder.weight > 0.0);
    let files = used.map(|folder| normalight_io::mesh_files(&folder.path));
    let files: Vec<Vec<PathBuf>> = files.collect::<Result<_, _>>()?;
    // A file that is not there is named when it is read.
    let real = |file: PathBuf| Path::canonicalize(&file).unwrap_or(file);
    Ok(files.into_iter().flatten().map(real))
}
