use normalight_io::IoError;
use std::io;
use std::path::PathBuf;

/// Why there is no batch, or none to its end. What goes wrong with one capture is a [`Row`](crate::Row) instead.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BatchError {
    /// The tree cannot be read.
    #[error("{path}: cannot be read: {reason}", path = .path.display())]
    Read {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// Something in the output cannot be made, written or taken away.
    #[error("{path}: cannot be written: {reason}", path = .path.display())]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        reason: io::Error,
    },
    /// Table or page cannot be written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// The root is no folder.
    #[error("{path}: found a file, expected a folder of captures", path = .path.display())]
    NotAFolder {
        /// What was given.
        path: PathBuf,
    },
    /// There is nothing to do.
    #[error("{path}: no capture found in {folders} folder(s){besides}; expected folders with at least {expected} photographs each, archives of them, or TIFF files with as many pages", path = .path.display())]
    NoCaptures {
        /// The root of the tree.
        path: PathBuf,
        /// Folders looked at.
        folders: usize,
        /// What was passed over, in words after a semicolon; empty for nothing.
        besides: String,
        /// Smallest number of photographs that works.
        expected: usize,
    },
    /// Results would be read as captures the next time, or captures overwritten.
    #[error("{output}: {how} {root}; choose another folder for the results", output = .output.display(), root = .root.display())]
    NotApart {
        /// The output.
        output: PathBuf,
        /// How the one lies to the other.
        how: &'static str,
        /// The tree of captures.
        root: PathBuf,
    },
    /// The same shard is at work.
    #[error("{path}: another batch is at work here{}", .shard.map(|shard| format!(" on shard {shard}")).unwrap_or_default(), path = .path.display())]
    AtWork {
        /// The output.
        path: PathBuf,
        /// Its shard, if it is not all.
        shard: Option<crate::Shard>,
    },
    /// A batch of another division is at work, which would take some of the same captures.
    #[error("{path}: a batch is at work here that is divided into {found}, expected {expected}; wait for its end", path = .path.display())]
    OtherDivision {
        /// The output.
        path: PathBuf,
        /// Number of parts of the batch at work.
        found: usize,
        /// Number of parts of this one.
        expected: usize,
    },
    /// No result of a batch lies here.
    #[error("{path}: found no results of a batch", path = .path.display())]
    NothingToCollect {
        /// The output.
        path: PathBuf,
    },
}
