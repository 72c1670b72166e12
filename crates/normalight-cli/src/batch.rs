//! `normalight batch`: every capture in a tree, each by a process of its own.
use crate::args::{Arguments, BatchArgs, Command, EstimateArgs};
use crate::progress::bar;
use crate::terminal::{note, print};
use crate::{Outcome, interrupt};
use anyhow::{Context, Result, bail};
use clap::Parser;
use indicatif::ProgressBar;
use normalight_batch::{
    BatchObserver, BatchSettings, BatchSummary, Capture, Found, Outcome as RowOutcome, Program,
    Progress, Row, Stopped, available_memory, collect, find_captures, run_batch,
};
use normalight_model::default_weights;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;
use std::time::Duration;

/// Share of the free memory that is taken where nothing is asked for.
const FREE: f64 = 0.8;

/// Estimates all captures, or says what they are, or collects results.
pub(crate) fn run(args: &BatchArgs) -> Result<Outcome> {
    if args.collect {
        let output = args.out.as_deref().unwrap_or(Path::new(""));
        return end(args, &collect(output)?);
    }
    let root = args.root.clone().unwrap_or_default();
    let estimate = settings_of_estimate(&args.settings)?;
    if args.dry_run {
        return say(&find_captures(&root)?, args.verbose);
    }
    // Jobs that share all cores finish sooner than such that each have a part of them.
    let cores = available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let settings = BatchSettings {
        root,
        output: args.out.clone().unwrap_or_default(),
        program: program(args, &estimate)?,
        jobs: args.jobs.unwrap_or(cores),
        memory: args
            .memory
            .or_else(|| available_memory().map(|free| (FREE * free as f64) as u64)),
        shard: args.shard,
        time_limit: args
            .time_limit
            .map(|minutes| Duration::from_secs(60 * u64::from(minutes))),
        check_contents: args.check_contents,
    };
    let mut watch = Watch::new(args.quiet);
    let summary = run_batch(&settings, interrupt::flag(), &mut watch)?;
    drop(watch);
    end(args, &summary)
}

/// The settings after `--`, checked before anything begins.
fn settings_of_estimate(settings: &[String]) -> Result<EstimateArgs> {
    let given = ["normalight", "estimate", "CAPTURE", "--out", "RESULT"];
    let all = given.into_iter().chain(settings.iter().map(String::as_str));
    let parsed = Arguments::try_parse_from(all);
    match parsed.map(|arguments| arguments.command) {
        Ok(Command::Estimate(estimate)) => {
            let own = [
                (estimate.inputs.len() > 1, "further photographs"),
                (estimate.dry_run, "--dry-run"),
                (estimate.verbose, "--verbose"),
                (estimate.quiet, "--quiet"),
            ];
            match own.into_iter().find(|(given, _)| *given) {
                Some((_, word)) => bail!("after `--`: {word} found, settings of estimate expected"),
                None => Ok(estimate),
            }
        }
        Ok(_) => bail!("after `--`: settings of estimate expected"),
        Err(error) => bail!(
            "after `--`: {}",
            error.to_string().trim_start_matches("error: ")
        ),
    }
}

/// This program, as it does one capture.
fn program(args: &BatchArgs, estimate: &EstimateArgs) -> Result<Program> {
    let [light, normal] = default_weights()?;
    let named = [
        estimate
            .mask
            .as_ref()
            .filter(|mask| **mask != Path::new("none")),
        estimate.lights.as_ref(),
        estimate
            .ambient
            .as_ref()
            .filter(|file| **file != Path::new("auto")),
        estimate.estimation.light_weights.as_ref(),
        estimate.estimation.normal_weights.as_ref(),
    ];
    let files: Vec<PathBuf> = named.into_iter().flatten().cloned().collect();
    Ok(Program {
        path: std::env::current_exe().context("this program's own file cannot be found")?,
        version: format!(
            "{} {} {}",
            env!("CARGO_PKG_VERSION"),
            light.hash(),
            normal.hash()
        ),
        arguments: args.settings.iter().map(Into::into).collect(),
        files,
        environment: Vec::new(),
    })
}

/// Prints what a walk found.
fn say(found: &Found, all: bool) -> Result<Outcome> {
    print(&(found.lines(all).join("\n") + "\n"))?;
    Ok(Outcome::Done)
}

/// Prints how it ended.
fn end(args: &BatchArgs, summary: &BatchSummary) -> Result<Outcome> {
    let count = |kind: &RowOutcome| summary.count(kind);
    let failed = count(&RowOutcome::Failed(String::new()));
    if !args.quiet {
        print(&format!(
            "captures: {}: {} done, {} unchanged, {failed} failed, {} not done\ntable and page: {}\n",
            summary.rows.len(),
            count(&RowOutcome::Done),
            count(&RowOutcome::Unchanged),
            count(&RowOutcome::NotDone),
            summary.output.display(),
        ))?;
    }
    match summary.stopped {
        Some(Stopped::Cancelled) => Ok(Outcome::Interrupted),
        Some(_) => bail!("{}: nothing more can be written", summary.output.display()),
        None if summary.is_complete() => Ok(Outcome::Done),
        None => Ok(Outcome::PartlyFailed),
    }
}

/// A bar over all captures, and a line for each that failed.
struct Watch {
    bar: ProgressBar,
    quiet: bool,
}

impl Watch {
    fn new(quiet: bool) -> Self {
        Self {
            bar: bar(0, "{msg:40!} [{bar:30}] {pos} of {len}{prefix}", quiet),
            quiet,
        }
    }

    fn tell(&self, text: &str) {
        if !self.quiet {
            self.bar.suspend(|| note(text));
        }
    }
}

impl BatchObserver for Watch {
    fn found(&mut self, found: &Found, mine: usize) {
        self.bar.set_length(mine as u64);
        let more = match found.captures.len() == mine {
            true => String::new(),
            false => format!(", {mine} of them here"),
        };
        self.tell(&format!("captures: {}{more}", found.captures.len()));
    }

    fn started(&mut self, capture: &Capture) {
        self.bar.set_message(capture.name());
    }

    fn finished(&mut self, row: &Row, progress: &Progress) {
        self.bar.set_position(progress.done as u64);
        if let Some(left) = progress.left {
            self.bar.set_prefix(format!(", {} left", in_words(left)));
        }
        if let RowOutcome::Failed(words) = &row.outcome {
            self.tell(&format!("{}: {words}", row.capture));
        }
    }

    fn noticed(&mut self, words: &str) {
        self.tell(&format!("notice: {words}"));
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// A time as people say it.
fn in_words(time: Duration) -> String {
    let minutes = time.as_secs().div_ceil(60);
    match minutes {
        0..=1 => "a minute".to_owned(),
        2..=119 => format!("{minutes} minutes"),
        _ => format!("{} hours", minutes.div_ceil(60)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_checked_before_anything_begins() {
        let given = |settings: &[&str]| {
            let settings: Vec<String> = settings.iter().map(|&word| word.to_owned()).collect();
            settings_of_estimate(&settings)
        };
        assert!(given(&[]).is_ok());
        assert!(given(&["--quality", "fast", "--mask", "none"]).is_ok());
        for wrong in [
            &["--quality", "great"][..],
            &["--out", "elsewhere"],
            &["more.png"],
            &["--quiet"],
            &["--dry-run"],
        ] {
            let error = given(wrong).unwrap_err().to_string();
            assert!(error.starts_with("after `--`: "), "{error}");
        }
    }

    #[test]
    fn times_in_words() {
        let words = [30, 61, 7200, 90_000].map(|seconds| in_words(Duration::from_secs(seconds)));
        assert_eq!(words, ["a minute", "2 minutes", "2 hours", "25 hours"]);
    }
}
