//! `normalight bench`.
mod batch;
mod operation_times;
mod render;
mod search;
mod train;

use crate::Outcome;
use crate::args::{BenchArgs, BenchCommand};
use crate::interrupt;
use crate::terminal::print;
use anyhow::{Result, bail};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Measures what was asked for.
pub(crate) fn run(args: &BenchArgs) -> Result<Outcome> {
    match &args.what {
        BenchCommand::Render(args) => render::run(args),
        BenchCommand::Train(args) => train::run(args),
        BenchCommand::Search(args) => search::run(args),
        BenchCommand::Ops(args) => operation_times::run(args),
        BenchCommand::Batch(args) => batch::run(args),
    }
}

/// How long each case takes, at least.
fn least(seconds: f64) -> Result<Duration> {
    if !(0.01..=3600.0).contains(&seconds) {
        bail!("--seconds: {seconds} found, 0.01 to 3600 expected");
    }
    Ok(Duration::from_secs_f64(seconds))
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, Into::into)
}

/// Prints a finished bench as JSON or as text.
fn print_report<R: Serialize>(
    report: &R,
    json: bool,
    to_text: impl Fn(&R) -> String,
) -> Result<Outcome> {
    print(&if json {
        serde_json::to_string_pretty(report)? + "\n"
    } else {
        to_text(report)
    })?;
    Ok(Outcome::Done)
}

/// Medians of what `work` measures, repeated for at least that long and at least five times after two warm-ups.
fn median_seconds<const N: usize>(
    least: Duration,
    mut work: impl FnMut() -> [Duration; N],
) -> [f64; N] {
    const FEWEST: usize = 5;
    for _ in 0..2 {
        work();
    }
    let mut times: [Vec<f64>; N] = std::array::from_fn(|_| Vec::new());
    let start = Instant::now();
    while start.elapsed() < least || times.iter().any(|times| times.len() < FEWEST) {
        for (times, time) in times.iter_mut().zip(work()) {
            times.push(time.as_secs_f64());
        }
        if interrupt::asked() {
            break;
        }
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    })
}
