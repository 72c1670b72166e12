//! Checkpoints: everything a run needs to go on, in two files of which one is always whole.
use crate::named_tensors::NamedTensors;
use crate::{RunError, TrainingState, hash};
use normalight_io::write_files;
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

/// The newest checkpoint, the one before it, and the name under which a new one is written.
const NEWEST: &str = "checkpoint.safetensors";
const BEFORE: &str = "checkpoint-before.safetensors";
const NEXT: &str = "checkpoint-next.safetensors";

/// Whether a run has left a checkpoint.
pub(crate) fn exists(folder: &Path) -> bool {
    folder.join(NEWEST).exists() || folder.join(BEFORE).exists()
}

/// Writes a checkpoint; the newest so far becomes the one before.
pub(crate) fn save(
    folder: &Path,
    tensors: &NamedTensors,
    training_state: &TrainingState,
) -> Result<(), RunError> {
    let newest = folder.join(NEWEST);
    let failed = |reason: String| RunError::Checkpoint {
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
    let hash = hash::of_tensors(
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
        std::fs::rename(folder.join(from), folder.join(to)).map_err(|reason| RunError::File {
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
pub struct Loaded {
    /// What the learner gave.
    pub tensors: NamedTensors,
    /// Where the run stands.
    pub training_state: TrainingState,
    /// The file.
    pub path: PathBuf,
    /// Why it is not the newest checkpoint.
    pub note: Option<String>,
}

/// Reads the newest checkpoint, or the one before where the newest is damaged.
///
/// # Errors
/// [`RunError::File`] or [`RunError::Checkpoint`].
pub fn load(folder: &Path) -> Result<Loaded, RunError> {
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
    read(NEWEST).or_else(|newest: RunError| match read(BEFORE) {
        Ok(loaded) => Ok(Loaded {
            note: Some(format!("{newest}; the checkpoint before it is used")),
            ..loaded
        }),
        // What is wrong with the newest says more.
        Err(_) => Err(newest),
    })
}

fn read(path: &Path) -> Result<(NamedTensors, TrainingState), RunError> {
    let bytes = std::fs::read(path).map_err(|reason| RunError::File {
        path: path.to_owned(),
        reason,
    })?;
    let broken = |reason: String| RunError::Checkpoint {
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
    let found = hash::of_tensors(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Best;

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
