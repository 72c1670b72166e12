//! `normalight export`.
mod example;

use crate::Outcome;
use crate::args::{ExportArgs, ExportFormat, OnnxArgs};
use crate::choices::{DeviceChoice, NetworkChoice};
use crate::device;
use crate::output_file::place;
use anyhow::Result;
use normalight_io::OutputFolder;
use normalight_model::{Weights, default_weights};
use normalight_onnx::to_onnx;
use normalight_train::read_weights;

/// A network in, files for other programs out.
pub(crate) fn run(args: &ExportArgs) -> Result<Outcome> {
    match &args.format {
        ExportFormat::Onnx(args) => onnx(args),
    }
}

fn onnx(args: &OnnxArgs) -> Result<Outcome> {
    let weights = weights(args)?;
    let (folder, name) = place(&args.out)?;
    let example_folder = args.example.as_deref().map(OutputFolder::prepare);
    let example_folder = example_folder.transpose()?;
    let device = device::open(DeviceChoice::Cpu)?.device;
    // A network that loads has all of its tensors in their shapes, which the model needs, too.
    let example = match args.network {
        NetworkChoice::Light => {
            let loaded = weights.light_network(&device)?;
            example_folder.map(|folder| anyhow::Ok((folder, example::light(&loaded)?)))
        }
        NetworkChoice::Normal => {
            let loaded = weights.normal_network(&device)?;
            example_folder.map(|folder| anyhow::Ok((folder, example::normal(&loaded)?)))
        }
    };
    let example = example.transpose()?;
    folder.write(&[(name, to_onnx(&weights)?)])?;
    if let Some((folder, files)) = example {
        folder.write(&files)?;
    }
    Ok(Outcome::Done)
}

fn weights(args: &OnnxArgs) -> Result<Weights> {
    if let Some(path) = &args.weights {
        return Ok(read_weights(path)?);
    }
    let [light, normal] = default_weights()?;
    Ok(match args.network {
        NetworkChoice::Light => light,
        NetworkChoice::Normal => normal,
    })
}
