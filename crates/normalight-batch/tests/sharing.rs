//! Several batches and one output.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod common;

use common::{ESTIMATE, Place, RUN, outcomes, timeless};
use normalight_batch::{BatchError, Outcome, collect, run_batch};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::AtomicBool;

#[test]
fn the_output_lies_apart_from_the_captures() {
    let place = Place::new();
    let vase = place.capture("vase");
    let mut outputs = vec![
        place.root(),
        vase.join("results"),
        place.root().join("a/b/c"),
        place.top.path().to_owned(),
    ];
    #[cfg(unix)]
    {
        let link = place.top.path().join("link");
        std::os::unix::fs::symlink(&vase, &link).unwrap();
        outputs.push(link.join("results"));
    }
    for output in outputs {
        let mut settings = place.settings();
        settings.output = output.clone();
        let error = run_batch(&settings, &AtomicBool::new(false), &mut ()).unwrap_err();
        assert!(matches!(error, BatchError::NotApart { .. }), "{error}");
    }
    assert!(!vase.join("results").exists() && !place.root().join("a").exists());
}

#[test]
fn a_tree_without_captures_leaves_no_output() {
    let place = Place::new();
    fs::create_dir_all(place.root().join("a/b")).unwrap();
    fs::write(place.root().join("a/b/1.png"), "x").unwrap();
    let error = run_batch(&place.settings(), &AtomicBool::new(false), &mut ()).unwrap_err();
    assert!(matches!(error, BatchError::NoCaptures { folders: 3, .. }));
    assert!(
        error
            .to_string()
            .contains("a/b: no capture: 1 photograph(s)")
    );
    assert!(!place.output().exists());
}

/// A batch in a process of its own whose first capture hangs, once that one is being estimated.
fn hanging(place: &Place, shard: &str) -> Child {
    let mut child = Command::new(RUN)
        .arg(place.root())
        .arg(place.output())
        .args([ESTIMATE, "1", shard])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let said = BufReader::new(child.stdout.take().unwrap());
    let started = said
        .lines()
        .map(Result::unwrap)
        .find(|line| line.starts_with("started"));
    assert_eq!(started.as_deref(), Some("started a"));
    child
}

#[test]
fn one_batch_at_a_time_and_a_dead_one_is_in_nobodys_way() {
    let place = Place::new();
    place.behaving("a", "hang");
    place.capture("b");
    let mut first = hanging(&place, "1/2");
    let refused = |shard: &str| {
        let mut settings = place.settings();
        settings.shard = shard.parse().unwrap();
        run_batch(&settings, &AtomicBool::new(false), &mut ()).unwrap_err()
    };
    assert!(matches!(refused("1/2"), BatchError::AtWork { .. }));
    assert!(matches!(
        refused("1/1"),
        BatchError::OtherDivision { found: 2, .. }
    ));
    assert!(matches!(
        refused("1/3"),
        BatchError::OtherDivision { found: 2, .. }
    ));
    // The other shard may.
    let (second, _) = place.run(|settings| settings.shard = "2/2".parse().unwrap());
    assert_eq!(outcomes(&second), [("b", "done")]);
    first.kill().unwrap();
    first.wait().unwrap();
    fs::remove_file(place.root().join("a/behaviour.txt")).unwrap();
    let (third, started) = place.run(|_| {});
    assert!(third.is_complete());
    assert_eq!(started, ["a"]);
    assert!(!place.output().join(".batch-work").exists());
}

/// Whether a process is there, by what the system says of it.
#[cfg(target_os = "linux")]
fn jobs_of(place: &Place) -> usize {
    let is_job = |entry: &fs::DirEntry| {
        fs::read(entry.path().join("cmdline")).is_ok_and(|line| {
            let line = String::from_utf8_lossy(&line).into_owned();
            line.contains(ESTIMATE)
                && line.contains(&*place.output().to_string_lossy())
                && !line.contains(RUN)
        })
    };
    fs::read_dir("/proc")
        .unwrap()
        .flatten()
        .filter(is_job)
        .count()
}

#[cfg(target_os = "linux")]
#[test]
fn jobs_end_with_a_batch_that_is_killed() {
    let place = Place::new();
    place.behaving("a", "hang");
    let mut batch = hanging(&place, "1/1");
    while jobs_of(&place) == 0 {
        std::thread::yield_now();
    }
    batch.kill().unwrap();
    batch.wait().unwrap();
    // Waits for ever where they do not.
    while jobs_of(&place) > 0 {
        std::thread::yield_now();
    }
}

#[test]
fn shards_together_are_the_whole() {
    let place = Place::new();
    let other = Place::new();
    for place in [&place, &other] {
        for index in 0..7 {
            place.capture(&format!("hall {}/vase {index}", index % 2));
        }
        place.behaving("hall 0/bad", "fail");
    }
    let (whole, _) = other.run(|_| {});
    let parts = ["1/3", "2/3", "3/3"];
    let mut taken = Vec::new();
    for shard in parts {
        let (summary, _) = place.run(|settings| settings.shard = shard.parse().unwrap());
        taken.extend(summary.rows.into_iter().map(|row| row.capture));
    }
    taken.sort();
    taken.dedup();
    assert_eq!(taken.len(), 8);
    let is_there = |name: &str| place.output().join(name).exists();
    assert!(is_there("batch-2-of-3.csv") && !is_there("index.html"));
    let collected = collect(&place.output()).unwrap();
    assert_eq!(outcomes(&collected), outcomes(&whole));
    assert!(is_there("batch.csv") && is_there("index.html") && !is_there("batch-2-of-3.csv"));
    assert_eq!(timeless(&place.output()), timeless(&other.output()));

    // What failed is still known, until it is done.
    let again = collect(&place.output()).unwrap();
    assert_eq!(again.count(&Outcome::Failed(String::new())), 1);
    fs::remove_file(place.root().join("hall 0/bad/behaviour.txt")).unwrap();
    for shard in parts {
        place.run(|settings| settings.shard = shard.parse().unwrap());
    }
    assert!(collect(&place.output()).unwrap().is_complete());
}

#[test]
fn nothing_is_collected_of_nothing() {
    let place = Place::new();
    place.capture("a");
    let error = collect(&place.root()).unwrap_err();
    assert!(matches!(error, BatchError::NothingToCollect { .. }));
    assert!(!Path::new(&place.root().join("batch.csv")).exists());
    assert!(matches!(
        collect(&place.output()),
        Err(BatchError::Read { .. })
    ));
}
