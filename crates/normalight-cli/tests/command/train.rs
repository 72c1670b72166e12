//! `train`: a run of two steps, its continuation, how it ends, and what it refuses.
use crate::common::*;
use std::path::{Path, PathBuf};
use std::process::Command;

fn recipe(folder: &Path, network: &str, steps: usize) -> PathBuf {
    let size = if network == "light" { 64 } else { 16 };
    let text = format!(
        "network = \"{network}\"\nsteps = {steps}\nsize = {size}\nbatch = 2\nimages = [3, 4]\n\
         validate_every = 2\nvalidation_objects = 1\n[optimiser]\nwarm_up = 2\n"
    );
    let path = folder.join("recipe.toml");
    std::fs::write(&path, text).unwrap();
    path
}

fn train(network: &str, recipe: &Path, run: &Path, more: &[&str]) -> Command {
    let mut command = normalight(&["train", network]);
    command
        .args(["--recipe", path(recipe), "--run", path(run)])
        .args(more);
    command
}

/// What a newcomer types first, shortened.
#[test]
fn the_first_training_of_the_readme_needs_no_files() {
    let project = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let readme = std::fs::read_to_string(project.join("README.md")).unwrap();
    let commands = readme.lines().map(str::trim);
    let first = commands
        .filter(|line| line.starts_with("target/release/normalight train"))
        .find_map(|line| line.split("--recipe ").nth(1)?.split(' ').next())
        .unwrap();
    let whole = std::fs::read_to_string(project.join(first)).unwrap();
    let mut text = whole.clone();
    for (long, short) in [
        ("steps = 2000", "steps = 1"),
        ("batch = 16", "batch = 1"),
        ("validation_objects = 16", "validation_objects = 1"),
    ] {
        assert!(text.contains(long), "{long} is missing in {first}");
        text = text.replace(long, short);
    }
    let place = tempfile::tempdir().unwrap();
    let recipe = place.path().join("short.toml");
    std::fs::write(&recipe, text).unwrap();
    let said = said(train("normal", &recipe, &place.path().join("run"), &[]));
    assert!(said.contains("degrees"), "{said}");
}

#[test]
fn two_steps_and_two_more() {
    let place = tempfile::tempdir().unwrap();
    for network in ["light", "normal"] {
        let out = place.path().join(network);
        let short = recipe(place.path(), network, 2);
        let said_at_first = said(train(network, &short, &out, &[]));
        assert!(said_at_first.contains("degrees"), "{said_at_first}");
        let curves = || std::fs::read_to_string(out.join("curves.csv")).unwrap();
        assert_eq!(curves().lines().count(), 2);
        // The same again does nothing; `--out` is the option's former name.
        let before = read_json(&out.join("summary.json"));
        assert_eq!(
            (&before["state"], &before["exit_code"]),
            (&"finished".into(), &0.into())
        );
        let mut again = normalight(&["train", network, "--recipe", path(&short)]);
        again.args(["--out", path(&out)]);
        let output = ended(again, 0);
        assert!(String::from_utf8_lossy(&output.stderr).contains("finished already"));
        assert_eq!(read_json(&out.join("summary.json")), before);
        let longer = recipe(place.path(), network, 4);
        fails(
            train(network, &longer, &out, &["--quiet"]),
            &[network, "--resume"],
        );
        said(train(network, &longer, &out, &["--resume", "--quiet"]));
        assert_eq!(curves().lines().count(), 3);
        // The weights go straight into the pipeline.
        let photographs = place.path().join("vase");
        write_stack(&photographs, &sample());
        let weights = out.join("weights.safetensors");
        let option = format!("--{network}-weights");
        let results = place.path().join("results");
        said(estimate(&photographs, &results, &[&option, path(&weights)]));
        let card = std::fs::read_to_string(out.join("model-card.md")).unwrap();
        assert!(card.contains(&format!(" train {network} ")), "{card}");
    }
}

#[test]
fn the_seed_is_an_argument_and_a_part_of_the_run() {
    let place = tempfile::tempdir().unwrap();
    let recipe = recipe(place.path(), "normal", 2);
    let hash = |seed: &str| {
        let out = place.path().join(seed);
        said(train(
            "normal",
            &recipe,
            &out,
            &["--seed", seed, "--threads", "2"],
        ));
        let summary = read_json(&out.join("summary.json"));
        assert_eq!(summary["seed"].to_string(), seed);
        summary["weights_sha256"].clone()
    };
    assert_ne!(hash("1"), hash("2"));
    let out = place.path().join("1");
    fails(
        train(
            "normal",
            &recipe,
            &out,
            &["--seed", "5", "--resume", "--quiet"],
        ),
        &["seed was 1, is 5"],
    );
    // Too large, and no usage at all.
    ended(train("normal", &recipe, &out, &["--seed", "1048576"]), 2);
    ended(normalight(&["train", "normal"]), 2);
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
    for (text, part) in [
        ("network = \"normal\"\nsteps = 0\nsize = 16\n", "steps is 0"),
        (
            "network = \"normal\"\nsteps = 1\nsize = 16\n[optimiser]\nbetas = [2.0, 0.9]\n",
            "betas is 2",
        ),
    ] {
        std::fs::write(&normal, text).unwrap();
        fails(train("normal", &normal, &out, &[]), &["recipe.toml", part]);
    }
    std::fs::write(
        &normal,
        "network = \"normal\"\nsteps = 1\nsize = 16\nstepz = 2\n",
    )
    .unwrap();
    let output = ended(train("normal", &normal, &out, &[]), 1);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        said.contains("recipe.toml") && said.contains("unknown field `stepz`"),
        "{said}"
    );
    assert!(!out.exists());
}

#[test]
fn diverging_has_a_code_of_its_own() {
    let place = tempfile::tempdir().unwrap();
    let (file, out) = (place.path().join("recipe.toml"), place.path().join("run"));
    let text = "network = \"light\"\nsteps = 60\nsize = 64\nbatch = 2\nimages = [3, 4]\n\
                validation_objects = 1\n[optimiser]\nlearning_rate = 1.0\nwarm_up = 1\n\
                clip = 1e6\nbetas = [0.0, 0.0]\n";
    std::fs::write(&file, text).unwrap();
    let output = ended(train("light", &file, &out, &[]), 3);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("batch seed"), "{said}");
    let summary = read_json(&out.join("summary.json"));
    assert_eq!(
        (&summary["state"], &summary["exit_code"]),
        (&"failed".into(), &3.into())
    );
}

/// A disk on which no file may become larger than 64 KB: the first weights do not fit.
#[cfg(unix)]
#[test]
fn a_full_disk_is_told_and_leaves_nothing_half_written() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("run");
    let recipe = recipe(place.path(), "normal", 2);
    let program = env!("CARGO_BIN_EXE_normalight");
    let mut limited = Command::new("bash");
    // The signal for too large a file is ignored, so that writing fails as on a full disk.
    limited.args([
        "-c",
        "trap '' XFSZ; ulimit -f 64; exec \"$0\" \"$@\"",
        program,
    ]);
    limited.args(["train", "normal", "--device", "cpu", "--quiet"]);
    limited.args(["--recipe", path(&recipe), "--run", path(&out)]);
    fails(limited, &["weights.safetensors", "too large"]);
    let names = files(&out);
    for name in &names {
        assert!(
            !name.contains("safetensors") && !name.starts_with('.'),
            "{names:?}"
        );
    }
    let summary = read_json(&out.join("summary.json"));
    assert_eq!(
        (&summary["state"], &summary["steps"]),
        (&"failed".into(), &2.into())
    );
    // With room again, the run begins anew and ends.
    said(train("normal", &recipe, &out, &["--resume"]));
    assert_eq!(read_json(&out.join("summary.json"))["state"], "finished");
}
