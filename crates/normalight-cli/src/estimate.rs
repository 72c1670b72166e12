//! `normalight estimate`.
use crate::Outcome;
use crate::args::EstimateArgs;
use crate::choices::word;
use crate::progress::{ProgressObserver, Spinner};
use crate::settings::Estimation;
use crate::terminal::{note, print};
use crate::{interrupt, outputs};
use anyhow::{Context, Result, bail};
use normalight_core::{CoreError, Light};
use normalight_io::{
    AmbientChoice, IoError, MaskChoice, OutputFolder, ReadOptions, RunDescription, StackInput,
    StageSeconds, derived_files, notice_lines, read_named, read_paths, result_files,
};
use normalight_model::{EstimateInput, ModelError};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Photographs in, files out. What can fail early comes first; nothing is written before all of it
/// is computed.
pub(crate) fn run(args: &EstimateArgs) -> Result<Outcome> {
    let (Some(out), false) = (&args.out, args.dry_run) else {
        return dry_run(args);
    };
    check_apart(&args.inputs, out)?;
    let folder = OutputFolder::prepare(out)?;
    let start = Instant::now();
    let estimation = Estimation::open(&args.estimation)?;
    let opened = start.elapsed();
    let reading = reading(args)?;
    let mut input = read(args, &reading)?;
    let lights = read_lights(args, &mut input)?;
    if !args.quiet {
        note(said(args, &input).trim_end());
    }
    let read = start.elapsed() - opened;

    let mut observer = ProgressObserver::new("", args.quiet);
    let estimated = pollster::block_on(estimation.estimator.estimate(
        EstimateInput {
            stack: &input.stack,
            mask: &input.mask,
            lights: lights.as_deref(),
        },
        estimation.settings,
        &mut observer,
    ));
    let stages = observer.finish();
    let estimate = match estimated {
        Err(ModelError::Cancelled) => return Ok(Outcome::Interrupted),
        estimated => estimated?,
    };
    if lights.is_none() {
        let doubts = notice_lines(input.judge_coverage(&estimate.lights));
        if !args.quiet && !doubts.is_empty() {
            note(&doubts.join("\n"));
        }
    }

    let before = [("start", opened), ("reading", read)];
    let before = before.map(|(stage, time)| StageSeconds {
        stage: stage.to_owned(),
        seconds: time.as_secs_f64(),
    });
    let lights_file = args.lights.as_ref().map(|path| path.display().to_string());
    let report = RunDescription {
        reading: &reading,
        settings: estimation.settings,
        lights_file: lights_file.as_deref(),
        device: [&word(args.estimation.device), &estimation.device],
        weights: estimation.estimator.weight_hashes(),
        normal_format: args.normal_format.into(),
        seconds: before.into_iter().chain(stages).collect(),
    }
    .report(&input, &estimate);
    let mut files = result_files(&input, &estimate, &report)?;
    let surface = args.surface.settings(args.normal_format.into());
    let mut derived = None;
    if surface.wanted() {
        let albedo = Some(&estimate.albedo[..]);
        let made = derived_files(&estimate.normals, albedo, &input.mask, surface)?;
        // The report stays the last file: where it is, the others are complete.
        files.splice(files.len() - 1..files.len() - 1, made.files);
        derived = Some(made.report);
    }
    if interrupt::asked() {
        return Ok(Outcome::Interrupted);
    }
    folder.write(&files)?;
    if !args.quiet {
        if let Some(known) = derived {
            print(&outputs::surface_summary(&known))?;
        }
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        print(&outputs::summary(
            &report,
            &names,
            &out.display().to_string(),
        ))?;
    }
    Ok(Outcome::Done)
}

/// Results among the photographs could replace the user's own mask or lights, and would be read as
/// input the next time.
fn check_apart(inputs: &[PathBuf], out: &Path) -> Result<()> {
    let Ok(out_folder) = out.canonicalize() else {
        // Not there yet, so nothing is in it.
        return Ok(());
    };
    for input in inputs {
        let Ok(place) = input.canonicalize() else {
            continue;
        };
        let folder = if place.is_dir() {
            Some(place.as_path())
        } else {
            place.parent()
        };
        if folder == Some(&out_folder) {
            bail!(
                "{}: the photographs lie here; choose another folder for the results",
                out.display()
            );
        }
    }
    Ok(())
}

fn reading(args: &EstimateArgs) -> Result<ReadOptions> {
    let mask = match &args.mask {
        None => MaskChoice::Auto,
        Some(path) if path == Path::new("none") => MaskChoice::WholeFrame,
        Some(path) => MaskChoice::File(read_named(path)?),
    };
    let ambient = match &args.ambient {
        None => AmbientChoice::LeaveOut,
        Some(path) if path == Path::new("auto") => AmbientChoice::Auto,
        Some(path) => AmbientChoice::File(read_named(path)?),
    };
    Ok(ReadOptions {
        color: args.color.into(),
        mask,
        images: args.images,
        ambient,
        align: args.align,
        ..ReadOptions::default()
    })
}

fn read(args: &EstimateArgs, reading: &ReadOptions) -> Result<StackInput> {
    let _spinner = Spinner::new("reading photographs", args.quiet);
    match read_paths(&args.inputs, reading) {
        // The one error about all images at once: it can name none of them.
        Err(error @ IoError::Core(CoreError::AllBlack { .. })) => {
            Err(error).with_context(|| args.inputs[0].display().to_string())
        }
        input => Ok(input?),
    }
}

fn read_lights(args: &EstimateArgs, input: &mut StackInput) -> Result<Option<Vec<Light>>> {
    let Some(path) = &args.lights else {
        return Ok(None);
    };
    let given = input.given_lights_path(path, args.light_axes)?;
    Ok(Some(
        input.accept_lights(&path.display().to_string(), given),
    ))
}

/// What was taken for what.
fn said(args: &EstimateArgs, input: &StackInput) -> String {
    match args.verbose {
        true => format!("{:#}", input.plan),
        false => input.plan.to_string(),
    }
}

/// Everything before the first computation.
fn dry_run(args: &EstimateArgs) -> Result<Outcome> {
    let mut input = read(args, &reading(args)?)?;
    read_lights(args, &mut input)?;
    print(&said(args, &input))?;
    Ok(Outcome::Done)
}
