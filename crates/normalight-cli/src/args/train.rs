//! `train`.

use crate::choices::{DeviceChoice, NetworkChoice};
use clap::Args;
use std::path::PathBuf;

/// Trains a network.
///
/// The folder of a run then holds recipe.toml, log.txt, curves.csv, curves.png,
/// checkpoint.safetensors and the one before it, weights.safetensors (the best on validation so far),
/// summary.json and, at the end, model-card.md. Ctrl-C and SIGTERM write a checkpoint and stop; after a
/// kill at most the steps since the last checkpoint are lost. The same command again on a finished run
/// does nothing.
#[derive(Debug, Args)]
#[command(after_help = TRAIN_EXAMPLES)]
pub(crate) struct TrainArgs {
    /// Which network.
    #[arg(value_enum)]
    pub(crate) network: NetworkChoice,
    /// The recipe: every number of the run, as TOML.
    #[arg(long, value_name = "FILE")]
    pub(crate) recipe: PathBuf,
    /// Folder of the run; made when missing.
    #[arg(long, alias = "out", value_name = "DIR")]
    pub(crate) run: PathBuf,
    /// Seed of weights and samples, instead of the recipe's; up to 1048575.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 20))]
    pub(crate) seed: Option<u64>,
    /// Continue from the folder's checkpoint; without one a fresh start.
    ///
    /// Only steps, validate_every, checkpoint_every and loader_threads of the recipe may have changed:
    /// more steps make a finished run longer.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Start from these weights instead of random ones, with a fresh optimiser; plain networks only.
    #[arg(long, value_name = "WEIGHTS")]
    pub(crate) init: Option<PathBuf>,
    /// Threads that make samples; default: one fewer than there are cores. The samples stay the same.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
    /// Number of devices that share every batch.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(crate) devices: u32,
    /// Show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const TRAIN_EXAMPLES: &str = "\
Example: a first training, which needs no files, and on after a break
  normalight train normal --recipe models/recipes/first.toml --run runs/first
  normalight train normal --recipe models/recipes/first.toml --run runs/first --resume

Exit codes: 0 finished, 1 error, 2 wrong usage, 3 diverged (loss or gradient no number any more),
130 stopped by Ctrl-C or SIGTERM after writing a checkpoint. summary.json says the same:
  state (running, finished, interrupted, failed), reason, exit_code, network, parameters, seed, steps,
  steps_planned, best (step, degrees, figures), loss, hours, hours_waited, weights_sha256,
  recipe_sha256, version";
