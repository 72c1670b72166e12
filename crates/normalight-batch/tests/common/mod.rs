//! Trees of captures and batches with the program that imitates an estimate.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
#![allow(dead_code, reason = "each test file uses its own part of it")]
use normalight_batch::{
    BatchObserver, BatchSettings, BatchSummary, Capture, Program, Progress, Row, Shard, run_batch,
};
use std::collections::BTreeMap;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

pub const ESTIMATE: &str = env!("CARGO_BIN_EXE_batch-test-estimate");
pub const RUN: &str = env!("CARGO_BIN_EXE_batch-test-run");

/// A tree of captures and a place for an output.
pub struct Place {
    pub top: TempDir,
}

impl Place {
    pub fn new() -> Self {
        Self {
            top: tempfile::tempdir().unwrap(),
        }
    }

    pub fn root(&self) -> PathBuf {
        self.top.path().join("captures")
    }

    pub fn output(&self) -> PathBuf {
        self.top.path().join("results")
    }

    /// Makes a capture of three photographs.
    pub fn capture(&self, name: &str) -> PathBuf {
        let folder = self.root().join(name);
        fs::create_dir_all(&folder).unwrap();
        for index in 1..=3 {
            let file = folder.join(format!("{index}.png"));
            fs::write(file, format!("photograph {index} of {name}")).unwrap();
        }
        folder
    }

    /// Makes a capture whose estimate behaves like this.
    pub fn behaving(&self, name: &str, behaviour: &str) {
        let folder = self.capture(name);
        fs::write(folder.join("behaviour.txt"), behaviour).unwrap();
    }

    pub fn settings(&self) -> BatchSettings {
        BatchSettings {
            root: self.root(),
            output: self.output(),
            program: Program {
                path: PathBuf::from(ESTIMATE),
                version: "test".to_owned(),
                arguments: Vec::new(),
                files: Vec::new(),
                environment: Vec::new(),
            },
            jobs: NonZeroUsize::new(3).unwrap(),
            memory: None,
            shard: Shard::WHOLE,
            time_limit: None,
            check_contents: false,
        }
    }

    /// Does a batch: its summary, and the captures that were estimated.
    pub fn run(&self, change: impl FnOnce(&mut BatchSettings)) -> (BatchSummary, Vec<String>) {
        let mut settings = self.settings();
        change(&mut settings);
        let mut heard = Heard::default();
        let summary = run_batch(&settings, &AtomicBool::new(false), &mut heard).unwrap();
        heard.started.sort();
        assert_eq!(heard.finished, summary.rows.len());
        (summary, heard.started)
    }
}

#[derive(Default)]
pub struct Heard {
    pub started: Vec<String>,
    pub finished: usize,
}

impl BatchObserver for Heard {
    fn started(&mut self, capture: &Capture) {
        self.started.push(capture.name());
    }

    fn finished(&mut self, _row: &Row, progress: &Progress) {
        self.finished += 1;
        assert_eq!(progress.done, self.finished);
    }
}

/// Names and outcomes of all rows.
pub fn outcomes(summary: &BatchSummary) -> Vec<(&str, &'static str)> {
    let rows = summary.rows.iter();
    rows.map(|row| (&row.capture[..], row.outcome.word()))
        .collect()
}

/// Paths and contents of all files below a folder.
pub fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in walkdir::WalkDir::new(folder) {
        let entry = entry.unwrap();
        if entry.file_type().is_file() {
            let name = entry.path().strip_prefix(folder).unwrap().to_owned();
            files.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    files
}

/// The same without what tells times.
pub fn timeless(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let tells_time = |path: &Path| {
        let name = path.file_name().unwrap();
        name == "batch.json" || name == "batch.csv" || name == "index.html"
    };
    let files = files(folder).into_iter();
    files.filter(|(path, _)| !tells_time(path)).collect()
}

/// What an estimate makes of a capture, called by hand.
pub fn by_hand(capture: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let out = tempfile::tempdir().unwrap();
    let status = std::process::Command::new(ESTIMATE)
        .arg("estimate")
        .arg(capture)
        .arg("--out")
        .arg(out.path())
        .arg("--quiet")
        .status();
    assert!(status.unwrap().success());
    files(out.path())
}
