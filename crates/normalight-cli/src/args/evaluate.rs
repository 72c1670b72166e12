//! `evaluate`.

use crate::args::EstimationArgs;
use crate::choices::{LeaveOut, MethodChoice, NamedRun};
use clap::Args;
use normalight_evaluate::Disturbance;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Measures the errors of the estimates on a benchmark with known lights and normals.
#[derive(Debug, Args)]
#[command(after_help = EVALUATE_EXAMPLES)]
pub(crate) struct EvaluateArgs {
    /// A folder of objects, or one object's folder.
    ///
    /// An object's folder holds photographs, mask.png, Normal_gt.mat, light_directions.txt and
    /// light_intensities.txt, as in DiLiGenT. A folder of objects may have a list of them, objects.txt. What is missing is not
    /// compared: DiLiGenT10^2 and DiLiGenT-Pi keep their normals back, near lamps as in LUCES have no one direction (its
    /// normals.png are taken as true). What `render` writes, in the layout of the Blobby and Sculpture sets, is a benchmark,
    /// too.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Methods to measure, `all` for all of them.
    ///
    /// What a method that is not told the lights gets wrong stands in two columns: lights and normals.
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        default_value = "uncalibrated"
    )]
    pub(crate) methods: Vec<MethodChoice>,
    /// Use only this many photographs, spread over the series; several numbers give a table each.
    #[arg(long, value_name = "N", value_delimiter = ',')]
    pub(crate) images: Vec<usize>,
    /// Instead of photographs spread over the series take so many random choices of them, and their mean.
    #[arg(long, value_name = "N", requires = "images", value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub(crate) subsets: Option<u64>,
    /// Scale objects down to at most so many pixels; the paper takes 128.
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..))]
    pub(crate) size: Option<u32>,
    /// Leave out photographs of an object, counted from 1: the first twenty of DiLiGenT's bear are known to be faulty.
    #[arg(long, value_name = "OBJECT:FIRST-LAST")]
    pub(crate) leave_out: Vec<LeaveOut>,
    /// Measure with disturbed photographs, too, as many as the first table has.
    ///
    /// jpeg:QUALITY; ambient:SHARE, room light; clipped:SHARE of the samples; encoded for viewing and taken as linear; a mask
    /// grown:PIXELS beyond the object, or shrunk:PIXELS.
    #[arg(long, value_name = "KIND:VALUE", value_delimiter = ',')]
    pub(crate) disturb: Vec<Disturbance>,
    /// Write a report into this folder: a page for people (index.html), Markdown, CSV and JSON.
    ///
    /// What was measured is kept there: the same command again measures only what is missing or was measured with something
    /// else.
    #[arg(long, value_name = "DIR")]
    pub(crate) report: Option<PathBuf>,
    /// Keep the estimated normals in the report's folder, too, as the servers of DiLiGenT10^2 and DiLiGenT-Pi take them:
    /// estimates/METHOD/normals.zip, with a MATLAB file for each object.
    #[arg(long, requires = "report", conflicts_with = "size")]
    pub(crate) estimates: bool,
    /// Show in the report how a training went: a name for it, and its folder.
    #[arg(
        long,
        value_name = "NAME=RUN",
        requires = "report",
        value_delimiter = ','
    )]
    pub(crate) curves: Vec<NamedRun>,
    /// Objects to measure side by side. Seconds can be compared with one only.
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) jobs: NonZeroUsize,
    /// Write the figures as JSON, too.
    #[arg(long, value_name = "FILE")]
    pub(crate) json: Option<PathBuf>,
    /// The same as `--methods calibrated`: estimate the normals with the true lights.
    #[arg(long, conflicts_with = "methods")]
    pub(crate) calibrated: bool,
    #[command(flatten)]
    pub(crate) estimation: EstimationArgs,
    /// Show no progress.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const EVALUATE_EXAMPLES: &str = "\
Examples: tables for 96, 16 and 8 photographs of each object; a report of everything; one to hand in; disturbances
  normalight evaluate DiLiGenT/pmsData --images 96,16,8 --json figures.json
  normalight evaluate DiLiGenT/pmsData --methods all --images 96,32,16,8,4 --report report
  normalight evaluate DiLiGenT10^2 --report report --estimates
  normalight evaluate DiLiGenT/pmsData --disturb jpeg:50,ambient:0.2,clipped:0.02,grown:3 --report disturbed";
