//! `train`: a run of two steps, its continuation, and what it refuses.
mod common;

use common::*;
use std::path::{Path, PathBuf};
use std::process::Command;

fn recipe(folder: &Path, network: &str, steps: usize) -> PathBuf {
    let size = if network == "light" { 64 } else { 16 };
    let text = format!(
        "network = \"{network}\"\nsteps = {steps}\nsize = {size}\nbatch = 2\nimages = [3, 4]\n\
         warm_up = 2\nvalidate_every = 2\nvalidation_objects = 1\n"
    );
    let path = folder.join("recipe.toml");
    std::fs::write(&path, text).unwrap();
    path
}

fn train(network: &str, recipe: &Path, out: &Path, more: &[&str]) -> Command {
    let mut command = normalight(&["train", network]);
    command
        .args(["--recipe", path(recipe), "--out", path(out)])
        .args(more);
    command
}

#[test]
fn two_steps_and_two_more() {
    let place = tempfile::tempdir().unwrap();
    for network in ["light", "normal"] {
        let out = place.path().join(network);
        let said_at_first = said(train(network, &recipe(place.path(), network, 2), &out, &[]));
        assert!(said_at_first.contains("degrees"), "{said_at_first}");
        let curves = || std::fs::read_to_string(out.join("curves.csv")).unwrap();
        assert_eq!(curves().lines().count(), 2);
        let longer = recipe(place.path(), network, 4);
        fails(train(network, &longer, &out, &[]), &[network, "--resume"]);
        said(train(network, &longer, &out, &["--resume", "--quiet"]));
        assert_eq!(curves().lines().count(), 3);
        // The weights go straight into the pipeline.
        let photographs = place.path().join("vase");
        write_stack(&photographs, &sample());
        let weights = out.join("weights.safetensors");
        let option = format!("--{network}-weights");
        let results = place.path().join("results");
        said(estimate(&photographs, &results, &[&option, path(&weights)]));
    }
}

#[test]
fn recipes_that_do_not_fit() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("run");
    let normal = recipe(place.path(), "normal", 2);
    fails(
        train("light", &normal, &out, &[]),
        &["recipe.toml", "light network"],
    );
    fails(
        train("light", Path::new("gone.toml"), &out, &[]),
        &["gone.toml"],
    );
    std::fs::write(&normal, "network = \"normal\"\nsteps = 0\nsize = 16\n").unwrap();
    fails(
        train("normal", &normal, &out, &[]),
        &["recipe.toml", "steps"],
    );
    assert!(!out.exists());
}
