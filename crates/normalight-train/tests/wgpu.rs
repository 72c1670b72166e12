//! Training on the GPU's code: a driver that imitates a GPU takes the same steps as the CPU.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::tensor::{Device, DeviceKind};
use normalight_run::{Caller, RunEvent, StepsOn};
use normalight_train::{Devices, TrainRecipe, TrainRun, train};
use safetensors::SafeTensors;
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;

/// Losses may differ by this share.
const LOSS_TOLERANCE: f32 = 1e-4;
/// Each layer's weights may end this share of their way apart: rounding moves a maximum from one
/// image to another now and then, and Adam makes much of gradients near zero.
const WEIGHT_TOLERANCE: f32 = 0.05;

/// A GPU imitated by the processor. Without one the test is left out, and says so, unless the
/// environment promises one, as `cargo xtask test` does where it can install it.
fn software_gpu() -> Option<Device> {
    match Device::wgpu_options().device_kind(DeviceKind::Cpu).init() {
        Ok(device) => Some(device),
        Err(error) => {
            let promised = std::env::var_os("NORMALIGHT_SOFTWARE_GPU").is_some();
            assert!(!promised, "no software GPU: {error}");
            // Past the test harness, which keeps back what passing tests print.
            let line = format!("SKIPPED training on a software GPU: {error}\n");
            std::io::stderr().write_all(line.as_bytes()).unwrap();
            None
        }
    }
}

/// Trains until a step, from the folder's checkpoint if there is one; returns the losses.
fn run(
    folder: &Path,
    (network, size, optimiser): (&str, usize, &str),
    devices: Devices<'_>,
    until: usize,
) -> Vec<f32> {
    let text = format!(
        "network = \"{network}\"\nsteps = 100\nsize = {size}\nbatch = 2\nimages = [3, 4]\n\
         validate_every = 100\nvalidation_objects = 1\n\
         [optimiser]\nkind = \"{optimiser}\"\nwarm_up = 2\n"
    );
    let run = TrainRun {
        recipe: TrainRecipe::parse("recipe.toml", &text).unwrap(),
        folder: folder.to_owned(),
        resume: true,
        caller: Caller::default(),
    };
    let mut losses = Vec::new();
    train(&run, devices, |event| {
        let RunEvent::Step(report) = event else {
            return ControlFlow::Continue(());
        };
        losses.push(report.loss);
        if report.step == until {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .unwrap();
    losses
}

/// All weights of a folder's checkpoint by name.
fn weights(folder: &Path) -> BTreeMap<String, Vec<f32>> {
    let bytes = std::fs::read(folder.join("checkpoint.safetensors")).unwrap();
    let file = SafeTensors::deserialize(&bytes).unwrap();
    let weights = file
        .iter()
        .filter(|(name, _)| name.starts_with("weight/"))
        .map(|(name, tensor)| {
            let values = tensor.data().chunks_exact(4);
            let values = values.map(|v| f32::from_le_bytes(v.try_into().unwrap()));
            (name.to_owned(), values.collect())
        });
    weights.collect()
}

/// Root of the sum of squared differences.
fn distance(one: &[f32], two: &[f32]) -> f32 {
    assert_eq!(one.len(), two.len());
    let pairs = one.iter().zip(two);
    pairs.map(|(a, b)| (a - b).powi(2)).sum::<f32>().sqrt()
}

#[test]
fn a_software_gpu_trains_like_the_cpu() {
    let Some(gpu) = software_gpu() else { return };
    let cpu = Device::flex();
    for case in [
        ("normal", 16, "adam"),
        ("normal", 16, "muon"),
        ("light", 64, "muon"),
    ] {
        let network = case.0;
        let [here, there] = [(); 2].map(|()| tempfile::tempdir().unwrap());
        // Every backend draws other random weights: both go on from one step on the CPU. The
        // batches of the steps after it are the same whoever asks.
        run(here.path(), case, (&cpu).into(), 1);
        for file in ["checkpoint.safetensors", "recipe.toml"] {
            std::fs::copy(here.path().join(file), there.path().join(file)).unwrap();
        }
        let start = weights(here.path());
        let expected = run(here.path(), case, (&cpu).into(), 5);
        // Nor do steps on the device take another way than those on the host.
        let devices = Devices {
            main: &gpu,
            others: &[],
            steps_on: StepsOn::Device,
        };
        let found = run(there.path(), case, devices, 5);
        assert_eq!((expected.len(), found.len()), (4, 4));
        for (found, expected) in found.iter().zip(&expected) {
            let apart = (found - expected).abs() / expected.abs();
            assert!(apart < LOSS_TOLERANCE, "{network}: {found} and {expected}");
        }
        let (expected, found) = (weights(here.path()), weights(there.path()));
        assert!(expected.len() > 10 && expected.keys().eq(found.keys()));
        for (name, end) in &expected {
            let apart = distance(&found[name], end) / distance(&start[name], end);
            assert!(
                apart < WEIGHT_TOLERANCE,
                "{network} {name}: {apart} of the way"
            );
        }
    }
}
