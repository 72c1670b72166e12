//! A batch from its beginning to its end.
use crate::claim::Claim;
use crate::gate::Gate;
use crate::job::Jobs;
use crate::observer::Count;
use crate::record::Asked;
use crate::{
    BatchError, BatchObserver, BatchSettings, BatchSummary, Capture, Found, Outcome, Row, Stopped,
    find_captures, output, table,
};
use normalight_core::MIN_IMAGES;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// How often is looked whether the caller wants an end.
const LOOK: Duration = Duration::from_millis(50);

/// What a thread that does jobs has to say.
enum Event {
    Started(usize),
    Finished(usize, Box<Row>),
}

/// Finds the captures of a tree and has each estimated that has no current result. At the end the table is written: for all
/// captures `batch.csv` and the page `index.html`, for a shard its part `batch-I-of-N.csv`, see
/// [`collect`](crate::collect).
///
/// What goes wrong with a capture is said in its row, a crash of its job, too. Once `cancel` is set, jobs are ended, what
/// they have is given up, and the table is written; the next call goes on. A disk that is full ends the batch likewise.
///
/// # Errors
/// [`BatchError`]: a tree without captures, an output that does not lie apart from it or is being worked on, what cannot be
/// read or written.
pub fn run_batch(
    settings: &BatchSettings,
    cancel: &AtomicBool,
    observer: &mut dyn BatchObserver,
) -> Result<BatchSummary, BatchError> {
    let (root, output) = output::places(&settings.root, &settings.output)?;
    let asked = Asked::of(settings)?;
    let found = find_captures(&root)?;
    if found.captures.is_empty() {
        return Err(nothing(settings, &found));
    }
    let claim = Claim::take(&output, settings.shard)?;
    if !claim.is_locked {
        observer.noticed(
            "the output lies where files cannot be locked; see to it that no shard runs twice at once",
        );
    }
    let shards = found.captures.iter().enumerate();
    let mine: Vec<&Capture> = shards
        .filter(|(position, _)| settings.shard.takes(*position))
        .map(|(_, capture)| capture)
        .collect();
    observer.found(&found, mine.len());
    let jobs = Jobs {
        settings,
        root: &root,
        output: &output,
        work: claim.work(),
        asked,
        gate: Gate::new(settings.memory),
        stop: AtomicBool::new(cancel.load(Ordering::Relaxed)),
        is_full: AtomicBool::new(false),
    };
    let rows = rows(&jobs, &mine, cancel, observer);
    let is_full = jobs.is_full.into_inner();
    let stopped = match (is_full, cancel.load(Ordering::Relaxed)) {
        (true, _) => Some(Stopped::OutputFull),
        (false, true) if rows.iter().any(|row| row.outcome == Outcome::NotDone) => {
            Some(Stopped::Cancelled)
        }
        _ => None,
    };
    let summary = BatchSummary {
        output,
        shard: settings.shard,
        rows,
        stopped,
    };
    match table::write(&summary) {
        // That it is full is what the caller has to hear.
        Err(error) if is_full => observer.noticed(&error.to_string()),
        written => written?,
    }
    drop(claim);
    Ok(summary)
}

fn nothing(settings: &BatchSettings, found: &Found) -> BatchError {
    /// How many of those passed over are named.
    const NAMED: usize = 3;
    let named = found.passed_over.iter().take(NAMED);
    let named: Vec<String> = named.map(ToString::to_string).collect();
    let more = found.passed_over.len().saturating_sub(NAMED);
    BatchError::NoCaptures {
        path: settings.root.clone(),
        folders: found.folders,
        besides: match (named.is_empty(), more) {
            (true, _) => String::new(),
            (false, 0) => format!("; {}", named.join("; ")),
            (false, more) => format!("; {}; and {more} more", named.join("; ")),
        },
        expected: MIN_IMAGES,
    }
}

/// Does the captures, several at a time.
fn rows(
    jobs: &Jobs,
    captures: &[&Capture],
    cancel: &AtomicBool,
    observer: &mut dyn BatchObserver,
) -> Vec<Row> {
    let weights = weights(captures);
    let mut count = Count::new(&weights);
    let mut rows: Vec<Option<Row>> = vec![None; captures.len()];
    let mut was_started = vec![false; captures.len()];
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        // Whoever leaves here, in a panic of the observer, too, ends the jobs.
        let _stop = StopAtEnd(&jobs.stop);
        let (sender, receiver) = channel();
        for _ in 0..jobs.settings.jobs.get().min(captures.len()) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while !jobs.stop.load(Ordering::Relaxed) {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(capture) = captures.get(index) else {
                        break;
                    };
                    // Nobody hears after a panic of the observer.
                    let mut started = || drop(sender.send(Event::Started(index)));
                    if let Some(row) = jobs.row(index, capture, &mut started) {
                        drop(sender.send(Event::Finished(index, Box::new(row))));
                    }
                }
            });
        }
        drop(sender);
        loop {
            if cancel.load(Ordering::Relaxed) {
                jobs.stop.store(true, Ordering::Relaxed);
            }
            match receiver.recv_timeout(LOOK) {
                Ok(Event::Started(index)) => {
                    was_started[index] = true;
                    count.started();
                    observer.started(captures[index]);
                }
                Ok(Event::Finished(index, row)) => {
                    let has_failed = matches!(row.outcome, Outcome::Failed(_));
                    count.finished(weights[index], was_started[index], has_failed);
                    observer.finished(&row, &count.progress());
                    rows[index] = Some(*row);
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
    });
    let row = |(row, capture): (Option<Row>, &&Capture)| {
        row.unwrap_or_else(|| Row::without(capture, Outcome::NotDone))
    };
    rows.into_iter().zip(captures).map(row).collect()
}

/// What each capture counts for the time that is left: its photographs, in an archive as many as elsewhere on average.
fn weights(captures: &[&Capture]) -> Vec<f64> {
    let known: Vec<usize> = captures.iter().filter_map(|one| one.photographs).collect();
    let mean = match known.len() {
        0 => 1.0,
        count => known.iter().sum::<usize>() as f64 / count as f64,
    };
    let weight = |one: &&Capture| one.photographs.map_or(mean, |count| count as f64);
    captures.iter().map(weight).collect()
}

struct StopAtEnd<'a>(&'a AtomicBool);

impl Drop for StopAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
