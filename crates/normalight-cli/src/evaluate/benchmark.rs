//! The objects of a benchmark, whichever layout it has.
use super::folder_name;
use crate::terminal::note;
use anyhow::Result;
use normalight_evaluate::BenchmarkObject;
use normalight_io::{PublishedEntry, PublishedSet, list_diligent_objects, read_diligent_object};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::UNIX_EPOCH;

/// Where an object with its truth lies.
pub(super) enum Source {
    /// A folder in DiLiGenT's layout.
    Folder(PathBuf),
    /// An entry of a set in the layout of Blobby and Sculpture, which `render` writes.
    Entry(Arc<PublishedSet>, PublishedEntry, PathBuf),
}

/// All objects of a benchmark.
pub(super) fn sources(folder: &Path) -> Result<Vec<Source>> {
    if !folder.join("train_mtrl.txt").is_file() {
        let folders = list_diligent_objects(folder)?;
        return Ok(folders.into_iter().map(Source::Folder).collect());
    }
    let set = Arc::new(PublishedSet::open(folder)?);
    let entries = set.train().iter().chain(set.val());
    let source = |entry: &PublishedEntry| {
        let images = folder.join("Images").join(entry.shape());
        Source::Entry(set.clone(), entry.clone(), images)
    };
    Ok(entries.map(source).collect())
}

impl Source {
    /// The object's name: that of its folder, without the `PNG` that it ends with in DiLiGenT.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Entry(_, entry, _) => entry.to_string(),
            Self::Folder(folder) => {
                let name = folder_name(folder);
                match name.strip_suffix("PNG") {
                    Some(object) if !object.is_empty() && folder.is_dir() => object.to_owned(),
                    _ => name,
                }
            }
        }
    }

    /// Reads photographs and truth.
    pub(super) fn read(&self) -> Result<BenchmarkObject> {
        let name = self.name();
        Ok(match self {
            Self::Folder(folder) => {
                let read = read_diligent_object(folder, None)?;
                if let Some(file) = read.normals_file.filter(|file| file != "Normal_gt.mat") {
                    note(&format!(
                        "note: {name}: {file} are taken as its true normals"
                    ));
                }
                BenchmarkObject {
                    name,
                    stack: read.input.stack,
                    mask: read.input.mask,
                    lights: read.lights,
                    normals: read.normals,
                }
            }
            Self::Entry(set, entry, _) => {
                let read = set.read(entry)?;
                BenchmarkObject {
                    name,
                    stack: read.stack,
                    mask: read.mask,
                    lights: Some(read.lights),
                    normals: Some(read.normals),
                }
            }
        })
    }

    /// Names, sizes and times of the files that it is read from.
    pub(super) fn files(&self) -> Value {
        match self {
            Self::Folder(folder) => stamps(folder),
            Self::Entry(_, entry, folder) => {
                json!([stamps(folder), stamps(&folder.join(entry.material()))])
            }
        }
    }
}

fn stamps(folder: &Path) -> Value {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Value::Null;
    };
    let mut stamps: Vec<(String, u64, u128)> = entries
        .flatten()
        .filter_map(|entry| {
            let data = std::fs::metadata(entry.path()).ok()?;
            let changed = data.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
            let name = entry.file_name().to_string_lossy().into_owned();
            Some((name, data.len(), changed.as_nanos()))
        })
        .collect();
    stamps.sort();
    json!(stamps)
}
