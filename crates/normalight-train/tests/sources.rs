//! Where samples, lights and first weights come from.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod common;

use common::*;
use normalight_model::{Architecture, Weights};
use normalight_train::{NetworkRecipe, TrainRecipe};
use std::path::Path;

fn losses(recipe: &TrainRecipe) -> Vec<f32> {
    let folder = tempfile::tempdir().unwrap();
    whole(folder.path(), recipe).losses
}

#[test]
fn threads_change_no_batch() {
    for network in [NORMAL, LIGHT] {
        let mut recipe = recipe(&format!("{network}steps = 20\n"));
        recipe.loader_threads = Some(1);
        let one = losses(&recipe);
        recipe.loader_threads = Some(3);
        assert_eq!(losses(&recipe), one);
    }
}

#[test]
fn a_cache_is_filled_once_and_read_after_that() {
    let place = tempfile::tempdir().unwrap();
    let cache = place.path().join("cache");
    for (network, steps, scenes) in [(NORMAL, 20, 3), (LIGHT, 4, 5)] {
        let text = |more: &str| {
            format!(
                "{network}steps = {steps}\n[cache]\nfolder = {:?}\nscenes = {scenes}\n{more}",
                cache.to_str().unwrap()
            )
        };
        let recipe_of_cache = recipe(&text(""));
        let first = losses(&recipe_of_cache);
        let kept = contents(&cache);
        assert_eq!(kept.len(), 1 + scenes);
        assert_eq!(losses(&recipe_of_cache), first);
        assert_eq!(contents(&cache), kept);
        // Samples vary though their scenes return.
        assert!(
            first
                .iter()
                .all(|loss| first.iter().filter(|l| *l == loss).count() == 1)
        );
        // Cameras are not kept, so they may differ; objects may not.
        let other_camera = recipe(&text("[scene.camera]\nmean = [0.1, 0.2]\n"));
        assert_ne!(losses(&other_camera), first);
        assert_eq!(contents(&cache), kept);
        let run_folder = tempfile::tempdir().unwrap();
        for (more, part) in [
            ("[scene.shapes]\nblob = 0.9\n", "[scene]"),
            ("[scene.lights]\nring = 0.9\n", "[scene]"),
        ] {
            let refused = run(run_folder.path(), &recipe(&text(more)), false, None);
            let message = refused.unwrap_err().to_string();
            assert!(
                message.contains("cache.json") && message.contains(part),
                "{message}"
            );
        }
        let mut larger = recipe_of_cache.clone();
        larger.images = [3, 40];
        let refused = run(run_folder.path(), &larger, false, None).unwrap_err();
        assert!(refused.to_string().contains("lamps"), "{refused}");
        // A damaged scene is named.
        std::fs::write(cache.join("scene-00000001.safetensors"), "x").unwrap();
        let refused = run(run_folder.path(), &recipe_of_cache, false, None).unwrap_err();
        assert!(refused.to_string().contains("scene-00000001"), "{refused}");
        std::fs::remove_dir_all(&cache).unwrap();
    }
}

#[test]
fn lights_are_true_perturbed_or_predicted() {
    let with = |truth: f32, perturbed: f32, predicted: f32| {
        let text = format!(
            "{NORMAL}steps = 3\n[normal.lights]\ntrue = {truth:?}\nperturbed = {perturbed:?}\n\
             predicted = {predicted:?}\n"
        );
        losses(&recipe(&text))
    };
    let [truth, perturbed, predicted] = [
        with(1.0, 0.0, 0.0),
        with(0.0, 1.0, 0.0),
        with(0.0, 0.0, 1.0),
    ];
    for (one, other) in [
        (&truth, &perturbed),
        (&truth, &predicted),
        (&perturbed, &predicted),
    ] {
        // The weights are the same at first: only the lights differ.
        assert_ne!(one[0], other[0]);
        assert!((one[0] - other[0]).abs() < 0.5 * one[0]);
    }
    // Predictions do not depend on threads either.
    assert_eq!(with(0.0, 0.0, 1.0), predicted);
}

#[test]
fn a_run_starts_from_weights() {
    let place = tempfile::tempdir().unwrap();
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/default");
    for (network, file) in [(NORMAL, "normal"), (LIGHT, "light")] {
        let mut recipe = recipe(&format!("{network}steps = 1\n"));
        // Crops, images and a batch as in training: two small crops of three images say little.
        recipe.images = [8, 8];
        recipe.size = recipe.size.max(32);
        recipe.batch = 8;
        let path = models.join(format!("{file}.safetensors"));
        let shipped = Weights::from_bytes(file, &std::fs::read(&path).unwrap()).unwrap();
        match (shipped.architecture().clone(), &mut recipe.network) {
            (Architecture::Light(light), NetworkRecipe::Light(settings)) => {
                settings.architecture = light;
            }
            (Architecture::Normal(normal), NetworkRecipe::Normal(settings)) => {
                // The tower has no weights to start from.
                settings.auxiliary_weight = 0.0;
                settings.architecture = normal;
            }
            _ => panic!("weights of the other network"),
        }
        let random = losses(&recipe);
        recipe.init = Some(path);
        let trained = losses(&recipe);
        assert!(
            trained[0] < 0.7 * random[0],
            "{trained:?} against {random:?}"
        );
        // Of the other network.
        let other = if file == "normal" { "light" } else { "normal" };
        recipe.init = Some(models.join(format!("{other}.safetensors")));
        let folder = place.path().join(file);
        let message = run(&folder, &recipe, false, None).unwrap_err().to_string();
        assert!(message.contains(other), "{message}");
    }
    // Of another width.
    let text = "[normal.architecture]\nmask_channel = false\n[normal.architecture.body]\n\
                kind = \"plain\"\nwidths = [8, 16, 32]\nhead = 16\n";
    let mut narrow = recipe(&format!("{NORMAL}steps = 1\n{text}"));
    narrow.init = Some(models.join("normal.safetensors"));
    let message = run(&place.path().join("run"), &narrow, false, None).unwrap_err();
    assert!(
        message
            .to_string()
            .contains("architecture is not the recipe's"),
        "{message}"
    );
}

#[test]
fn folded_cells_cannot_be_trained_on() {
    let genotypes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/genotypes/paper.json");
    let text = format!(
        "{NORMAL}steps = 1\n[normal.architecture]\nmask_channel = false\n\
         [normal.architecture.body]\nkind = \"cells\"\nwidth = 1\nstem_strides = [1, 2]\n\
         upsampling = \"nearest\"\nfused_convolutions = 1\ngenotype = {:?}\n",
        genotypes.to_str().unwrap()
    );
    let mut recipe = recipe(&text);
    let first = tempfile::tempdir().unwrap();
    whole(first.path(), &recipe);
    recipe.init = Some(first.path().join("weights.safetensors"));
    let second = tempfile::tempdir().unwrap();
    let message = run(second.path(), &recipe, false, None).unwrap_err();
    assert!(
        message.to_string().contains("batch normalisation"),
        "{message}"
    );
}

#[test]
fn a_genotype_file_must_hold_the_network() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("recipe.toml");
    std::fs::write(folder.path().join("g.json"), "{\"source\": \"nowhere\"}").unwrap();
    let text = |file: &str| {
        format!(
            "{NORMAL}steps = 1\n[normal.architecture]\nmask_channel = false\n\
             [normal.architecture.body]\nkind = \"cells\"\nwidth = 1\nstem_strides = [1, 2]\n\
             upsampling = \"nearest\"\nfused_convolutions = 1\ngenotype = {file:?}\n"
        )
    };
    for (file, part) in [
        ("g.json", "no cells of a normal network"),
        ("gone.json", "gone.json"),
    ] {
        std::fs::write(&path, text(file)).unwrap();
        let message = TrainRecipe::read(&path).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}
