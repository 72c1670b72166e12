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
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A checkpoint that does not belong to this run or is damaged.
    #[error("{path}: {reason}")]
    Checkpoint {
        /// The checkpoint file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The loss is no number any more; the last checkpoint is still good.
    #[error("the loss became {loss} at step {step}; the last checkpoint is untouched")]
    Diverged {
        /// Step at which it happened.
        step: usize,
        /// The loss.
        loss: f32,
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
    #[error("the sample renderer stopped")]
    Loader,
    /// The picture of the curves could not be drawn.
    #[error("curves: {0}")]
    Plot(String),
    /// A published training set cannot be read.
    #[error(transparent)]
    Published(#[from] normalight_io::IoError),
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
