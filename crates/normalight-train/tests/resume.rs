//! A run that was stopped goes on exactly where it was.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod common;

use common::*;
use normalight_model::Weights;
use normalight_run::{RunError, RunState};
use normalight_train::{TrainError, TrainRecipe};
use std::path::Path;

/// Networks with everything that has a state: batch norm, the auxiliary tower, averaged weights.
fn with_state() -> Vec<(&'static str, String)> {
    let genotypes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/genotypes/paper.json");
    let genotypes = genotypes.to_str().unwrap();
    let shared = "steps = 8\nvalidate_every = 4\n[optimiser]\nwarm_up = 2\naverage = 0.9\n\
                  weight_decay = 0.01\n";
    // Muon keeps a state of another kind.
    let muon = "kind = \"muon\"\nmuon = { depthwise = \"filters\" }\n";
    vec![
        ("plain normal", format!("{NORMAL}{shared}")),
        ("plain normal, Muon", format!("{NORMAL}{shared}{muon}")),
        ("plain light, Muon", format!("{LIGHT}{shared}{muon}")),
        (
            "branch of single pixels, residual layers",
            format!(
                "{NORMAL}{shared}{muon}[normal.architecture]\nmask_channel = false\n\
                 [normal.architecture.body]\nkind = \"plain\"\nwidths = [4, 8, 8]\nhead = 4\n\
                 residuals = 2\npixel_branch = 4\n"
            ),
        ),
        (
            "normal cells, Muon",
            format!(
                "{NORMAL}{shared}{muon}[normal.architecture]\nmask_channel = true\n\
                 [normal.architecture.body]\nkind = \"cells\"\nwidth = 2\nstem_strides = [1, 2]\n\
                 upsampling = \"transposed\"\nfused_convolutions = 2\ngenotype = {genotypes:?}\n"
            ),
        ),
        ("plain light", format!("{LIGHT}{shared}")),
        (
            "light cells",
            format!(
                "{LIGHT}{shared}[light.architecture]\ninput_size = 64\n\
                 bins = {{ azimuth = 36, elevation = 36, intensity = {{ count = 20, low = 0.2, \
                 high = 2.0, spacing = \"linear\" }} }}\n\
                 [light.architecture.body]\nkind = \"cells\"\nwidth = 2\nstem_strides = [2, 2]\n\
                 hidden = 8\ngenotype = {genotypes:?}\n"
            ),
        ),
    ]
}

#[test]
fn a_resumed_run_is_the_same_bit_for_bit() {
    for (name, text) in with_state() {
        let recipe = recipe(&text);
        let (straight, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let all = whole(straight.path(), &recipe);
        let first = run(broken.path(), &recipe, false, Some(3)).unwrap();
        assert_eq!(first.summary.state, RunState::Interrupted);
        let second = run(broken.path(), &recipe, true, None).unwrap();
        assert_eq!([first.losses, second.losses].concat(), all.losses, "{name}");
        let (straight, broken) = (contents(straight.path()), contents(broken.path()));
        assert!(
            straight["weights.safetensors"] == broken["weights.safetensors"],
            "{name}"
        );
        // But for the times.
        assert_eq!(second.summary.best, all.summary.best);
        let weights = Weights::from_bytes(name, &broken["weights.safetensors"]).unwrap();
        let device = burn::tensor::Device::flex();
        // Every tensor is used and none is missing: nothing of the auxiliary tower is left.
        match recipe.network.kind().name() {
            "light" => drop(weights.light_network(&device).unwrap()),
            _ => drop(weights.normal_network(&device).unwrap()),
        }
    }
}

#[test]
fn a_truncated_checkpoint_costs_one_interval() {
    let recipe = recipe(&format!("{NORMAL}steps = 8\nvalidate_every = 8\n"));
    let (straight, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let all = whole(straight.path(), &recipe);
    run(broken.path(), &recipe, false, Some(5)).unwrap();
    let newest = broken.path().join("checkpoint.safetensors");
    let bytes = std::fs::read(&newest).unwrap();
    std::fs::write(&newest, &bytes[..bytes.len() / 2]).unwrap();
    let rest = run(broken.path(), &recipe, true, None).unwrap();
    assert_eq!(rest.losses, all.losses[4..]);
    let note = &rest.notes[0];
    assert!(
        note.contains("checkpoint.safetensors") && note.contains("before"),
        "{note}"
    );
    assert!(text(broken.path(), "log.txt").contains(note));
    let (straight, broken) = (contents(straight.path()), contents(broken.path()));
    assert!(straight["weights.safetensors"] == broken["weights.safetensors"]);
}

#[test]
fn a_run_can_be_made_longer_and_nothing_else() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("run");
    let short = recipe(&format!(
        "{NORMAL}steps = 2\n[optimiser]\nschedule = {{ kind = \"constant\" }}\n"
    ));
    whole(&folder, &short);
    let mut long = short.clone();
    (long.steps, long.loader_threads) = (4, Some(2));
    // Not by accident.
    let refused = run(&folder, &long, false, None).unwrap_err();
    assert!(
        matches!(refused, TrainError::Run(RunError::Unfinished { .. })),
        "{refused}"
    );
    let ran = run(&folder, &long, true, None).unwrap();
    assert_eq!((ran.losses.len(), ran.summary.steps), (2, 4));
    assert!(
        ran.notes[0].contains("steps was 2, is 4"),
        "{:?}",
        ran.notes
    );
    // With a constant rate it is what the long run would have been.
    let straight = tempfile::tempdir().unwrap();
    let all = whole(straight.path(), &long);
    assert_eq!(all.losses[2..], ran.losses);

    let before = contents(&folder);
    let mut other = long.clone();
    other.optimiser.learning_rate = 0.5;
    other.scene.shapes.blob = 0.75;
    let message = run(&folder, &other, true, None).unwrap_err().to_string();
    for part in [
        "optimiser.learning_rate was 0.001, is 0.5",
        "scene.shapes.blob was 0.3, is 0.75",
    ] {
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(before, contents(&folder));
}

#[test]
fn a_checkpoint_without_the_tower_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("{NORMAL}steps = 4\n[normal]\nauxiliary_weight = 0.0\n");
    run(folder.path(), &recipe(&text), false, Some(2)).unwrap();
    let with = recipe(&text.replace("0.0", "0.4"));
    let kept = folder.path().join("recipe.toml");
    std::fs::write(kept, with.to_toml().unwrap()).unwrap();
    let message = run(folder.path(), &with, true, None)
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("checkpoint.safetensors: weight auxiliary."),
        "{message}"
    );
}

/// The recipes that come with the project.
#[test]
fn shipped_recipes_are_sound() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/recipes");
    let read = |name: &str| TrainRecipe::read(&folder.join(name)).unwrap();
    for (cells, plain) in [
        ("cells-light.toml", "light.toml"),
        ("normal.toml", "plain-normal.toml"),
    ] {
        // As costly, or less.
        assert!(
            read(cells).parameters() <= read(plain).parameters(),
            "{cells}"
        );
    }
    // As published: 4.4 million weights.
    let weights: usize = ["paper-light.toml", "paper-normal.toml"]
        .map(|name| read(name).parameters())
        .iter()
        .sum();
    assert!((4_350_000..4_450_000).contains(&weights), "{weights}");
}
