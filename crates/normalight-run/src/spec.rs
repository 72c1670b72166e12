use crate::ExitCodes;
use std::path::PathBuf;

/// A run as its folder knows it.
#[derive(Debug)]
pub struct RunSpec {
    /// Where.
    pub folder: PathBuf,
    /// Whether an earlier beginning is continued.
    pub resume: bool,
    /// Everything that decides the result, as TOML.
    pub recipe: String,
    /// Keys of the recipe that may change when a run is continued: those that do not decide what is computed.
    pub free: &'static [&'static str],
    /// What is trained, in a word: it stands in the summary.
    pub network: String,
    /// Number of trainable weights that are kept.
    pub parameters: usize,
    /// Seed of weights and samples.
    pub seed: u64,
    /// How long, and how often what.
    pub schedule: LoopSchedule,
    /// What the process ends with that carries it out, for the summary.
    pub exit_codes: Option<ExitCodes>,
    /// Name of the file that holds the best result.
    pub result: &'static str,
}

/// How long a run is, and how often it does what.
#[derive(Debug, Clone, Copy)]
pub struct LoopSchedule {
    /// Steps in all.
    pub steps: usize,
    /// Steps between validations.
    pub validate_every: usize,
    /// Steps between checkpoints.
    pub checkpoint_every: usize,
    /// Samples of a step.
    pub batch: usize,
}
