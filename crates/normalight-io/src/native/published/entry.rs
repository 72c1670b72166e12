use crate::IoError;
use std::fmt;
use std::path::{Path, PathBuf};

/// A shape in a material: one line of a set's lists.
///
/// Both are plain names, so that no entry leads out of its set.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PublishedEntry {
    shape: String,
    material: String,
}

impl PublishedEntry {
    /// An entry of two plain names.
    ///
    /// # Errors
    /// [`IoError::SetFormat`] for names that are empty, `.` or `..`, or hold a slash, a backslash,
    /// a colon or a control character.
    pub fn new(shape: &str, material: &str) -> Result<Self, IoError> {
        match [shape, material].into_iter().find(|name| !is_plain(name)) {
            Some(name) => Err(IoError::SetFormat {
                name: format!("{shape}/{material}"),
                found: format!("{name:?}"),
                expected: "the plain name of a folder".to_owned(),
            }),
            None => Ok(Self {
                shape: shape.to_owned(),
                material: material.to_owned(),
            }),
        }
    }

    /// `shape/material`.
    pub(super) fn parse(line: &str) -> Option<Self> {
        let (shape, material) = line.split_once('/')?;
        Self::new(shape, material).ok()
    }

    /// Name of the shape.
    pub fn shape(&self) -> &str {
        &self.shape
    }

    /// Name of the material.
    pub fn material(&self) -> &str {
        &self.material
    }

    /// Folder of the shape.
    pub(super) fn shape_folder(&self, images: &Path) -> PathBuf {
        images.join(&self.shape)
    }

    pub(super) fn normals_name(&self) -> String {
        format!("{}_normal.png", self.shape)
    }

    pub(super) fn lights_name(&self) -> String {
        format!("{}_{}.txt", self.shape, self.material)
    }
}

impl fmt::Display for PublishedEntry {
    /// As in the lists.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.shape, self.material)
    }
}

/// Whether a name is that of a file or folder in its folder, on every system.
pub(super) fn is_plain(name: &str) -> bool {
    !matches!(name, "" | "." | "..")
        && !name.contains(|c: char| matches!(c, '/' | '\\' | ':') || c.is_control())
}
