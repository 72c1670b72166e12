use thiserror::Error;

/// What can be wrong with a recipe.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SynthError {
    /// A number lies outside what its field can mean.
    #[error("{field}: {found} found, {expected} expected")]
    OutOfRange {
        /// Where in the recipe, such as `lights.cap_degrees`.
        field: &'static str,
        /// The value given.
        found: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// The weights of a choice sum to zero.
    #[error("{field}: all weights are 0, at least one positive weight expected")]
    NoWeight {
        /// Where in the recipe, such as `shapes`.
        field: &'static str,
    },
}
