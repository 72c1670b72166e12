use normalight_core::CoreError;
use normalight_model::ModelError;
use normalight_synth::SynthError;
use std::path::PathBuf;
use thiserror::Error;

/// What can go wrong with a training run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TrainError {
    /// A recipe that does not parse.
    #[error("{file}: {reason}")]
    Recipe {
        /// The recipe file.
        file: String,
        /// Where and why.
        reason: String,
    },
    /// A number of the recipe is out of range.
    #[error("recipe: {field} is {found}, expected {expected}")]
    Value {
        /// Field of the recipe.
        field: &'static str,
        /// Its value.
        found: String,
        /// The range.
        expected: &'static str,
    },
    /// A file of the run cannot be read or written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        reason: std::io::Error,
    },
    /// A checkpoint that does not belong to this run or is damaged.
    #[error("{path}: {reason}")]
    Checkpoint {
        /// The checkpoint file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The loss or its gradient is no finite number any more; weights and checkpoints are untouched.
    #[error(
        "the {quantity} became {value} at step {step} (batch seed {batch_seed}: the number of its \
         first scene); the best weights and the last checkpoint are kept"
    )]
    Diverged {
        /// The loss, or the norm of its gradient.
        quantity: &'static str,
        /// What it became.
        value: f32,
        /// Step at which it happened, from 1.
        step: usize,
        /// Number of the first scene of the batch.
        batch_seed: u64,
    },
    /// Another process trains in the folder.
    #[error("{path}: another process is training here")]
    Locked {
        /// The run's folder.
        path: PathBuf,
    },
    /// The folder holds a run that has not come to its end.
    #[error("{path}: a run is here already; continue it with --resume or choose another folder")]
    Unfinished {
        /// The run's folder.
        path: PathBuf,
    },
    /// The folder holds a run of another recipe.
    #[error("{path}: a run of another recipe is here: {differences}")]
    OtherRecipe {
        /// The run's folder.
        path: PathBuf,
        /// Every setting that differs, with both values.
        differences: String,
    },
    /// A cache of other scenes.
    #[error("{path}: {reason}")]
    Cache {
        /// What describes the cache.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// Weights that a run cannot start from.
    #[error("{name}: {reason}")]
    Init {
        /// The weights file.
        name: String,
        /// Why not.
        reason: String,
    },
    /// An object of a published set has too few images or pixels for the recipe.
    #[error(
        "a training object has {} images of {} pixels a side, {} of {} expected",
        found[0], found[1], expected[0], expected[1]
    )]
    Sample {
        /// Images and pixels a side.
        found: [usize; 2],
        /// What the recipe asks for.
        expected: [usize; 2],
    },
    /// The thread that renders samples ended early.
    #[error("a thread that makes samples stopped")]
    Loader,
    /// The picture of the curves could not be drawn.
    #[error("curves: {0}")]
    Plot(String),
    /// A training set cannot be read, or a file not written.
    #[error(transparent)]
    Io(#[from] normalight_io::IoError),
    /// Scene settings out of range.
    #[error(transparent)]
    Synth(#[from] SynthError),
    /// Networks, weights or the pipeline.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Stacks and maps.
    #[error(transparent)]
    Core(#[from] CoreError),
}

impl TrainError {
    /// The command's exit code for it: 3 when training diverged, else 1.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Diverged { .. } => 3,
            _ => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::error::Error;

    /// The command prints a failure with everything below it: each reason must stand there once.
    #[test]
    fn reasons_are_said_once() {
        let reason = || std::io::Error::other("the disk is gone");
        let path = std::path::PathBuf::from("weights");
        let json = serde_json::from_str::<u8>("the disk is gone").unwrap_err();
        let said = json.to_string();
        let errors: [(Box<dyn Error>, &str); 5] = [
            (
                Box::new(TrainError::File {
                    path: path.clone(),
                    reason: reason(),
                }),
                "the disk is gone",
            ),
            (
                Box::new(TrainError::Synth(SynthError::File {
                    file: path,
                    reason: reason(),
                })),
                "the disk is gone",
            ),
            (
                Box::new(TrainError::Io(normalight_io::IoError::Read {
                    name: "weights".to_owned(),
                    reason: reason(),
                })),
                "the disk is gone",
            ),
            (
                Box::new(TrainError::Model(ModelError::Json {
                    name: "weights".to_owned(),
                    reason: json,
                })),
                &said,
            ),
            (
                Box::new(TrainError::Core(CoreError::LightCount {
                    found: 3,
                    expected: 7,
                })),
                "3",
            ),
        ];
        for (error, reason) in &errors {
            let mut text = error.to_string();
            let mut below = error.source();
            while let Some(next) = below {
                text += &format!(": {next}");
                below = next.source();
            }
            assert_eq!(text.matches(reason).count(), 1, "{text}");
        }
    }
}
