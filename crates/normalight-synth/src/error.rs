use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// What can be wrong with a recipe and the files it names.
#[derive(Debug, Error)]
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
    /// The text of a recipe is malformed.
    #[error("{}: {message}", file.display())]
    Recipe {
        /// The recipe.
        file: PathBuf,
        /// Place and kind of the mistake.
        message: String,
    },
    /// A file could not be read.
    #[error("{}: {reason}", file.display())]
    File {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: io::Error,
    },
    /// A file of measured materials has other contents than expected.
    #[error("{}: {found} found, {expected} expected", file.display())]
    Measured {
        /// The file.
        file: PathBuf,
        /// What is there.
        found: String,
        /// What should be there.
        expected: &'static str,
    },
    /// A file of a stored scene has other contents than expected.
    #[error("{name}: {found} found, {expected} expected")]
    Stored {
        /// The file.
        name: String,
        /// What is there.
        found: String,
        /// What should be there.
        expected: String,
    },
    /// Photographs that no scene can be made of.
    #[error(transparent)]
    Photographs(#[from] normalight_core::CoreError),
    /// Photographs of the wrong shape.
    #[error("{width}x{height} pixels found, a square of at least {least}x{least} expected")]
    Size {
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
        /// Smallest side that works.
        least: usize,
    },
    /// A mesh could not be read.
    #[error(transparent)]
    Mesh(#[from] normalight_io::IoError),
}
