//! Checkpoints: everything a run needs to go on, in two files of which one is always whole.
use crate::named_tensors::NamedTensors;
use crate::{Best, TrainError};
use normalight_io::write_files;
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// The newest checkpoint, the one before it, and the name under which a new one is written.
const NEWEST: &str = "checkpoint.safetensors";
const BEFORE: &str = "checkpoint-before.safetensors";
const NEXT: &str = "checkpoint-next.safetensors";

/// Where a run stands, beside its tensors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct TrainingState {
    /// Steps taken.
    pub(crate) step: usize,
    /// Best validation so far.
    pub(crate) best: Option<Best>,
    /// Loss of the last step.
    pub(crate) loss: Option<f32>,
    /// Sum of the losses since the last validation, and their number. In f32, which comes back from
    /// JSON exactly.
    pub(crate) recent: (f32, usize),
    /// Seconds of training in all, and how many of them were spent waiting for samples.
    pub(crate) seconds: f64,
    pub(crate) waited: f64,
}

impl TrainingState {
    pub(crate) fn start() -> Self {
        Self {
            step: 0,
            best: None,
            loss: None,
            recent: (0.0, 0),
            seconds: 0.0,
            waited: 0.0,
        }
    }
}

/// Whether a run has left a checkpoint.
pub(crate) fn exists(folder: &Path) -> bool {
    folder.join(NEWEST).exists() || folder.join(BEFORE).exists()
}

/// Writes a checkpoint; the newest so far becomes the one before.
pub(crate) fn save(
    folder: &Path,
    tensors: &NamedTensors,
    training_state: &TrainingState,
) -> Result<(), TrainError> {
    let newest = folder.join(NEWEST);
    let failed = |reason: String| TrainError::Checkpoint {
        path: newest.clone(),
        reason,
    };
    let bytes =
        |values: &[f32]| -> Vec<u8> { values.iter().flat_map(|v| v.to_le_bytes()).collect() };
    let tensors: BTreeMap<&String, Vec<u8>> = tensors
        .iter()
        .map(|(name, values)| (name, bytes(values)))
        .collect();
    let views = tensors
        .iter()
        .map(|(name, bytes)| {
            let view = TensorView::new(Dtype::F32, vec![bytes.len() / 4], bytes);
            view.map(|view| (name.as_str(), view))
        })
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| failed(error.to_string()))?;
    let training_state =
        serde_json::to_string(training_state).map_err(|error| failed(error.to_string()))?;
    let hash = hash(
        tensors
            .iter()
            .map(|(name, bytes)| (name.as_str(), &bytes[..])),
    );
    let metadata = HashMap::from([
        ("training_state".to_owned(), training_state),
        ("hash".to_owned(), hash),
    ]);
    let file =
        safetensors::serialize(views, Some(metadata)).map_err(|error| failed(error.to_string()))?;
    write_files(folder, &[(NEXT, file)])?;
    let rename = |from: &str, to: &str| {
        std::fs::rename(folder.join(from), folder.join(to)).map_err(|reason| TrainError::File {
            path: folder.join(to),
            reason,
        })
    };
    if newest.exists() {
        rename(NEWEST, BEFORE)?;
    }
    rename(NEXT, NEWEST)
}

/// What was read, and what is to be said about it.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) tensors: NamedTensors,
    pub(crate) training_state: TrainingState,
    /// The file.
    pub(crate) path: PathBuf,
    /// Why it is not the newest checkpoint.
    pub(crate) note: Option<String>,
}

/// Reads the newest checkpoint, or the one before where the newest is damaged.
pub(crate) fn load(folder: &Path) -> Result<Loaded, TrainError> {
    let read = |name: &str| {
        let path = folder.join(name);
        let (tensors, training_state) = read(&path)?;
        Ok(Loaded {
            tensors,
            training_state,
            path,
            note: None,
        })
    };
    read(NEWEST).or_else(|newest: TrainError| match read(BEFORE) {
        Ok(loaded) => Ok(Loaded {
            note: Some(format!("{newest}; the checkpoint before it is used")),
            ..loaded
        }),
        // What is wrong with the newest says more.
        Err(_) => Err(newest),
    })
}

fn read(path: &Path) -> Result<(NamedTensors, TrainingState), TrainError> {
    let bytes = std::fs::read(path).map_err(|reason| TrainError::File {
        path: path.to_owned(),
        reason,
    })?;
    let broken = |reason: String| TrainError::Checkpoint {
        path: path.to_owned(),
        reason,
    };
    let file = SafeTensors::deserialize(&bytes).map_err(|error| broken(error.to_string()))?;
    let (_, header) =
        SafeTensors::read_metadata(&bytes).map_err(|error| broken(error.to_string()))?;
    let metadata = header.metadata().clone().unwrap_or_default();
    let entry = |key: &str| {
        let missing = || {
            broken(format!(
                "no {key} in its metadata: not a checkpoint of this version"
            ))
        };
        metadata.get(key).ok_or_else(missing)
    };
    let training_state = serde_json::from_str(entry("training_state")?)
        .map_err(|error| broken(format!("training_state: {error}")))?;
    let views: BTreeMap<String, TensorView> = file.tensors().into_iter().collect();
    let found = hash(
        views
            .iter()
            .map(|(name, view)| (name.as_str(), view.data())),
    );
    if found != *entry("hash")? {
        return Err(broken("its numbers are not those that were written".into()));
    }
    let mut tensors = NamedTensors::new();
    for (name, view) in views {
        if view.dtype() != Dtype::F32 {
            return Err(broken(format!("tensor {name} is not f32")));
        }
        let values = view.data().chunks_exact(4);
        let values = values.map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]));
        tensors.insert(name, values.collect());
    }
    Ok((tensors, training_state))
}

/// SHA-256 over names and values in the order of the names.
fn hash<'a>(tensors: impl Iterator<Item = (&'a str, &'a [u8])>) -> String {
    let mut hash = Sha256::new();
    for (name, bytes) in tensors {
        hash.update(name.as_bytes());
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    }
    hex(&hash.finalize())
}

/// SHA-256 of a file's content, in hexadecimal.
pub(crate) fn hash_of(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tensors(value: f32) -> NamedTensors {
        NamedTensors::from([("weight/a".to_owned(), vec![value, f32::MIN_POSITIVE, -0.1])])
    }

    fn training_state(step: usize) -> TrainingState {
        TrainingState {
            step,
            best: Some(Best {
                step,
                degrees: 12.345_678,
                figures: BTreeMap::from([("under_30".to_owned(), 0.25)]),
            }),
            loss: Some(0.1),
            recent: (0.1 + 0.2, 3),
            seconds: 0.75,
            waited: 0.5,
        }
    }

    #[test]
    fn numbers_come_back_exactly() {
        let folder = tempfile::tempdir().unwrap();
        save(folder.path(), &tensors(0.3), &training_state(7)).unwrap();
        let loaded = load(folder.path()).unwrap();
        assert_eq!(loaded.tensors, tensors(0.3));
        assert_eq!(loaded.training_state, training_state(7));
        assert_eq!(loaded.note, None);
    }

    #[test]
    fn the_one_before_stands_in_for_a_damaged_one() {
        let folder = tempfile::tempdir().unwrap();
        for step in [1, 2, 3] {
            save(folder.path(), &tensors(step as f32), &training_state(step)).unwrap();
        }
        let newest = folder.path().join(NEWEST);
        let whole = std::fs::read(&newest).unwrap();
        let mut flipped = whole.clone();
        *flipped.last_mut().unwrap() ^= 1;
        let cut = whole[..whole.len() - 1].to_vec();
        for bytes in [&cut[..], &flipped[..], &[]] {
            std::fs::write(&newest, bytes).unwrap();
            let loaded = load(folder.path()).unwrap();
            assert_eq!(
                (loaded.training_state.step, loaded.tensors),
                (2, tensors(2.0))
            );
            let note = loaded.note.unwrap();
            assert!(note.contains(NEWEST) && note.contains("before"), "{note}");
        }
        // Killed between the two renames.
        std::fs::remove_file(&newest).unwrap();
        assert!(exists(folder.path()));
        assert_eq!(load(folder.path()).unwrap().training_state.step, 2);
        // Nothing whole is left.
        std::fs::write(&newest, b"x").unwrap();
        std::fs::write(folder.path().join(BEFORE), b"").unwrap();
        let error = load(folder.path()).unwrap_err().to_string();
        assert!(error.contains("checkpoint.safetensors"), "{error}");
    }
}
