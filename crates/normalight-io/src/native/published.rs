//! The layout of the published training sets (Blobby and Sculpture shapes).
//!
//! ```text
//! train_mtrl.txt, val_mtrl.txt                lines shape/material
//! Images/<shape>/<shape>_normal.png           8-bit RGB, n = v / 255 * 2 - 1; nearly 0 outside
//! Images/<shape>/<material>/<image>.png
//! Images/<shape>/<material>/<shape>_<material>.txt    lines image x y z
//! ```
//!
//! Sets that [`PublishedWriter`] writes hold more, which loaders of the published sets pass over:
//! the lights' intensities as columns `r g b`, and beside the normals `<shape>_normal.npy`,
//! `<shape>_mask.png` and, where there is one, `<shape>_depth.npy`.
mod encode;
mod entry;
mod light_list;
mod object;
mod resize;
mod split;
mod to_publish;
mod writer;

pub use entry::PublishedEntry;
pub use object::PublishedObject;
pub use split::PublishedSplit;
pub use to_publish::ObjectToPublish;
pub use writer::{PublishedPart, PublishedWriter};

use super::files::{display, read_file};
use crate::IoError;
use crate::limits::MAX_TEXT_BYTES;
use crate::text::read_text;
use std::path::{Path, PathBuf};

#[cfg(fuzzing)]
pub(super) mod fuzzing {
    pub(in crate::native) use super::light_list::parse as lights;
}

const TRAIN_LIST: &str = "train_mtrl.txt";
const VAL_LIST: &str = "val_mtrl.txt";
const IMAGES: &str = "Images";

/// A set in the published layout: its lists are read, its objects when asked for.
#[derive(Debug, Clone)]
pub struct PublishedSet {
    root: PathBuf,
    train: Vec<PublishedEntry>,
    val: Vec<PublishedEntry>,
}

impl PublishedSet {
    /// Reads the lists of a set. `val_mtrl.txt` may be missing or empty, see
    /// [`PublishedSet::train_split`].
    ///
    /// # Errors
    /// [`IoError::Read`] for a missing `train_mtrl.txt`, [`IoError::SetFormat`] for an empty one;
    /// [`IoError::SetLine`] for lines that are not `shape/material`, names that lead out of the set
    /// among them.
    pub fn open(root: &Path) -> Result<Self, IoError> {
        let list = root.join(TRAIN_LIST);
        let train = read_list(&list)?;
        if train.is_empty() {
            return Err(IoError::SetFormat {
                name: display(&list),
                found: "no line".to_owned(),
                expected: "a line shape/material for each object".to_owned(),
            });
        }
        Ok(Self {
            root: root.to_owned(),
            train,
            val: read_list_if_there(&root.join(VAL_LIST))?,
        })
    }

    /// The entries of `train_mtrl.txt`, in order.
    pub fn train(&self) -> &[PublishedEntry] {
        &self.train
    }

    /// The entries of `val_mtrl.txt`, in order.
    pub fn val(&self) -> &[PublishedEntry] {
        &self.val
    }

    /// Reads one object: images (linear), normals, mask and lights.
    ///
    /// # Errors
    /// [`IoError::Read`] for a missing file; [`IoError::LightFormat`]; those of decoding an image;
    /// [`IoError::TooFewImages`]; [`IoError::SetFormat`] for normals that are none or of another
    /// size; [`IoError::Core`] for images that do not fit each other, or without an object.
    pub fn read(&self, entry: &PublishedEntry) -> Result<PublishedObject, IoError> {
        object::read(&self.root.join(IMAGES), entry)
    }
}

fn read_list(path: &Path) -> Result<Vec<PublishedEntry>, IoError> {
    // A hundred thousand objects need more than other texts may have.
    let bytes = read_file(path, 16 * MAX_TEXT_BYTES)?;
    let name = display(path);
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let lines = lines.map(|(index, line)| (index + 1, line.trim()));
    lines
        .filter(|(_, line)| !line.is_empty())
        .map(|(number, line)| {
            PublishedEntry::parse(line).ok_or_else(|| IoError::SetLine {
                name: name.clone(),
                line: number,
                found: line.chars().take(80).collect(),
                expected: "shape/material, two plain names".to_owned(),
            })
        })
        .collect()
}

fn read_list_if_there(path: &Path) -> Result<Vec<PublishedEntry>, IoError> {
    if path.exists() {
        return read_list(path);
    }
    Ok(Vec::new())
}

/// Text of a small file.
fn read_small(path: &Path) -> Result<String, IoError> {
    read_text(&display(path), &read_file(path, MAX_TEXT_BYTES)?)
}
