//! `search`: cells that are found, drawn at random and compared, and what is refused.
use crate::common::*;
use normalight_model::{Genotypes, paper_genotypes};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

const CELLS: &str = "[normal.architecture]\nmask_channel = false\n\
    [normal.architecture.body]\nkind = \"cells\"\nwidth = 4\nstem_strides = [1, 2]\nreductions = 1\n\
    upsampling = \"nearest\"\nfused_convolutions = 1\n";

/// A schedule, or a search, of very few steps.
fn recipe(folder: &Path, more: &str) -> PathBuf {
    let file = folder.join("recipe.toml");
    let text = format!(
        "network = \"normal\"\nsteps = 2\nsize = 16\nbatch = 2\nimages = [3, 4]\n\
         validation_objects = 1\n{more}{CELLS}"
    );
    std::fs::write(&file, text).unwrap();
    file
}

fn compare(paths: &[&Path], recipe: &Path, run: &Path, more: &[&str]) -> Command {
    let mut command = normalight(&["search", "compare"]);
    command
        .args(paths)
        .args(["--recipe", path(recipe), "--run", path(run)])
        .args(more);
    command
}

/// A genotype of nothing but one operation.
fn uniform(operation: &str) -> String {
    let edge = |from: usize| format!(r#"{{"operation": "{operation}", "from": {from}}}"#);
    let cell = format!(r#"{{"nodes": [[{}, {}]]}}"#, edge(0), edge(1));
    let names = ["feature_normal", "feature_reduction", "regressor_normal"];
    let cells = names.map(|name| format!(r#""{name}": {cell}"#)).join(", ");
    format!(r#"{{"source": "by hand", "normal": {{{cells}}}}}"#)
}

/// Every file below a folder.
fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let file = entry.unwrap().path();
        if file.is_dir() {
            found.extend(tree(&file));
        } else {
            found.insert(file.clone(), std::fs::read(&file).unwrap());
        }
    }
    found
}

#[test]
fn networks_are_compared_once() {
    let place = tempfile::tempdir().unwrap();
    let (run, recipe) = (place.path().join("run"), recipe(place.path(), ""));
    let [paper, hand] = ["paper.json", "hand.json"].map(|name| place.path().join(name));
    let json = serde_json::to_string(&paper_genotypes()).unwrap();
    std::fs::write(&paper, json).unwrap();
    std::fs::write(&hand, uniform("convolution_3x3")).unwrap();
    let ask = |more: &[&str]| {
        let more = [&["--plain", "--seeds", "2"], more].concat();
        compare(&[&paper, &hand], &recipe, &run, &more)
    };
    let table = said(ask(&[]));
    let found = read_json(&run.join("compare.json"));
    assert_eq!(found["state"], "finished");
    let target = found["multiply_adds"].as_f64().unwrap();
    let entries = found["entries"].as_array().unwrap();
    let names: Vec<_> = entries.iter().map(|one| &one["name"]).collect();
    assert_eq!(names, ["paper", "hand", "plain"]);
    for entry in entries {
        let name = entry["name"].as_str().unwrap();
        assert!(table.contains(name), "{table}");
        // Widths are even numbers, so that a step is at most a half of the narrowest.
        let share = entry["multiply_adds"].as_f64().unwrap() / target;
        assert!((0.6..1.6).contains(&share), "{name}: {share}");
        // The mean is that of the trainings' own summaries.
        let errors = [1, 2].map(|seed| {
            let summary = read_json(&run.join(format!("{name}-s{seed}/summary.json")));
            assert_eq!(summary["seed"], seed);
            assert_eq!(summary["parameters"], entry["parameters"]);
            summary["best"]["degrees"].as_f64().unwrap()
        });
        let number = |field: &str| entry[field].as_f64().unwrap();
        assert!((number("mean") - (errors[0] + errors[1]) / 2.0).abs() < 1e-4);
        let spread = (errors[0] - errors[1]).abs() / 2f64.sqrt();
        assert!((number("spread") - spread).abs() < 1e-4);
    }
    assert_eq!(
        entries[1]["operations"],
        serde_json::json!({"convolution_3x3": 6})
    );
    // The plain network that ships.
    assert_eq!(
        (&entries[2]["width"], &entries[2]["parameters"]),
        (&16.into(), &126_515.into())
    );

    // Once more: nothing is done, nothing changes.
    let before = tree(&run);
    assert_eq!(said(ask(&["--threads", "2"])), table);
    assert!(before == tree(&run));

    // Another comparison in the same folder is none.
    let message = ["compare.multiply_adds was", "is 9000000"];
    fails(ask(&["--multiply-adds", "9000000"]), &message);
    assert!(before == tree(&run));
    // A third seed is added to the first two.
    said(compare(
        &[&paper, &hand],
        &recipe,
        &run,
        &["--plain", "--seeds", "3"],
    ));
    let now = tree(&run);
    let kept = before
        .iter()
        .filter(|(file, _)| !file.ends_with("compare.json"));
    for (file, bytes) in kept {
        assert!(now[file] == *bytes, "{}", file.display());
    }
}

/// Stopped in its second training, a comparison keeps the first and goes on with the second.
#[cfg(unix)]
#[test]
fn an_interrupted_comparison_goes_on_where_it_was() {
    let place = tempfile::tempdir().unwrap();
    let run = place.path().join("run");
    let file = recipe(place.path(), "checkpoint_every = 5\n");
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, text.replace("steps = 2\n", "steps = 400\n")).unwrap();
    let ask = || compare(&[], &file, &run, &["--plain", "--seeds", "2"]);
    let nothing = std::process::Stdio::null;
    let mut stopped = ask();
    stopped.stdout(nothing()).stderr(nothing());
    let mut child = stopped.spawn().unwrap();
    while !run.join("plain-s2/checkpoint.safetensors").exists() {
        assert!(child.try_wait().unwrap().is_none(), "ended by itself");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let result = || read_json(&run.join("compare.json"));
    let stopped = result();
    assert_eq!(stopped["state"], "interrupted");
    let seeds = |result: &Value| result["entries"][0]["seeds"].as_array().unwrap().clone();
    assert_eq!(seeds(&stopped).len(), 1);
    let first = tree(&run.join("plain-s1"));
    said(ask());
    assert!(first == tree(&run.join("plain-s1")));
    let done = result();
    assert_eq!(done["state"], "finished");
    assert_eq!(seeds(&done)[0], seeds(&stopped)[0]);
    assert_eq!(seeds(&done).len(), 2);
    let log = std::fs::read_to_string(run.join("plain-s2/log.txt")).unwrap();
    assert!(log.contains("continued after step"), "{log}");
}

/// Trainings of equal time: measured once, even if what was measured would differ.
#[test]
fn equal_times_are_kept() {
    let place = tempfile::tempdir().unwrap();
    let (run, recipe) = (place.path().join("run"), recipe(place.path(), ""));
    let hand = place.path().join("hand.json");
    std::fs::write(&hand, uniform("separable_3x3")).unwrap();
    let ask = || {
        let more = ["--plain", "--equal", "training-time"];
        compare(&[&hand], &recipe, &run, &more)
    };
    said(ask());
    let times = read_json(&run.join("times.json"));
    let found = read_json(&run.join("compare.json"));
    let entries = found["entries"].as_array().unwrap();
    for (entry, time) in entries.iter().zip(times["entries"].as_array().unwrap()) {
        let name = entry["name"].as_str().unwrap();
        let summary = read_json(&run.join(format!("{name}-s1/summary.json")));
        for steps in [&entry["steps"], &summary["steps"]] {
            assert_eq!(*steps, time["steps"]);
        }
        assert_eq!(entry["step_seconds"], time["step_seconds"]);
    }
    let before = tree(&run);
    said(ask());
    assert!(before == tree(&run));
}

#[test]
fn what_cannot_be_compared_is_refused_before_anything_is_written() {
    let place = tempfile::tempdir().unwrap();
    let (run, good) = (place.path().join("run"), recipe(place.path(), ""));
    let file = place.path().join("cells.json");
    let refused = |text: &str, parts: &[&str]| {
        std::fs::write(&file, text).unwrap();
        // Others beside it do not help.
        let more = ["--plain"];
        let parts = [&["cells.json"], parts].concat();
        fails(compare(&[&file], &good, &run, &more), &parts);
        assert!(!run.exists());
    };
    let skip = uniform("skip");
    let cyclic = skip.replacen("\"from\": 1", "\"from\": 2", 1);
    refused(
        &cyclic,
        &["node 0", "found 2", "expected 0 to 1", "no cycle"],
    );
    let missing = skip.replacen("\"from\": 1", "\"from\": 9", 1);
    refused(&missing, &["found 9", "the cell has 1 nodes"]);
    let unknown = uniform("pool");
    refused(
        &unknown,
        &["unknown variant `pool`", "expected one of", "skip"],
    );
    let three = skip.replace("regressor_normal", "regressor");
    refused(&three, &["unknown field `regressor`", "regressor_normal"]);
    let first = skip.find("\"feature_reduction\"").unwrap();
    let last = skip.find("\"regressor_normal\"").unwrap();
    let two = format!("{}{}", &skip[..first], &skip[last..]);
    refused(&two, &["missing field `feature_reduction`"]);
    let light = Genotypes {
        normal: None,
        ..paper_genotypes()
    };
    let light = serde_json::to_string(&light).unwrap();
    let parts = [
        "found cells of a light network",
        "expected cells of a normal network",
    ];
    refused(&light, &parts);
    refused("{", &["line 1"]);

    let gone = place.path().join("gone.json");
    fails(compare(&[&gone], &good, &run, &[]), &["gone.json"]);
    std::fs::write(&file, &skip).unwrap();
    let recipes = [
        ("stepz = 3\n", "unknown field `stepz`"),
        ("init = \"weights\"\n", "init is given"),
    ];
    for (more, part) in recipes {
        let bad = recipe(place.path(), more);
        let output = ended(compare(&[&file], &bad, &run, &[]), 1);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            said.contains("recipe.toml") && said.contains(part),
            "{said}"
        );
    }
    let good = recipe(place.path(), "");
    let parts = ["cells: multiply-adds: found 5", "expected"];
    fails(
        compare(&[&file], &good, &run, &["--multiply-adds", "5"]),
        &parts,
    );
    ended(compare(&[], &good, &run, &[]), 2);
    ended(compare(&[&file], &good, &run, &["--seeds", "0"]), 2);
    assert!(!run.exists());
}

fn search(network: &str, recipe: &str, run: &Path, more: &[&str]) -> Command {
    let mut command = normalight(&["search", network, "--recipe", recipe]);
    command.args(["--run", path(run)]).args(more);
    command
}

#[test]
fn what_is_found_can_be_compared() {
    let place = tempfile::tempdir().unwrap();
    let found = place.path().join("found");
    let file = recipe(place.path(), "");
    let text = std::fs::read_to_string(&file).unwrap() + "[search]\nnodes = 2\n";
    let searched = place.path().join("search.toml");
    std::fs::write(&searched, text).unwrap();
    let told = said(search("normal", path(&searched), &found, &[]));
    for part in ["genotype.json", "degrees", "hours"] {
        assert!(told.contains(part), "{told}");
    }
    let summary = read_json(&found.join("summary.json"));
    assert_eq!(
        (&summary["state"], &summary["steps"]),
        (&"finished".into(), &2.into())
    );
    let chance = place.path().join("chance");
    let random = |seed: &str| {
        let more = ["--random", "2", "--seed", seed];
        search("normal", path(&searched), &chance, &more)
    };
    said(random("1"));
    assert_eq!(files(&chance), ["random-1.json", "random-2.json"]);
    let before = tree(&chance);
    said(random("1"));
    fails(random("2"), &["random-1.json", "another file"]);
    assert!(before == tree(&chance));

    let run = place.path().join("run");
    let table = said(compare(&[&found, &chance], &file, &run, &["--seeds", "7,"]));
    let groups = read_json(&run.join("compare.json"))["groups"].clone();
    assert_eq!(
        (&groups[0]["name"], &groups[0]["entries"]),
        (&"random".into(), &2.into())
    );
    assert!(table.contains("2 of random entries"), "{table}");
    assert!(run.join("found-s7/weights.safetensors").exists());
}

#[test]
fn searches_that_do_not_fit_are_refused() {
    let place = tempfile::tempdir().unwrap();
    let run = place.path().join("run");
    let file = recipe(place.path(), "");
    let name = path(&file);
    fails(
        search("light", name, &run, &[]),
        &["recipe.toml", "light network"],
    );
    fails(search("light", "gone.toml", &run, &[]), &["gone.toml"]);
    let bad = recipe(place.path(), "stepz = 3\n");
    let output = ended(search("normal", path(&bad), &run, &[]), 1);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.contains("recipe.toml") && said.contains("stepz"),
        "{said}"
    );
    ended(
        search("normal", name, &run, &["--random", "2", "--resume"]),
        2,
    );
    assert!(!run.exists());
    // Presets of either network need no files for what nothing is trained for.
    for preset in ["laptop", "paper"] {
        for network in ["light", "normal"] {
            let folder = place.path().join(format!("{preset}-{network}"));
            ended(search(network, preset, &folder, &["--random", "1"]), 0);
            let genotypes: Value = read_json(&folder.join("random-1.json"));
            assert!(genotypes[network].is_object() && genotypes["source"].is_string());
        }
    }
}
