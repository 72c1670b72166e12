//! A batch that is killed again and again.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod common;

use common::{ESTIMATE, Place, RUN, outcomes, timeless};
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::Instant;

/// A number from 0 to 1 that differs from call to call, the same in every run.
fn next(state: &mut u64) -> f64 {
    *state = state
        .wrapping_mul(6_364_136_223_846_793_005)
        .wrapping_add(1);
    (*state >> 33) as f64 / (1_u64 << 31) as f64
}

/// A tree of thirty captures; some lie in others, whose results are put into folders that are there.
fn thirty() -> Place {
    let place = Place::new();
    for index in 0..30 {
        let name = match index % 3 {
            0 => format!("vase {index}"),
            1 => format!("vase {}/part", index - 1),
            _ => format!("hall/shelf {index}/vase"),
        };
        place.behaving(&name, "slow 5");
    }
    place
}

/// The files of a result folder itself.
fn own(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let files = timeless(folder).into_iter();
    files
        .filter(|(path, _)| path.components().count() == 1)
        .collect()
}

#[test]
fn after_fifty_kills_one_more_call_makes_everything_complete_and_equal() {
    // Two settings in turns, so that there always is something to be done, and results are replaced.
    let settings = [["--size", "40"], ["--size", "60"]];
    let start = Instant::now();
    let wholes = settings.map(|settings| {
        let place = thirty();
        let (whole, _) =
            place.run(|batch| batch.program.arguments = settings.map(Into::into).into());
        assert!(whole.is_complete());
        place
    });
    let usual = start.elapsed() / 2;

    let place = thirty();
    let (mut state, mut killed, mut tries, mut records) = (7, 0, 0, 0);
    let said = tempfile::NamedTempFile::new().unwrap();
    while killed < 50 {
        tries += 1;
        assert!(
            tries < 500,
            "hardly any batch lives long enough to be killed"
        );
        let mut batch = Command::new(RUN)
            .arg(place.root())
            .arg(place.output())
            .args([ESTIMATE, "3", "1/1"])
            .args(settings[tries % 2])
            .stdout(File::create(said.path()).unwrap())
            .spawn()
            .unwrap();
        thread::sleep(usual.mul_f64(0.6 * next(&mut state)));
        match batch.try_wait().unwrap() {
            None => killed += 1,
            Some(status) => assert!(
                status.success(),
                "{}",
                std::fs::read_to_string(&said).unwrap()
            ),
        }
        let _ = batch.kill();
        batch.wait().unwrap();
        for entry in walkdir::WalkDir::new(place.output()).into_iter().flatten() {
            let folder = entry.path().strip_prefix(place.output()).unwrap();
            if folder.starts_with(".batch-work") || !entry.path().join("batch.json").exists() {
                continue;
            }
            // Where a record is, all is, of the settings that it names.
            records += 1;
            let record = std::fs::read_to_string(entry.path().join("batch.json")).unwrap();
            let whole = match record.contains("\"40\"") {
                true => &wholes[0],
                false => &wholes[1],
            };
            let (found, expected) = (own(entry.path()), own(&whole.output().join(folder)));
            assert!(found.keys().eq(expected.keys()), "{:?}", found.keys());
            assert!(found == expected, "{}", folder.display());
        }
    }
    assert!(records > 100, "{records} results seen");
    let (last, _) = place.run(|batch| batch.program.arguments = settings[0].map(Into::into).into());
    assert!(last.is_complete());
    assert_eq!(outcomes(&last).len(), 30);
    assert_eq!(timeless(&place.output()), timeless(&wholes[0].output()));
    assert!(!place.output().join(".batch-work").exists());
}
