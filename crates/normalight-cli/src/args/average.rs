//! `average`.

use crate::choices::DeviceChoice;
use clap::Args;
use std::path::PathBuf;

/// Makes one network of several that were trained from one start.
///
/// The mean of the weights of several trainings that went on from the same weights (`train --init`, with
/// different seeds), or of several ends of one training, is often better than each of them, and costs
/// nothing when it is used. Trainings from different random numbers have no mean; that is said.
#[derive(Debug, Args)]
#[command(after_help = AVERAGE_EXAMPLES)]
pub(crate) struct AverageArgs {
    /// Weights files of one architecture.
    #[arg(required = true, num_args = 2.., value_name = "WEIGHTS")]
    pub(crate) weights: Vec<PathBuf>,
    /// The weights file to write.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// A training recipe: each network and the average are measured on its validation objects.
    #[arg(long, value_name = "FILE")]
    pub(crate) recipe: Option<PathBuf>,
    /// A JSON file for what was measured; with --recipe.
    #[arg(long, value_name = "FILE", requires = "recipe")]
    pub(crate) report: Option<PathBuf>,
    /// Where to measure.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
    /// Show no figures.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const AVERAGE_EXAMPLES: &str = "\
Example: two trainings that went on from the same weights, and whether their average is better
  normalight average runs/a/weights.safetensors runs/b/weights.safetensors \\
    --recipe models/recipes/plain-normal.toml --out averaged.safetensors";
