//! `bench` and what it measures.

use crate::args::LibraryArgs;
use crate::choices::{DeviceChoice, NetworkChoice};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Measures speed.
#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    #[command(subcommand)]
    pub(crate) what: BenchCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum BenchCommand {
    /// How fast training samples are drawn, on all cores.
    ///
    /// 32x16: crops of 32 x 32 pixels under 16 lights, up to 32 of one scene, each with lights, exposure
    /// and noise of its own. 128x32: whole scenes of 128 x 128 pixels under 32 lights.
    Render(BenchRenderArgs),
    /// How fast the networks are trained, on one core and on all.
    ///
    /// Forward and backward, the optimiser and the data apart, for four networks on batches of 16 samples of ten 32x32
    /// images. Nothing else should run meanwhile.
    Train(BenchTrainArgs),
    /// How fast a relaxed network is searched, on one core and on all.
    ///
    /// A step takes a batch from either half of the data: first the architecture moves, then the weights.
    Search(BenchSearchArgs),
    /// How long every operation of a search space takes where a recipe's cells stand.
    ///
    /// The file is a table for the `budget` of a search in time.
    Ops(BenchOpsArgs),
    /// How many captures an hour a batch does with one and with two jobs, and what it adds to each.
    ///
    /// The captures are rendered; each is estimated by itself first.
    Batch(BenchBatchArgs),
}

#[derive(Debug, Args)]
pub(crate) struct BenchBatchArgs {
    /// Captures.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) captures: u32,
    /// Photographs of each.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(3..=1024))]
    pub(crate) images: u32,
    /// Side of the photographs in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 192, value_parser = clap::value_parser!(u32).range(16..=2048))]
    pub(crate) size: u32,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
    /// Settings of `normalight estimate` for all captures, after `--`.
    #[arg(last = true, value_name = "SETTINGS")]
    pub(crate) settings: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct BenchSearchArgs {
    /// `laptop`, `paper` or a TOML file.
    #[arg(long, value_name = "NAME|FILE", default_value = "laptop")]
    pub(crate) recipe: String,
    /// Only this network; default: both, or that of the file.
    #[arg(long, value_enum)]
    pub(crate) network: Option<NetworkChoice>,
    /// Seconds for each case, at least.
    #[arg(long, value_name = "S", default_value_t = 3.0)]
    pub(crate) seconds: f64,
    /// Threads; default: one, then one for each core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct BenchOpsArgs {
    /// Which network.
    #[arg(value_enum)]
    pub(crate) network: NetworkChoice,
    /// `laptop`, `paper` or a TOML file: says which operations, widths and sizes are measured.
    #[arg(long, value_name = "NAME|FILE", default_value = "laptop")]
    pub(crate) recipe: String,
    /// File for the table, JSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// Seconds for each case, at least.
    #[arg(long, value_name = "S", default_value_t = 0.3)]
    pub(crate) seconds: f64,
    /// Threads of the CPU; default: one for each core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
}

#[derive(Debug, Args)]
pub(crate) struct BenchTrainArgs {
    /// Seconds for each case, at least.
    #[arg(long, value_name = "S", default_value_t = 3.0)]
    pub(crate) seconds: f64,
    /// Threads; default: one, then one for each core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Only these networks: plain-127k, plain-483k, pixels-157k, paper-c8, paper-c16.
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = ["plain-127k", "plain-483k", "pixels-157k", "paper-c8", "paper-c16"])]
    pub(crate) only: Vec<String>,
    /// Every operation, too, against the same made of Burn's own.
    #[arg(long)]
    pub(crate) ops: bool,
    /// Time the networks with Burn's own operations instead of ours.
    #[arg(long)]
    pub(crate) generic: bool,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct BenchRenderArgs {
    /// `world`, `classic`, or a TOML file.
    #[arg(long, value_name = "NAME|FILE", default_value = "world")]
    pub(crate) recipe: String,
    #[command(flatten)]
    pub(crate) library: LibraryArgs,
    /// Seconds for each case, at least.
    #[arg(long, value_name = "S", default_value_t = 5.0)]
    pub(crate) seconds: f64,
    /// Threads; default: one for each core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
}
