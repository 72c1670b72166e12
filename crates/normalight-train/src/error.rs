use normalight_core::CoreError;
use normalight_model::ModelError;
use normalight_run::{Failure, RunError};
use normalight_synth::SynthError;
use std::path::PathBuf;
use thiserror::Error;

/// What can go wrong with a training run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TrainError {
    /// The run itself: its recipe, folder, checkpoints, or a loss that is no number any more.
    #[error(transparent)]
    Run(#[from] RunError),
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

impl Failure for TrainError {
    fn run_error(&self) -> Option<&RunError> {
        match self {
            Self::Run(error) => Some(error),
            _ => None,
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
                Box::new(TrainError::Run(RunError::File {
                    path: path.clone(),
                    reason: reason(),
                })),
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
