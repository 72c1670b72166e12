//! What the commands take; these comments are their help.
mod search;

pub(crate) use search::{CompareArgs, DeriveArgs, SearchArgs, SearchCommand, SearchCommands};

use crate::choices::{
    BitsChoice, ColorChoice, DecodingChoice, DeviceChoice, FormatChoice, NetworkChoice,
    QualityChoice,
};
use clap::{Args, Parser, Subcommand};
use normalight_io::LightAxes;
use std::path::PathBuf;

/// Finds the lights and the surface normals of an object from photographs.
///
/// Take at least three photographs (better ten or more) of one object with a fixed camera, each with
/// the lamp somewhere else, and put them into a folder. Nobody needs to know where the lamp was.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Example: photographs in the folder `vase`, results into the folder `vase-normals`
  normalight estimate vase --out vase-normals

`normalight help estimate` explains all settings. Everything stays on this computer.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Photographs in, lights and normals out.
    Estimate(EstimateArgs),
    /// Train one of the two networks on rendered samples.
    Train(TrainArgs),
    /// Search for the cells of one of the two networks, and compare what was found.
    Search(SearchCommands),
    /// Draw synthetic stacks with known lights and normals.
    Render(RenderArgs),
    /// Measure the speed of parts of the program on this machine.
    Bench(BenchArgs),
    /// Measure the errors on objects whose lights and normals are known.
    Evaluate(EvaluateArgs),
}

/// Estimates lights and normals of one object.
#[derive(Debug, Args)]
#[command(after_help = ESTIMATE_EXAMPLES)]
pub(crate) struct EstimateArgs {
    /// A folder of photographs, or the photographs themselves.
    ///
    /// PNG, JPEG, TIFF, TGA, BMP, WebP or EXR, all of one size. In a folder, a list file
    /// (filenames.txt or names.txt) decides which files are the photographs and in which order;
    /// without one it is all images but those named mask, normal, albedo, depth or ambient.
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// Folder for the results; made when missing.
    #[arg(long, value_name = "DIR", required_unless_present = "dry_run")]
    pub(crate) out: Option<PathBuf>,
    /// Read the photographs, say what is taken for what and why, and stop.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) dry_run: bool,
    /// Image of the object's pixels (bright inside, dark outside), or `none` for the whole frame.
    ///
    /// Default: the image named mask beside the photographs, else the transparency of the first
    /// one, else the object as the photographs tell it from its background.
    #[arg(long, value_name = "FILE|none")]
    pub(crate) mask: Option<PathBuf>,
    /// Known lights: lines of `x y z` as in DiLiGenT's light_directions.txt, an .lp file, or our
    /// lights.csv.
    ///
    /// Without it the lights are estimated; light files lying beside the photographs are not used.
    #[arg(long, value_name = "FILE")]
    pub(crate) lights: Option<PathBuf>,
    /// Which way the axes of the light file point, as in x-right,y-down,z-in.
    ///
    /// Each of x, y and z: right, left, up, down, out (to the camera) or in. Default: x-right,y-up,z-out.
    #[arg(long, value_name = "AXES", requires = "lights", default_value_t)]
    pub(crate) light_axes: LightAxes,
    /// Use only this many photographs, evenly spaced.
    #[arg(long, value_name = "N")]
    pub(crate) images: Option<usize>,
    /// Which way green points in normals.png; normals.npy always has y up.
    #[arg(long, value_enum, value_name = "FORMAT", default_value = "opengl")]
    pub(crate) normal_format: FormatChoice,
    /// How the numbers in the photographs relate to light.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) color: ColorChoice,
    #[command(flatten)]
    pub(crate) estimation: EstimationArgs,
    /// Name every file in what is said about the input.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
    /// Say nothing about the input, show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const ESTIMATE_EXAMPLES: &str = "\
Results: normals.png (16 bit), normals.npy, lights.csv, lights.lp, lights.svg, albedo.png, mask.png, report.json.

Examples:
  normalight estimate vase --out vase-normals
  normalight estimate vase/*.jpg --mask vase-mask.png --out vase-normals --normal-format directx";

/// How to get from photographs to normals; the same for `estimate` and `evaluate`.
#[derive(Debug, Args)]
pub(crate) struct EstimationArgs {
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
    /// What good lights and normals may cost: they are averaged over mirrored and turned views of the
    /// photographs.
    #[arg(long, value_enum, default_value = "default")]
    pub(crate) quality: QualityChoice,
    /// How the light network's classes become numbers.
    #[arg(long, value_enum, default_value = "soft-argmax")]
    pub(crate) decoding: DecodingChoice,
    /// Keep the light network's answer as it is instead of refitting the lights to the normals.
    #[arg(long)]
    pub(crate) no_refit: bool,
    /// Another light network than the one inside this program.
    #[arg(long, value_name = "FILE")]
    pub(crate) light_weights: Option<PathBuf>,
    /// Another normal network than the one inside this program.
    #[arg(long, value_name = "FILE")]
    pub(crate) normal_weights: Option<PathBuf>,
}

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
Example: train the light network, and continue after a break
  normalight train light --recipe models/recipes/light.toml --run runs/light
  normalight train light --recipe models/recipes/light.toml --run runs/light --resume

Exit codes: 0 finished, 1 error, 2 wrong usage, 3 diverged (loss or gradient no number any more),
130 stopped by Ctrl-C or SIGTERM after writing a checkpoint. summary.json says the same:
  state (running, finished, interrupted, failed), reason, exit_code, network, parameters, seed, steps,
  steps_planned, best (step, degrees, figures), loss, hours, hours_waited, weights_sha256,
  recipe_sha256, version";

/// Draws synthetic stacks with known lights and normals.
///
/// A recipe describes the distribution of shapes, materials, lights and cameras. Stack number k of a
/// recipe is the same on every machine.
#[derive(Debug, Args)]
#[command(after_help = RENDER_EXAMPLES)]
pub(crate) struct RenderArgs {
    /// `world`, `classic`, or a TOML file.
    ///
    /// world: as people photograph things. classic: what the published training sets contain. A file
    /// names a preset and what differs from it.
    #[arg(long, value_name = "NAME|FILE", default_value = "world")]
    pub(crate) recipe: String,
    #[command(flatten)]
    pub(crate) library: LibraryArgs,
    /// Number of stacks.
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) count: u32,
    /// Number of the first one.
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(crate) first: u64,
    /// Images of a stack.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(3..=1024))]
    pub(crate) images: u32,
    /// Side of the images in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 128, value_parser = clap::value_parser!(u32).range(16..=2048))]
    pub(crate) size: u32,
    /// Bits of a stored value.
    #[arg(long, value_enum, default_value = "8")]
    pub(crate) bits: BitsChoice,
    /// Folder for the stacks, in the layout of the published Blobby and Sculpture sets; made when
    /// missing. Every hundredth stack is for validation.
    #[arg(long, value_name = "DIR", required_unless_present = "stats")]
    pub(crate) out: Option<PathBuf>,
    /// Write a contact sheet of normals and photographs as well: sheet.png.
    #[arg(long, requires = "out")]
    pub(crate) sheet: bool,
    /// Print what the stacks look like in numbers.
    #[arg(long)]
    pub(crate) stats: bool,
    /// Print the same for real objects: a folder in DiLiGenT's layout.
    #[arg(long, value_name = "DIR", requires = "stats")]
    pub(crate) compare: Option<PathBuf>,
    /// Show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const RENDER_EXAMPLES: &str = "\
Examples:
  normalight render --count 1000 --out stacks
  normalight render --recipe classic --merl merl_nbrdf.npz --count 24 --out look --sheet
  normalight render --stats --count 200 --compare DiLiGenT/pmsData";

/// Materials and shapes from files of the user's.
#[derive(Debug, Args)]
pub(crate) struct LibraryArgs {
    /// Measured materials: an .npz file of fitted networks, `W` of [materials, 675].
    ///
    /// Seven in ten materials then come from it, if the recipe says nothing else.
    #[arg(long, value_name = "FILE")]
    pub(crate) merl: Option<PathBuf>,
    /// A folder or a list of OBJ, PLY and GLB meshes, which become a third of the objects if the recipe says
    /// nothing else.
    ///
    /// Folders are searched with those in them; a list is a text file with one path a line. Given several
    /// times, all are drawn from equally often.
    #[arg(long, value_name = "DIR")]
    pub(crate) meshes: Vec<PathBuf>,
}

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
