//! Training on sets in the layout of Blobby and Sculpture.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::tensor::Device;
use normalight_io::{ObjectToPublish, PublishedEntry, PublishedPart, PublishedWriter};
use normalight_run::{Caller, RunEvent};
use normalight_synth::{BitDepth, Framing, Preset, Renderer};
use normalight_train::{TrainError, TrainRecipe, TrainRun, train};
use std::ops::ControlFlow;
use std::path::Path;

const SHAPES: u64 = 6;
const IMAGES: usize = 8;

/// Six shapes of one material, 64x64 pixels, and no validation list.
fn write_set(folder: &Path) {
    let renderer = Renderer::new(Preset::Classic.recipe()).unwrap();
    let mut writer = PublishedWriter::create(folder).unwrap();
    for number in 0..SHAPES {
        let sample = renderer.sample(number, IMAGES, 64, Framing::WholeObject);
        let entry = PublishedEntry::new(&format!("blob{number}"), "wax").unwrap();
        let object = ObjectToPublish {
            entry: &entry,
            images: &sample.to_stack_images(BitDepth::Eight),
            normals: &sample.to_normal_map(),
            mask: &sample.to_mask(),
            depth: None,
            lights: &sample.lights,
        };
        writer.write(&object, PublishedPart::Train).unwrap();
    }
    writer.finish().unwrap();
}

/// Losses of a few steps.
fn losses(set: &Path, part: &str, more: &str) -> Result<Vec<f32>, TrainError> {
    let place = tempfile::tempdir().unwrap();
    let text = format!(
        "steps = 3\nbatch = 2\nimages = [4, 6]\nvalidation_objects = 2\n{more}\n\
         [scene]\npreset = \"classic\"\n[published]\nfolder = {:?}\npart = {part:?}\n",
        set.to_str().unwrap()
    );
    let run = TrainRun {
        recipe: TrainRecipe::parse("recipe.toml", &text)?,
        folder: place.path().join("run"),
        resume: false,
        caller: Caller::default(),
    };
    let mut losses = Vec::new();
    train(&run, &Device::flex(), |event| {
        if let RunEvent::Step(report) = event {
            losses.push(report.loss);
        }
        ControlFlow::Continue(())
    })?;
    assert!(run.folder.join("weights.safetensors").exists());
    Ok(losses)
}

#[test]
fn both_networks_train_on_a_published_set() {
    let place = tempfile::tempdir().unwrap();
    write_set(place.path());
    for part in ["train", "search"] {
        for network in [
            "network = \"light\"\nsize = 64",
            "network = \"normal\"\nsize = 32",
        ] {
            let once = losses(place.path(), part, network).unwrap();
            assert_eq!(once.len(), 3);
            assert!(once.iter().all(|loss| loss.is_finite()));
            // The order of samples is the recipe's, not chance.
            assert_eq!(losses(place.path(), part, network).unwrap(), once);
        }
    }
}

#[test]
fn sets_that_do_not_fit_are_errors() {
    let place = tempfile::tempdir().unwrap();
    let missing = losses(
        &place.path().join("gone"),
        "train",
        "network = \"light\"\nsize = 64",
    );
    assert!(missing.unwrap_err().to_string().contains("train_mtrl.txt"));
    write_set(place.path());
    // Larger pictures than there are.
    let large = losses(place.path(), "train", "network = \"normal\"\nsize = 96").unwrap_err();
    assert!(large.to_string().contains("64x64"), "{large}");
}
