use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A set in the layout of Blobby and Sculpture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedRecipe {
    /// Its folder, where `train_mtrl.txt` lies.
    pub folder: PathBuf,
    /// Which part of it.
    #[serde(default)]
    pub part: PublishedChoice,
}

/// Which part of a published set to train on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PublishedChoice {
    /// All of it: the set's own split, or 99 % and 1 %.
    #[default]
    Train,
    /// As in the paper's search: a tenth of it at 64x64, split by shape.
    Search,
}

/// A folder of rendered scenes, filled when first needed and shared by all runs on the same scenes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CacheRecipe {
    /// The folder; made when missing.
    pub folder: PathBuf,
    /// Number of different scenes; lamps, crops, brightness and cameras still vary from sample to
    /// sample.
    pub scenes: u64,
}
