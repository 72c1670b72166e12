//! How many captures an hour a batch does, and what it adds to a capture.
use crate::args::{Arguments, BenchBatchArgs, Command};
use crate::{Outcome, batch};
use anyhow::{Context, Result, bail};
use clap::Parser;
use normalight_io::{photograph_png, write_files};
use normalight_synth::{BitDepth, Framing, Preset, Renderer};
use serde::Serialize;
use std::path::Path;
use std::process::Stdio;
use std::time::Instant;

/// What was measured, as it is printed.
#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    captures: u64,
    images: usize,
    /// Side of the photographs in pixels.
    size: usize,
    settings: Vec<String>,
    /// Seconds of the same captures by calls of `estimate`, one after the other.
    plain_seconds: f64,
    cases: Vec<Case>,
    /// Seconds that a capture takes longer in a batch with one job than by itself.
    overhead_seconds: f64,
    /// Seconds of a second call, which finds everything done.
    unchanged_seconds: f64,
}

#[derive(Debug, Serialize)]
struct Case {
    jobs: usize,
    seconds: f64,
    captures_per_hour: f64,
}

/// Draws captures, estimates each by itself, then all in batches of one and of two jobs.
pub(crate) fn run(args: &BenchBatchArgs) -> Result<Outcome> {
    let place = tempfile::tempdir().context("no folder for the captures")?;
    let captures = place.path().join("captures");
    let (images, size) = (args.images as usize, args.size as usize);
    let renderer = Renderer::new(Preset::World.recipe())?;
    for number in 0..u64::from(args.captures) {
        let sample = renderer.sample(number, images, size, Framing::WholeObject);
        let photographs = sample.to_stack_images(BitDepth::Eight);
        let files: Vec<(String, Vec<u8>)> = photographs
            .iter()
            .enumerate()
            .map(|(index, image)| Ok((format!("{index:03}.png"), photograph_png(image)?)))
            .collect::<Result<_>>()?;
        write_files(&captures.join(number.to_string()), &files)?;
    }
    let plain_seconds = seconds(|| {
        (0..args.captures).try_for_each(|number| {
            let capture = captures.join(number.to_string());
            let result = place.path().join("plain").join(number.to_string());
            by_itself(args, &capture, &result)
        })
    })?;
    let mut cases = Vec::new();
    for jobs in [1, 2] {
        let out = place.path().join(format!("jobs-{jobs}"));
        let seconds = seconds(|| in_batch(args, &captures, &out, jobs))?;
        cases.push(Case {
            jobs,
            seconds,
            captures_per_hour: 3600.0 * f64::from(args.captures) / seconds,
        });
    }
    let out = place.path().join("jobs-1");
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        captures: args.captures.into(),
        images,
        size,
        settings: args.settings.clone(),
        plain_seconds,
        overhead_seconds: (cases[0].seconds - plain_seconds) / f64::from(args.captures),
        unchanged_seconds: seconds(|| in_batch(args, &captures, &out, 1))?,
        cases,
    };
    super::print_report(&report, args.json, to_text)
}

/// How long something takes.
fn seconds(work: impl FnOnce() -> Result<()>) -> Result<f64> {
    let start = Instant::now();
    work()?;
    Ok(start.elapsed().as_secs_f64())
}

/// One capture by a call of this program, as a batch does it.
fn by_itself(args: &BenchBatchArgs, capture: &Path, result: &Path) -> Result<()> {
    let program = std::env::current_exe().context("this program's own file cannot be found")?;
    let status = std::process::Command::new(program)
        .arg("estimate")
        .arg(capture)
        .arg("--out")
        .arg(result)
        .args(&args.settings)
        .arg("--quiet")
        .stdout(Stdio::null())
        .status()?;
    if !status.success() {
        bail!("estimate ended with {status}");
    }
    Ok(())
}

/// All captures by `normalight batch`.
fn in_batch(args: &BenchBatchArgs, captures: &Path, out: &Path, jobs: usize) -> Result<()> {
    let [captures, out] = [captures, out].map(|path| path.to_string_lossy().into_owned());
    let jobs = jobs.to_string();
    let given = [
        "normalight",
        "batch",
        &captures,
        "--out",
        &out,
        "--jobs",
        &jobs,
        "--quiet",
        "--",
    ];
    let given = given
        .into_iter()
        .chain(args.settings.iter().map(String::as_str));
    let Command::Batch(arguments) = Arguments::try_parse_from(given)?.command else {
        unreachable!("the word batch stands for that command");
    };
    match batch::run(&arguments)? {
        Outcome::Done => Ok(()),
        _ => bail!("not every capture has its result"),
    }
}

fn to_text(report: &Report) -> String {
    let Report {
        captures,
        images,
        size,
        plain_seconds,
        overhead_seconds,
        unchanged_seconds,
        ..
    } = report;
    let mut text = format!(
        "{captures} captures of {images} photographs of {size}x{size} pixels\nby themselves:   {plain_seconds:.2} s\n"
    );
    for case in &report.cases {
        text += &format!(
            "batch, {} job(s): {:.2} s, {:.0} captures an hour\n",
            case.jobs, case.seconds, case.captures_per_hour
        );
    }
    text + &format!(
        "a batch adds {overhead_seconds:.3} s to a capture; a second call that finds all done takes {unchanged_seconds:.2} s\n"
    )
}
