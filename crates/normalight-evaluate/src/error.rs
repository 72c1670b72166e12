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
    /// A photograph that cannot be disturbed as asked.
    #[error("a photograph cannot be disturbed: {0}")]
    Disturbance(String),
    /// A part of the report that cannot be made.
    #[error("the report cannot be made: {0}")]
    Report(String),
}
