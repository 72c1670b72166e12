//! `average`: of two trainings that went on from one start, and of strangers.
use crate::common::*;
use std::path::{Path, PathBuf};
use std::process::Command;

const RECIPE: &str = "network = \"normal\"\nsteps = 2\nsize = 16\nbatch = 2\nimages = [3, 4]\n\
    validate_every = 2\nvalidation_objects = 1\n[optimiser]\nwarm_up = 2\n";

/// A training of two steps; its weights.
fn trained(folder: &Path, name: &str, more: &str, seed: &str) -> PathBuf {
    let recipe = folder.join(format!("{name}.toml"));
    std::fs::write(&recipe, format!("{more}{RECIPE}")).unwrap();
    let run = folder.join(name);
    let mut command = normalight(&["train", "normal", "--seed", seed, "--quiet"]);
    command.args(["--recipe", path(&recipe), "--run", path(&run)]);
    ended(command, 0);
    run.join("weights.safetensors")
}

fn average(weights: &[&Path], out: &Path, more: &[&str]) -> Command {
    let mut command = normalight(&["average"]);
    command.args(weights).args(["--out", path(out)]).args(more);
    command
}

#[test]
fn trainings_from_one_start_are_averaged_and_measured() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    trained(folder, "start", "", "1");
    let init = "init = \"start/weights.safetensors\"\n";
    let weights = ["2", "3"].map(|seed| trained(folder, &format!("on{seed}"), init, seed));
    let [one, other] = [weights[0].as_path(), weights[1].as_path()];
    let (out, report) = (
        folder.join("new/mean.safetensors"),
        folder.join("mean.json"),
    );
    let recipe = folder.join("start.toml");
    let more = ["--recipe", path(&recipe), "--report", path(&report)];
    let output = ended(average(&[one, other], &out, &more), 0);
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.contains("1 objects") && said.contains("their average"),
        "{said}"
    );
    let noted = String::from_utf8(output.stderr).unwrap();
    assert!(!noted.contains("one start"), "{noted}");
    let report = read_json(&report);
    // What the trainings measured of the same weights, before they were stored in half precision.
    for (network, weights) in report["networks"]
        .as_array()
        .unwrap()
        .iter()
        .zip([one, other])
    {
        let summary = read_json(&weights.with_file_name("summary.json"));
        let (here, there) = (&network["degrees"], &summary["best"]["degrees"]);
        let difference = here.as_f64().unwrap() - there.as_f64().unwrap();
        assert!(difference.abs() < 0.05, "{here} {there}");
        assert_eq!(network["sha256"], summary["weights_sha256"]);
    }
    assert!(report["average"].as_f64().unwrap() > 0.0);
    // The mean of one network is that network.
    let alone = folder.join("alone.json");
    let more = ["--recipe", path(&recipe), "--report", path(&alone)];
    ended(average(&[one, one], &out, &more), 0);
    let alone = read_json(&alone);
    assert_eq!(alone["average"], alone["networks"][0]["degrees"]);
}

#[test]
fn strangers_are_named_and_other_networks_refused() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let [one, other] = ["1", "2"].map(|seed| trained(folder, &format!("from{seed}"), "", seed));
    let out = folder.join("mean.safetensors");
    let output = ended(average(&[&one, &other], &out, &[]), 0);
    let noted = String::from_utf8(output.stderr).unwrap();
    assert!(noted.contains("not trained from one start"), "{noted}");
    std::fs::remove_file(&out).unwrap();
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/default");
    fails(
        average(&[&one, &shipped.join("normal.safetensors")], &out, &[]),
        &["normal.safetensors", "another architecture"],
    );
    fails(average(&[&one, &folder.join("none")], &out, &[]), &["none"]);
    // The recipe is of another network than the weights.
    let light = folder.join("light.toml");
    std::fs::write(
        &light,
        RECIPE.replace("normal", "light").replace("16", "64"),
    )
    .unwrap();
    fails(
        average(&[&one, &one], &out, &["--recipe", path(&light)]),
        &["holds a normal network"],
    );
    assert!(!out.exists());
}
