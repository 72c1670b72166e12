//! What is said of each capture at the end.
use crate::capture::name_of;
use crate::record::{REPORT, Record, bytes};
use crate::{Capture, Shard};
use normalight_io::{Report, left_out_lines, notice_lines};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A capture in the table.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Its path below the root, `.` for the root itself.
    pub capture: String,
    /// The path of its result below the output.
    pub result: PathBuf,
    /// How it ended.
    pub outcome: Outcome,
    /// When that was known.
    pub at: SystemTime,
    /// What there is to know of its result; `None` where there is none, or one of an earlier state of the capture.
    pub details: Option<Details>,
}

/// How a capture ended.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// It was estimated.
    Done,
    /// The result that was there is still right.
    Unchanged,
    /// There is no result, or none of the photographs as they are now; in words.
    Failed(String),
    /// The batch ended before its turn.
    NotDone,
}

/// What a result says of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Details {
    /// Number of photographs.
    pub photographs: usize,
    /// Width of the photographs in pixels.
    pub width: usize,
    /// Height of the photographs in pixels.
    pub height: usize,
    /// Where the mask came from.
    pub mask: String,
    /// How samples were taken to relate to light.
    pub color: String,
    /// Where the lights came from.
    pub lights: String,
    /// What was left out, a line each.
    pub left_out: Vec<String>,
    /// What is doubtful, a line each.
    pub notices: Vec<String>,
    /// Seconds that the job took.
    pub seconds: f64,
}

/// How a batch ended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct BatchSummary {
    /// The output, without links.
    pub output: PathBuf,
    /// Which captures were meant.
    pub shard: Shard,
    /// All of them, in the order of their paths.
    pub rows: Vec<Row>,
    /// Why it ended before its time.
    pub stopped: Option<Stopped>,
}

/// Why a batch ended before its time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stopped {
    /// The caller wished so.
    Cancelled,
    /// Nothing more can be written: the disk is full, or as much as a full one.
    OutputFull,
}

impl BatchSummary {
    /// Whether every capture has its result.
    pub fn is_complete(&self) -> bool {
        let is_there = |row: &Row| matches!(row.outcome, Outcome::Done | Outcome::Unchanged);
        self.rows.iter().all(is_there)
    }

    /// Number of rows with an outcome of this kind, whatever it says in words.
    pub fn count(&self, kind: &Outcome) -> usize {
        let of_kind = |row: &&Row| row.outcome.word() == kind.word();
        self.rows.iter().filter(of_kind).count()
    }
}

impl Outcome {
    /// What stands in the table.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Unchanged => "unchanged",
            Self::Failed(_) => "failed",
            Self::NotDone => "not done",
        }
    }
}

impl Row {
    /// A capture that has no result.
    pub(crate) fn without(capture: &Capture, outcome: Outcome) -> Self {
        Self {
            capture: name_of(&capture.path),
            result: capture.result.clone(),
            outcome,
            at: SystemTime::now(),
            details: None,
        }
    }

    /// A capture with its result.
    pub(crate) fn with(capture: &Capture, outcome: Outcome, details: Details) -> Self {
        Self {
            details: Some(details),
            ..Self::without(capture, outcome)
        }
    }
}

impl Details {
    /// Those of a result that took so many seconds.
    pub(crate) fn new(report: &Report, seconds: f64) -> Self {
        Self {
            photographs: report.inputs.len(),
            width: report.width,
            height: report.height,
            mask: report.mask.clone(),
            color: report.plan.color.taken.clone(),
            lights: report.lights_from.clone(),
            left_out: left_out_lines(&report.plan.left_out, false),
            notices: notice_lines(&report.plan.notices),
            seconds,
        }
    }

    /// Those of the result in a folder, which has this record.
    ///
    /// # Errors
    /// In words: no report, or one that is none of this program.
    pub(crate) fn of(folder: &Path, record: &Record) -> Result<Self, String> {
        Ok(Self::new(&report(folder)?, record.seconds))
    }
}

/// The report in a folder.
///
/// # Errors
/// In words.
pub(crate) fn report(folder: &Path) -> Result<Report, String> {
    let bytes = bytes(&folder.join(REPORT));
    let bytes = bytes.map_err(|reason| format!("{REPORT}: cannot be read: {reason}"))?;
    serde_json::from_slice(&bytes)
        .map_err(|reason| format!("{REPORT}: no report of this program: {reason}"))
}
