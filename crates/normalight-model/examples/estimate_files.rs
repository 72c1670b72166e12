//! From a folder of photographs to a folder with the lights and the normals:
//!
//!     cargo run --release -p normalight-model --example estimate_files -- PHOTOS RESULT
use burn::tensor::Device;
use normalight_io::{ReadOptions, lights_csv, normals_npy, normals_png, read_paths, write_files};
use normalight_model::{EstimateInput, EstimateSettings, Estimator, NoopObserver, default_weights};
use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [photographs, result] = paths.as_slice() else {
        return Err("expected two folders: PHOTOS RESULT".into());
    };

    // What is no photograph in the folder is left out; a mask or a list in it counts.
    let input = read_paths(std::slice::from_ref(photographs), &ReadOptions::default())?;
    println!(
        "{} photographs, mask {}",
        input.stack.len(),
        input.mask_label()
    );

    // Both networks with the weights that ship, on the processor.
    let [light, normal] = default_weights()?;
    let estimator = Estimator::new(&light, &normal, Device::flex())?;
    let settings = EstimateSettings::default();
    let estimate = pollster::block_on(estimator.estimate(
        EstimateInput {
            stack: &input.stack,
            mask: &input.mask,
            lights: None,
        },
        settings,
        &mut NoopObserver,
    ))?;

    let files = [
        (
            "normals.png",
            normals_png(&estimate.normals, Default::default())?,
        ),
        ("normals.npy", normals_npy(&estimate.normals)?),
        (
            "lights.csv",
            lights_csv(&input.picked_names(), &estimate.lights)?,
        ),
    ];
    write_files(result, &files)?;
    Ok(())
}
