//! `normalight train`.
use crate::Outcome;
use crate::args::TrainArgs;
use crate::choices::word;
use crate::monitor::Monitor;
use crate::terminal::{note, print};
use crate::{device, exit, interrupt};
use anyhow::{Context, Result, bail};
use normalight_run::{RunError, RunState, Summary};
use normalight_train::{Devices, TrainError, TrainRecipe, TrainRun, train};
use std::path::{Path, PathBuf};

/// Trains until the recipe's last step or Ctrl-C.
pub(crate) fn run(args: &TrainArgs) -> Result<Outcome> {
    let recipe = recipe(args)?;
    let devices = device::open_several(args.device, args.devices as usize)?;
    let (main, others) = devices.split_first().context("no device")?;
    if !args.quiet {
        let parameters = recipe.parameters();
        note(&format!(
            "{} network, {parameters} parameters",
            word(args.network)
        ));
    }
    let mut monitor = Monitor::new(recipe.steps, recipe.batch, args.quiet);
    let run = TrainRun {
        recipe,
        folder: args.run.clone(),
        resume: args.resume,
        caller: exit::caller(),
    };
    let devices = Devices {
        main,
        others,
        steps_on: device::steps_on(main),
    };
    let summary = train(&run, devices, |event| {
        monitor.show(event);
        interrupt::answer()
    })?;
    drop(monitor);
    if summary.state != RunState::Finished {
        if !args.quiet {
            note("checkpoint written; continue with --resume");
        }
        return Ok(Outcome::Interrupted);
    }
    if !args.quiet {
        print(&result(&summary, &args.run.join("weights.safetensors")))?;
    }
    Ok(Outcome::Done)
}

/// The recipe file and what the arguments change in it.
fn recipe(args: &TrainArgs) -> Result<TrainRecipe> {
    let path = &args.recipe;
    let mut recipe = match TrainRecipe::read(path) {
        // These name the file themselves.
        Err(error @ TrainError::Run(RunError::File { .. } | RunError::Recipe { .. })) => {
            return Err(error.into());
        }
        recipe => recipe.with_context(|| path.display().to_string())?,
    };
    if recipe.network.kind() != args.network.into() {
        bail!(
            "{}: this recipe does not train the {} network",
            path.display(),
            word(args.network)
        );
    }
    recipe.seed = args.seed.unwrap_or(recipe.seed);
    if let Some(threads) = args.threads {
        recipe.loader_threads = Some(threads as usize);
    }
    if let Some(init) = &args.init {
        let init: PathBuf = std::path::absolute(init).unwrap_or_else(|_| init.clone());
        recipe.init = Some(init);
    }
    Ok(recipe)
}

/// What a person wants to know at the end.
fn result(summary: &Summary, weights: &Path) -> String {
    format!("{}weights: {}\n", describe(summary), weights.display())
}

/// Error and hours of a run.
pub(crate) fn describe(summary: &Summary) -> String {
    let best = match &summary.best {
        Some(best) => format!("{:.2} degrees at step {}", best.degrees, best.step),
        None => "none".to_owned(),
    };
    let waited = 100.0 * summary.hours_waited / summary.hours.max(1e-12);
    format!(
        "best validation error: {best}\nhours: {:.2} ({waited:.0} % waiting for samples)\n",
        summary.hours
    )
}
