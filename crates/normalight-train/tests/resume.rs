//! A tiny run: the loss falls, and a resumed run continues exactly.

use burn::tensor::Device;
use normalight_model::Weights;
use normalight_train::{TrainRecipe, TrainRun, train};
use std::ops::ControlFlow;
use std::path::Path;

fn run(folder: &Path, network: &str, size: usize, steps: usize, stop_at: usize) -> Vec<f32> {
    let text = format!(
        "network = \"{network}\"\nsteps = {steps}\nsize = {size}\nbatch = 2\nimages = [3, 4]\n\
         warm_up = 2\nvalidate_every = {steps}\nvalidation_objects = 1\ncheckpoint_every = 100\n"
    );
    let run = TrainRun {
        recipe: TrainRecipe::parse("recipe.toml", &text).unwrap(),
        folder: folder.to_owned(),
        resume: true,
    };
    let mut losses = Vec::new();
    train(&run, &Device::flex(), |report| {
        losses.push(report.loss);
        if report.step == stop_at {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })
    .unwrap();
    losses
}

#[test]
fn a_resumed_run_continues_and_leaves_weights() {
    for (network, size) in [("normal", 16), ("light", 64)] {
        let folder = tempfile::tempdir().unwrap();
        let first = run(folder.path(), network, size, 8, 4);
        assert_eq!(first.len(), 4);
        let second = run(folder.path(), network, size, 8, 0);
        assert_eq!(second.len(), 4, "only the steps that were left");
        assert!(first.iter().chain(&second).all(|loss| loss.is_finite()));
        let weights = std::fs::read(folder.path().join("weights.safetensors")).unwrap();
        Weights::from_bytes("weights", &weights).unwrap();
        assert!(folder.path().join("curves.csv").exists());
        // Nothing is left to do.
        assert!(run(folder.path(), network, size, 8, 0).is_empty());
    }
}

#[test]
fn a_run_that_goes_on_with_other_objects_forgets_its_best() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "normal", 16, 4, 0);
    for (scene, forgotten) in [("world", false), ("classic", true)] {
        let text = format!(
            "network = \"normal\"\nsteps = 9\nsize = 16\nbatch = 2\nimages = [3, 4]\n\
             validate_every = 100\nvalidation_objects = 1\n[scene]\npreset = \"{scene}\"\n"
        );
        let again = TrainRun {
            recipe: TrainRecipe::parse("recipe.toml", &text).unwrap(),
            folder: folder.path().to_owned(),
            resume: true,
        };
        let mut best = None;
        train(&again, &Device::flex(), |report| {
            best = Some(report.best);
            ControlFlow::Break(())
        })
        .unwrap();
        assert_eq!(best.unwrap().is_infinite(), forgotten, "{scene}");
    }
}

/// The recipes that come with the project.
#[test]
fn shipped_recipes_are_sound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/recipes");
    for name in ["light.toml", "normal.toml"] {
        TrainRecipe::read(&folder.join(name)).unwrap();
    }
}
