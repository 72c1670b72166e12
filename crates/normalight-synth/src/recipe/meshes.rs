use super::ranges::number;
use crate::SynthError;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Meshes that are drawn from together: a folder, or a list of chosen files. Lists of one category each
/// give weights to categories.
///
/// ```toml
/// mesh_folders = [{ path = "statues" }, { path = "vessels.txt", weight = 0.5 }]
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshFolder {
    /// A folder of OBJ, PLY and GLB files and of folders of them; or a text file with the path of one mesh a
    /// line, relative to itself.
    pub path: PathBuf,
    /// Weight among the other folders, whatever the number of meshes in it; within it all are drawn equally
    /// often.
    #[serde(default = "one")]
    pub weight: f32,
}

impl MeshFolder {
    /// Of weight 1.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        let (path, weight) = (path.into(), one());
        Self { path, weight }
    }

    /// Checks the weights of folders that are drawn from together.
    pub(super) fn validate(field: &'static str, folders: &[Self]) -> Result<(), SynthError> {
        for folder in folders {
            number(field, folder.weight, 0.0, 1e6, "a weight in 0..=1000000")?;
        }
        if !folders.is_empty() && folders.iter().all(|folder| folder.weight == 0.0) {
            return Err(SynthError::NoWeight { field });
        }
        Ok(())
    }
}

fn one() -> f32 {
    1.0
}
