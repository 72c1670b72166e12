use normalight_core::CoreError;
use normalight_model::ModelError;
use thiserror::Error;

/// What can go wrong when an object is evaluated.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EvaluateError {
    /// The pipeline; cancelled by the observer, say.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A truth that does not fit the photographs.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// A method that needs true lights which are not known.
    #[error("the true lights are not known (light_directions.txt), and this method needs them")]
    NoLights,
    /// Neither true normals nor true lights, and nobody who wants the estimate.
    #[error(
        "neither true normals (Normal_gt.mat) nor true lights (light_directions.txt): nothing can be compared"
    )]
    NoTruth,
    /// A photograph that cannot be disturbed as asked.
    #[error("a photograph cannot be disturbed: {0}")]
    Disturbance(String),
    /// What should be the course of a training.
    #[error(
        "{name}: line {line} of its curves: found {found:?}, a course with step, validation_degrees and seconds is expected"
    )]
    Curves {
        /// The training.
        name: String,
        /// Counted from 1.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// A part of the report that cannot be made.
    #[error("the report cannot be made: {0}")]
    Report(String),
}
