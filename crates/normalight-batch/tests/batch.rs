//! Batches from beginning to end.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod common;

use common::{Place, by_hand, files, outcomes};
use normalight_batch::{Outcome, Stopped, run_batch};
use std::fs::{self, File};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, SystemTime};

/// Photographs that were taken long ago: whether later ones are the same, their times tell.
fn age(place: &Place) {
    for name in files(&place.root()).into_keys() {
        let file = File::options()
            .append(true)
            .open(place.root().join(name))
            .unwrap();
        let day = Duration::from_secs(86_400);
        file.set_modified(SystemTime::now() - day).unwrap();
    }
}

#[test]
fn results_are_those_of_the_program_with_the_same_paths() {
    let place = Place::new();
    let names = [
        "plain",
        "with space/and \"quotes\"/it's",
        "Ümlaut/花瓶",
        "plain/inner",
        "per%20cent & <b>#?",
    ];
    for name in names {
        place.capture(name);
    }
    #[cfg(unix)]
    place.capture("line\nbreak\t");
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        let folder = place
            .root()
            .join(std::ffi::OsStr::from_bytes(b"no text \xff"));
        fs::rename(place.capture("no text"), folder).unwrap();
    }
    let (summary, started) = place.run(|_| {});
    assert!(summary.is_complete());
    assert_eq!(started.len(), summary.rows.len());
    for name in names {
        for (file, bytes) in by_hand(&place.root().join(name)) {
            let made = place.output().join(name).join(&file);
            assert_eq!(fs::read(made).unwrap(), bytes, "{name}");
        }
    }
    let csv = fs::read_to_string(place.output().join("batch.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), summary.rows.len());
    for (row, said) in rows.iter().zip(&summary.rows) {
        assert_eq!(&row[0], said.capture);
        assert_eq!(&row[2], "done");
    }
    let leftovers = files(&place.output()).into_keys();
    let hidden = |path: &std::path::PathBuf| path.to_string_lossy().contains("/.");
    assert!(!leftovers.into_iter().any(|path| hidden(&path)));
    assert!(!place.output().join(".batch-work").exists());
}

#[test]
fn what_is_current_is_not_done_again() {
    let place = Place::new();
    for name in ["a", "b", "c", "d"] {
        place.capture(name);
    }
    age(&place);
    assert_eq!(place.run(|_| {}).1.len(), 4);
    let (again, started) = place.run(|_| {});
    assert!(again.is_complete() && started.is_empty(), "{started:?}");
    assert_eq!(again.count(&Outcome::Unchanged), 4);
    assert!(
        place
            .run(|settings| settings.check_contents = true)
            .1
            .is_empty()
    );

    // A copy with new times is the same; other content of the same size with the old time is not.
    let copied = place.root().join("a/1.png");
    fs::write(&copied, fs::read(&copied).unwrap()).unwrap();
    let changed = place.root().join("b/2.png");
    let before = fs::metadata(&changed).unwrap().modified().unwrap();
    fs::write(&changed, "photograph 2 of B").unwrap();
    let file = File::options().append(true).open(&changed).unwrap();
    file.set_modified(before).unwrap();
    fs::rename(place.root().join("c/3.png"), place.root().join("c/4.png")).unwrap();
    fs::remove_file(place.output().join("d/albedo.png")).unwrap();
    fs::write(place.root().join("a/.DS_Store"), "of the system").unwrap();
    assert_eq!(place.run(|_| {}).1, ["b", "c", "d"]);
    for name in ["a", "b", "c", "d"] {
        for (file, bytes) in by_hand(&place.root().join(name)) {
            let made = fs::read(place.output().join(name).join(file)).unwrap();
            // The program itself, unlike a real one, looks at files of the system.
            assert!(name == "a" || made == bytes, "{name}");
        }
    }
}

#[test]
fn other_settings_and_programs_do_all_again() {
    let place = Place::new();
    place.capture("a");
    let lights = place.top.path().join("lights.lp");
    fs::write(&lights, "1").unwrap();
    let with = |size: &'static str, version: &'static str| {
        let lights = lights.clone();
        move |settings: &mut normalight_batch::BatchSettings| {
            settings.program.arguments = vec!["--size".into(), size.into()];
            settings.program.version = version.to_owned();
            settings.program.files = vec![lights];
        }
    };
    assert_eq!(place.run(with("50", "1")).1, ["a"]);
    assert!(place.run(with("50", "1")).1.is_empty());
    assert_eq!(place.run(with("60", "1")).1, ["a"]);
    let map = image::open(place.output().join("a/normals.png")).unwrap();
    assert_eq!(map.width(), 60);
    assert_eq!(place.run(with("60", "2")).1, ["a"]);
    fs::write(&lights, "2").unwrap();
    assert_eq!(place.run(with("60", "2")).1, ["a"]);
    assert!(place.run(with("60", "2")).1.is_empty());
}

#[test]
fn a_bad_capture_is_a_row_and_the_others_are_done() {
    let place = Place::new();
    let bad = ["abort", "change", "empty", "fail", "half", "panic"];
    for behaviour in bad {
        place.behaving(behaviour, behaviour);
    }
    place.behaving("talk", "talk");
    place.behaving("touch", "touch");
    place.capture("well");
    let (summary, _) = place.run(|_| {});
    let expected = bad.map(|name| (name, "failed"));
    assert_eq!(outcomes(&summary)[..6], expected);
    let others = [("talk", "done"), ("touch", "done"), ("well", "done")];
    assert_eq!(outcomes(&summary)[6..], others);
    assert!(!summary.is_complete());
    let said = |name: &str| {
        let row = summary.rows.iter().find(|row| row.capture == name).unwrap();
        match &row.outcome {
            Outcome::Failed(words) => words.clone(),
            other => panic!("{other:?}"),
        }
    };
    let fail = place.root().canonicalize().unwrap().join("fail");
    assert_eq!(said("fail"), format!("{}: found 2 images", fail.display()));
    assert!(said("panic").contains("not expected"));
    assert!(said("empty").contains("report.json"));
    assert!(said("change").contains("changed"));
    #[cfg(unix)]
    assert!(said("abort").contains("signal"), "{}", said("abort"));
    for name in bad {
        assert!(!place.output().join(name).exists(), "{name}");
    }
    let csv = fs::read_to_string(place.output().join("batch.csv")).unwrap();
    assert!(csv.contains("found 2 images"));

    // Repaired, it is done, and so is what does not change any more; nothing else.
    for name in ["abort", "half"] {
        fs::remove_file(place.root().join(name).join("behaviour.txt")).unwrap();
    }
    let (summary, _) = place.run(|_| {});
    let done = summary
        .rows
        .iter()
        .filter(|row| row.outcome == Outcome::Done);
    let done: Vec<&str> = done.map(|row| &row.capture[..]).collect();
    assert_eq!(done, ["abort", "change", "half"]);
    assert_eq!(summary.count(&Outcome::Unchanged), 3);
}

#[test]
fn a_job_that_hangs_is_ended() {
    let place = Place::new();
    place.behaving("a", "hang");
    let limit = Duration::from_millis(200);
    let (summary, _) = place.run(|settings| settings.time_limit = Some(limit));
    let Outcome::Failed(words) = &summary.rows[0].outcome else {
        panic!("{:?}", summary.rows[0]);
    };
    assert_eq!(words, "ended after 0.2 seconds, the limit of time");
    assert!(!place.output().join(".batch-work").exists());
}

#[test]
fn a_result_of_earlier_photographs_is_kept_and_that_is_said() {
    let place = Place::new();
    place.capture("a");
    place.run(|_| {});
    place.behaving("a", "fail");
    let (summary, _) = place.run(|_| {});
    let Outcome::Failed(words) = &summary.rows[0].outcome else {
        panic!("{:?}", summary.rows[0]);
    };
    assert!(words.ends_with("an earlier result is kept"), "{words}");
    assert!(place.output().join("a/normals.png").exists());
}

#[test]
fn a_full_disk_ends_the_batch() {
    let place = Place::new();
    for name in ["a", "c", "d"] {
        place.capture(name);
    }
    place.behaving("b", "full");
    let mut settings = place.settings();
    settings.jobs = 1.try_into().unwrap();
    let first = run_batch(&settings, &AtomicBool::new(false), &mut ()).unwrap();
    assert_eq!(first.stopped, Some(Stopped::OutputFull));
    let expected = [
        ("a", "done"),
        ("b", "failed"),
        ("c", "not done"),
        ("d", "not done"),
    ];
    assert_eq!(outcomes(&first), expected);
    fs::remove_file(place.root().join("b/behaviour.txt")).unwrap();
    let (second, started) = place.run(|_| {});
    assert!(second.is_complete());
    assert_eq!(started, ["b", "c", "d"]);
}

#[test]
fn a_cancelled_batch_ends_its_jobs_and_goes_on_with_the_next_call() {
    struct CancelAt<'a>(&'a AtomicBool);
    impl normalight_batch::BatchObserver for CancelAt<'_> {
        fn started(&mut self, capture: &normalight_batch::Capture) {
            if capture.name() == "b" {
                self.0.store(true, std::sync::atomic::Ordering::Relaxed);
            }
        }
    }
    let place = Place::new();
    place.capture("a");
    place.behaving("b", "hang");
    place.capture("c");
    let cancel = AtomicBool::new(false);
    let mut settings = place.settings();
    settings.jobs = 1.try_into().unwrap();
    let summary = run_batch(&settings, &cancel, &mut CancelAt(&cancel)).unwrap();
    assert_eq!(summary.stopped, Some(Stopped::Cancelled));
    let expected = [("a", "done"), ("b", "not done"), ("c", "not done")];
    assert_eq!(outcomes(&summary), expected);
    assert!(!place.output().join(".batch-work").exists());
    fs::remove_file(place.root().join("b/behaviour.txt")).unwrap();
    assert_eq!(place.run(|_| {}).1, ["b", "c"]);
}

#[test]
fn jobs_that_need_more_memory_than_there_is_run_one_by_one() {
    let place = Place::new();
    for name in ["a", "b", "c", "d", "e", "f"] {
        place.behaving(name, "alone");
    }
    let (summary, _) = place.run(|settings| settings.memory = Some(1));
    assert!(summary.is_complete(), "{:?}", outcomes(&summary));
}
