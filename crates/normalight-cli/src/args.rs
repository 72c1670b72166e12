//! What the commands take; these comments are their help.
mod average;
mod batch;
mod bench;
mod estimate;
mod evaluate;
mod export;
mod render;
mod search;
mod surface;
mod train;

pub(crate) use average::AverageArgs;
pub(crate) use batch::BatchArgs;
pub(crate) use bench::{
    BenchArgs, BenchBatchArgs, BenchCommand, BenchOpsArgs, BenchRenderArgs, BenchSearchArgs,
    BenchTrainArgs,
};
pub(crate) use estimate::{EstimateArgs, EstimationArgs};
pub(crate) use evaluate::EvaluateArgs;
pub(crate) use export::{ExportArgs, ExportFormat, OnnxArgs};
pub(crate) use render::{LibraryArgs, RenderArgs};
pub(crate) use search::{CompareArgs, DeriveArgs, SearchArgs, SearchCommand, SearchCommands};
pub(crate) use surface::{MeshArgs, SurfaceArgs};
pub(crate) use train::TrainArgs;

use clap::{Parser, Subcommand};

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
    /// Estimate every capture in a tree of folders.
    Batch(BatchArgs),
    /// Normals in, depth, a mesh and maps out.
    Mesh(MeshArgs),
    /// Train one of the two networks on rendered samples.
    Train(TrainArgs),
    /// Make one network of several that were trained from one start.
    Average(AverageArgs),
    /// Search for the cells of one of the two networks, and compare what was found.
    Search(SearchCommands),
    /// Write a network for other programs.
    Export(ExportArgs),
    /// Draw synthetic stacks with known lights and normals.
    Render(RenderArgs),
    /// Measure the speed of parts of the program on this machine.
    Bench(BenchArgs),
    /// Measure the errors on objects whose lights and normals are known.
    Evaluate(EvaluateArgs),
}
