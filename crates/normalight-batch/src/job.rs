//! One capture, from its files to its place in the output.
use crate::child::{Ended, is_full, run, says_full};
use crate::gate::Gate;
use crate::inputs::{Contents, Listing, now};
use crate::install::install;
use crate::memory::needed;
use crate::record::{Asked, RECORD, Record};
use crate::row::{Details, report};
use crate::thumbnails::thumbnails;
use crate::{BatchSettings, Capture, Outcome, Row};
use normalight_io::{IoError, write_files};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// What all jobs of a batch share.
pub(crate) struct Jobs<'a> {
    pub(crate) settings: &'a BatchSettings,
    /// The tree and the output, without links.
    pub(crate) root: &'a Path,
    pub(crate) output: &'a Path,
    /// The folder in which results are made.
    pub(crate) work: &'a Path,
    pub(crate) asked: Asked,
    pub(crate) gate: Gate,
    /// Whether everything has to end.
    pub(crate) stop: AtomicBool,
    /// Whether that is because nothing more can be written.
    pub(crate) is_full: AtomicBool,
}

/// Why a capture has no result.
enum Missing {
    /// Everything has to end.
    Stopped,
    /// In words.
    Failed(String),
    /// Likewise, and so will all others.
    Full(String),
}

impl Missing {
    /// An error of the output.
    fn of(path: &Path, reason: &io::Error) -> Self {
        let words = format!("{}: cannot be written: {reason}", path.display());
        match is_full(reason) {
            true => Self::Full(words),
            false => Self::Failed(words),
        }
    }
}

impl Jobs<'_> {
    /// Does a capture, or finds that it is done; `None` where everything has to end. `started` is called when there is
    /// something to be done.
    pub(crate) fn row(
        &self,
        position: usize,
        capture: &Capture,
        started: &mut dyn FnMut(),
    ) -> Option<Row> {
        let target = self.output.join(&capture.result);
        let made = Made(self.work.join(position.to_string()));
        let words = match self.result(capture, &target, &made, started) {
            Ok((outcome, details)) => return Some(Row::with(capture, outcome, details)),
            Err(Missing::Stopped) => return None,
            Err(Missing::Failed(words)) => words,
            Err(Missing::Full(words)) => {
                self.is_full.store(true, Ordering::Relaxed);
                self.stop.store(true, Ordering::Relaxed);
                words
            }
        };
        let kept = match Record::of(&target).is_some() {
            true => "; an earlier result is kept",
            false => "",
        };
        Some(Row::without(
            capture,
            Outcome::Failed(format!("{words}{kept}")),
        ))
    }

    fn result(
        &self,
        capture: &Capture,
        target: &Path,
        made: &Made,
        started: &mut dyn FnMut(),
    ) -> Result<(Outcome, Details), Missing> {
        let place = match capture.path.as_os_str().is_empty() {
            true => self.root.to_owned(),
            false => self.root.join(&capture.path),
        };
        let unread = |path: &Path, reason: &io::Error| {
            Missing::Failed(format!("{}: cannot be read: {reason}", path.display()))
        };
        let list = || Listing::of(&place, capture.kind).map_err(|reason| unread(&place, &reason));
        let files = list()?;
        let read = |files: &Listing| -> Result<(u64, Contents), Missing> {
            let time = now();
            let contents = files
                .read(&self.stop)
                .map_err(|(path, reason)| unread(&path, &reason))?;
            Ok((time, contents.ok_or(Missing::Stopped)?))
        };
        let mut contents = None;
        let before =
            Record::of(target).filter(|record| record.stands(target, &capture.name(), &self.asked));
        if let Some(mut record) = before
            && let Ok(details) = Details::of(target, &record)
        {
            let is_same =
                !self.settings.check_contents && files.looks_like(&record.inputs, record.read);
            if is_same {
                return Ok((Outcome::Unchanged, details));
            }
            let (time, found) = read(&files)?;
            if found.1 == record.contents {
                (record.read, record.inputs) = (time, found.0);
                // Only spares the next call the reading.
                let json = record
                    .to_json()
                    .map_err(|reason| Missing::of(target, &reason))?;
                write(&made.0, &[(RECORD, json)])?;
                let _ = fs::rename(made.0.join(RECORD), target.join(RECORD));
                return Ok((Outcome::Unchanged, details));
            }
            contents = Some((time, found));
        }
        let Some(_place) = self.gate.enter(needed(capture, &files), &self.stop) else {
            return Err(Missing::Stopped);
        };
        started();
        let (time, found) = match contents {
            Some(contents) => contents,
            None => read(&files)?,
        };
        let mut record = self.asked.record(capture.name(), found, time);
        let start = Instant::now();
        self.estimate(&place, &made.0)?;
        record.seconds = start.elapsed().as_secs_f64();
        let after = list()?;
        if after != files {
            // Backups change what the file system says; what counts is the content.
            let (time, found) = read(&after)?;
            if found.1 != record.contents {
                return Err(Missing::Failed(
                    "its files changed while they were read; call again".to_owned(),
                ));
            }
            (record.read, record.inputs) = (time, found.0);
        }
        let details = complete(&made.0, record)?;
        install(&made.0, target).map_err(|(path, reason)| Missing::of(&path, &reason))?;
        Ok((Outcome::Done, details))
    }

    /// Has the program make a result.
    fn estimate(&self, capture: &Path, made: &Path) -> Result<(), Missing> {
        let BatchSettings {
            program,
            time_limit,
            ..
        } = self.settings;
        match run(program, capture, made, *time_limit, &self.stop) {
            Ended::Well => Ok(()),
            Ended::Stopped => Err(Missing::Stopped),
            Ended::Badly(words) if says_full(&words) => Err(Missing::Full(words)),
            Ended::Badly(words) => Err(Missing::Failed(words)),
        }
    }
}

/// Adds to what the program made the small pictures and the record.
fn complete(made: &Path, mut record: Record) -> Result<Details, Missing> {
    let failed = |words: String| Missing::Failed(format!("the job ended well, but: {words}"));
    let report = report(made).map_err(failed)?;
    let thumbnails = thumbnails(made).map_err(failed)?;
    write(made, &thumbnails)?;
    let unlisted = |reason: io::Error| Missing::of(made, &reason);
    for entry in fs::read_dir(made).map_err(unlisted)? {
        let entry = entry.map_err(unlisted)?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let size = entry.metadata().map_err(unlisted)?.len();
        record.files.push((name, size));
    }
    record.files.sort();
    let json = record.to_json().map_err(unlisted)?;
    write(made, &[(RECORD, json)])?;
    Ok(Details::new(&report, record.seconds))
}

fn write(folder: &Path, files: &[(&str, Vec<u8>)]) -> Result<(), Missing> {
    write_files(folder, files).map_err(|error| match &error {
        IoError::Write { reason, .. } if is_full(reason) => Missing::Full(error.to_string()),
        _ => Missing::Failed(error.to_string()),
    })
}

/// A folder in which a result is made; what is left of it goes.
struct Made(PathBuf);

impl Drop for Made {
    fn drop(&mut self) {
        // What stays behind goes with the folder around it.
        let _ = fs::remove_dir_all(&self.0);
    }
}
