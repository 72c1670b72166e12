//! `normalight estimate`.
use crate::Outcome;
use crate::args::EstimateArgs;
use crate::choices::word;
use crate::progress::{ProgressObserver, Spinner};
use crate::settings::{Estimation, describe};
use crate::terminal::print;
use crate::{interrupt, outputs};
use anyhow::{Context, Result, bail};
use normalight_core::{CoreError, Light};
use normalight_io::{
    ColorMode, IoError, MaskChoice, OutputFolder, ReadOptions, Report, StackInput, StageSeconds,
    read_named, read_paths,
};
use normalight_model::ModelError;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Photographs in, files out. What can fail early comes first; nothing is written before all of it
/// is computed.
pub(crate) fn run(args: &EstimateArgs) -> Result<Outcome> {
    check_apart(&args.inputs, &args.out)?;
    let folder = OutputFolder::prepare(&args.out)?;
    let start = Instant::now();
    let estimation = Estimation::open(&args.estimation)?;
    let opened = start.elapsed();
    let input = read(args)?;
    let lights = read_lights(args, &input)?;
    let read = start.elapsed() - opened;

    let mut follower = ProgressObserver::new("", args.quiet);
    let estimated = pollster::block_on(estimation.estimator.estimate(
        &input.stack,
        &input.mask,
        lights.as_deref(),
        estimation.settings,
        &mut follower,
    ));
    let stages = follower.finish();
    let estimate = match estimated {
        Err(ModelError::Cancelled) => return Ok(Outcome::Interrupted),
        estimated => estimated?,
    };

    let before = [("start", opened), ("reading", read)];
    let before = before.map(|(stage, time)| StageSeconds {
        stage: stage.to_owned(),
        seconds: time.as_secs_f64(),
    });
    let report = Report {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        inputs: input.picked_names(),
        width: input.stack.width(),
        height: input.stack.height(),
        mask: input.mask_label().to_owned(),
        color: ColorMode::from(args.color).to_string(),
        lights_from: lights_in_words(args),
        device: estimation.device.clone(),
        weights: estimation.hashes(lights.is_some()),
        settings: settings(args),
        seconds: before.into_iter().chain(stages).collect(),
    };
    let files = outputs::encode(&input, &estimate, args.normal_format.into(), &report)?;
    if interrupt::asked() {
        return Ok(Outcome::Interrupted);
    }
    folder.write(&files)?;
    if !args.quiet {
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        print(&outputs::summary(
            &report,
            &names,
            &args.out.display().to_string(),
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

fn read(args: &EstimateArgs) -> Result<StackInput> {
    let mask = match &args.mask {
        None => MaskChoice::Auto,
        Some(path) if path == Path::new("none") => MaskChoice::WholeFrame,
        Some(path) => MaskChoice::File(read_named(path)?),
    };
    let options = ReadOptions {
        color: args.color.into(),
        mask,
        images: args.images,
    };
    let _spinner = Spinner::new("reading photographs", args.quiet);
    match read_paths(&args.inputs, &options) {
        // The one error about all images at once: it can name none of them.
        Err(error @ IoError::Core(CoreError::AllBlack { .. })) => {
            Err(error).with_context(|| args.inputs[0].display().to_string())
        }
        input => Ok(input?),
    }
}

fn read_lights(args: &EstimateArgs, input: &StackInput) -> Result<Option<Vec<Light>>> {
    let lights = args.lights.as_ref();
    Ok(lights
        .map(|path| input.read_lights_path(path))
        .transpose()?)
}

fn lights_in_words(args: &EstimateArgs) -> String {
    match &args.lights {
        Some(path) => path.display().to_string(),
        None if args.estimation.no_refit => "estimated by the light network".to_owned(),
        None => "estimated by the light network, refitted to the normals".to_owned(),
    }
}

fn settings(args: &EstimateArgs) -> serde_json::Value {
    let path = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
    let mut settings = describe(&args.estimation, args.lights.is_some());
    settings.extend([
        ("mask".to_owned(), path(&args.mask).into()),
        ("lights".to_owned(), path(&args.lights).into()),
        ("images".to_owned(), args.images.into()),
        ("normal_format".to_owned(), word(args.normal_format).into()),
        ("color".to_owned(), word(args.color).into()),
    ]);
    settings.into()
}
