//! `export`.
use crate::choices::NetworkChoice;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// Writes a network in the format of other programs.
#[derive(Debug, Args)]
pub(crate) struct ExportArgs {
    #[command(subcommand)]
    pub(crate) format: ExportFormat,
}

#[derive(Debug, Subcommand)]
pub(crate) enum ExportFormat {
    /// ONNX, which most runtimes and converters read.
    ///
    /// The model is the network alone, in single precision, for any number of photographs. Its metadata say what goes in,
    /// and how it is made of photographs: the view of the object for `light`, colours without albedo for `normal`.
    Onnx(OnnxArgs),
}

#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct OnnxArgs {
    /// Which network.
    #[arg(value_enum)]
    pub(crate) network: NetworkChoice,
    /// The model to write.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// A weights file instead of the network inside the program.
    #[arg(long, value_name = "FILE")]
    pub(crate) weights: Option<PathBuf>,
    /// A folder for an input of the model and what our network makes of it, as NumPy arrays: to check what another program
    /// makes of the model.
    #[arg(long, value_name = "DIR")]
    pub(crate) example: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Example: the network inside the program, and what another program should get from it
  normalight export onnx normal --out normal.onnx --example normal-example";
