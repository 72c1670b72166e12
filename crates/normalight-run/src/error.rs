use std::path::{Path, PathBuf};
use thiserror::Error;

/// What can go wrong with a run, whatever it trains.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RunError {
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
    #[error("{path}: a run is here already; continue it or choose another folder")]
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
    /// What others must finish first.
    #[error("{path}: waits for {what}")]
    Waits {
        /// The folder of all of it.
        path: PathBuf,
        /// What is missing.
        what: String,
    },
    /// A thread that makes batches ended early.
    #[error("a thread that makes samples stopped")]
    Loader,
    /// The picture of the curves could not be drawn.
    #[error("curves: {0}")]
    Plot(String),
    /// A file that is not written.
    #[error(transparent)]
    Io(#[from] normalight_io::IoError),
}

/// What a learner's errors have in common: some of them are the run's.
pub trait Failure: std::fmt::Display + From<RunError> + Send + 'static {
    /// The run's error, where it is one.
    fn run_error(&self) -> Option<&RunError>;
}

impl Failure for RunError {
    fn run_error(&self) -> Option<&RunError> {
        Some(self)
    }
}

/// Reads a text file.
///
/// # Errors
/// [`RunError::File`].
pub fn read_text(path: &Path) -> Result<String, RunError> {
    std::fs::read_to_string(path).map_err(|reason| RunError::File {
        path: path.to_owned(),
        reason,
    })
}
