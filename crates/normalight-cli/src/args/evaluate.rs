//! `evaluate`.

use crate::args::EstimationArgs;
use clap::Args;
use std::path::PathBuf;

/// Measures the errors of the estimates on a benchmark in DiLiGenT's layout.
#[derive(Debug, Args)]
#[command(after_help = EVALUATE_EXAMPLES)]
pub(crate) struct EvaluateArgs {
    /// A folder of objects, or one object's folder.
    ///
    /// An object's folder holds photographs, mask.png, Normal_gt.mat, light_directions.txt and
    /// light_intensities.txt. A folder of objects may have a list of them, objects.txt.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Use only this many photographs, evenly spaced; several numbers give a table each.
    #[arg(long, value_name = "N", value_delimiter = ',')]
    pub(crate) images: Vec<usize>,
    /// Write the figures as JSON, too.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// Estimate the normals with the true lights: what is left is the normal network's error.
    #[arg(long)]
    pub(crate) calibrated: bool,
    #[command(flatten)]
    pub(crate) estimation: EstimationArgs,
    /// Show no progress.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const EVALUATE_EXAMPLES: &str = "\
Example: tables for 96, 16 and 8 photographs of each object
  normalight evaluate DiLiGenT/pmsData --images 96,16,8 --json figures.json";
