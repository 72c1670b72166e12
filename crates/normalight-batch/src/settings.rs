use crate::Shard;
use std::ffi::OsString;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

/// What is done, with what.
#[derive(Debug, Clone)]
pub struct BatchSettings {
    /// The tree of captures.
    pub root: PathBuf,
    /// Folder for results, table and page; made when missing.
    pub output: PathBuf,
    /// What does one capture.
    pub program: Program,
    /// Most captures at the same time.
    pub jobs: NonZeroUsize,
    /// Bytes of memory that all jobs together may take by estimation; `None` for no limit. A single job always runs.
    pub memory: Option<u64>,
    /// Which captures are meant.
    pub shard: Shard,
    /// A job that takes longer is ended and has failed; `None` waits for ever.
    pub time_limit: Option<Duration>,
    /// Whether to read the content of photographs whose size and times are as they were.
    pub check_contents: bool,
}

/// The program that does one capture, called as
/// `PROGRAM estimate CAPTURE --out FOLDER ARGUMENTS... --quiet`, and what its results depend on.
#[derive(Debug, Clone)]
pub struct Program {
    /// Its file.
    pub path: PathBuf,
    /// Its version, and what else tells its answers from those of another build: results of another one are made again.
    pub version: String,
    /// Further arguments: results with other ones are made again.
    pub arguments: Vec<OsString>,
    /// Files that the arguments name (lights, a mask, weights): results with other content of them are made again.
    pub files: Vec<PathBuf>,
    /// Variables of the environment that are set for it, which do not count as settings.
    pub environment: Vec<(OsString, OsString)>,
}
