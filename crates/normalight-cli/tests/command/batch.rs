//! A tree of captures through the command: results are those of `estimate`, and a second call does nothing.
use crate::common::*;
use std::path::{Path, PathBuf};
use std::process::Command;

fn batch(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
    command.arg("batch").args(arguments);
    command
}

/// A rendered stack in two folders of a tree, and photographs that are none.
fn tree(place: &Path) -> PathBuf {
    let root = place.join("captures");
    for folder in ["a", "deep er/b"] {
        write_stack(&root.join(folder), &sample());
    }
    let bad = root.join("bad");
    std::fs::create_dir_all(&bad).unwrap();
    for index in 0..3 {
        std::fs::write(bad.join(format!("{index}.png")), b"no picture").unwrap();
    }
    root
}

#[test]
fn a_tree_gives_what_single_estimates_give() {
    let place = tempfile::tempdir().unwrap();
    let root = tree(place.path());
    let (out, single) = (place.path().join("out"), place.path().join("single"));
    let settings = ["--", "--quality", "fast", "--device", "cpu"];
    let all = [&[path(&root), "--out", path(&out)][..], &settings[..]].concat();
    // One of three fails.
    let said = ended(batch(&all), 1);
    let said = String::from_utf8(said.stdout).unwrap();
    assert!(said.contains("2 done, 0 unchanged, 1 failed"), "{said}");
    ended(
        estimate(&root.join("a"), &single, &["--quality", "fast", "--quiet"]),
        0,
    );
    for folder in ["a", "deep er/b"] {
        for file in ["normals.npy", "lights.csv", "albedo.png", "mask.png"] {
            let [ours, theirs] = [&out.join(folder), &single]
                .map(|folder| std::fs::read(folder.join(file)).unwrap());
            assert_eq!(ours, theirs, "{folder}/{file}");
        }
    }
    let table = std::fs::read_to_string(out.join("batch.csv")).unwrap();
    assert!(table.contains("bad,bad,failed,"), "{table}");
    let again = String::from_utf8(ended(batch(&all), 1).stdout).unwrap();
    assert!(again.contains("0 done, 2 unchanged, 1 failed"), "{again}");
    std::fs::remove_dir_all(root.join("bad")).unwrap();
    let without = String::from_utf8(ended(batch(&all), 0).stdout).unwrap();
    assert!(
        without.contains("0 done, 2 unchanged, 0 failed"),
        "{without}"
    );
    let collected = ended(batch(&["--collect", "--out", path(&out)]), 0);
    assert!(
        String::from_utf8(collected.stdout)
            .unwrap()
            .contains("captures: 2")
    );
}

#[test]
fn what_makes_no_sense_is_said_before_anything_begins() {
    let place = tempfile::tempdir().unwrap();
    let root = tree(place.path());
    let (out, inside) = (place.path().join("out"), root.join("out"));
    fails(
        batch(&[path(&root), "--out", path(&inside)]),
        &["choose another folder for the results"],
    );
    let empty = place.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    fails(
        batch(&[path(&empty), "--out", path(&out)]),
        &["no capture found"],
    );
    let wrong = [path(&root), "--out", path(&out), "--", "--quality", "great"];
    let said = ended(batch(&wrong), 1);
    let said = String::from_utf8(said.stderr).unwrap();
    assert!(
        said.contains("after `--`") && said.contains("great"),
        "{said}"
    );
    for wrong in [
        &["--shard", "4/3"][..],
        &["--memory", "-1"],
        &["--jobs", "0"],
    ] {
        ended(
            batch(&[&[path(&root), "--out", path(&out)], wrong].concat()),
            2,
        );
    }
    assert!(!out.exists() && !inside.exists());
    let dry = ended(batch(&[path(&root), "--dry-run"]), 0);
    let dry = String::from_utf8(dry.stdout).unwrap();
    assert!(
        dry.contains("deep er/b: ") && dry.contains("bad: 3 photographs"),
        "{dry}"
    );
}

#[test]
fn the_bench_counts_what_a_batch_does() {
    let arguments = ["--captures", "2", "--images", "3", "--size", "32", "--json"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
    command.args(["bench", "batch"]).args(arguments);
    command.args(["--", "--quality", "fast", "--device", "cpu"]);
    let report: serde_json::Value = serde_json::from_str(&said(command)).unwrap();
    for (case, jobs) in report["cases"].as_array().unwrap().iter().zip([1, 2]) {
        assert_eq!(case["jobs"], jobs);
        let seconds = case["seconds"].as_f64().unwrap();
        let an_hour = case["captures_per_hour"].as_f64().unwrap();
        assert!((an_hour * seconds - 2.0 * 3600.0).abs() < 1e-6 * 7200.0);
    }
    // Finding that all is done takes less than doing it.
    let unchanged = report["unchanged_seconds"].as_f64().unwrap();
    assert!(unchanged < report["plain_seconds"].as_f64().unwrap());
}
