//! `normalight search compare`.
use super::named;
use super::watch::Watch;
use crate::args::CompareArgs;
use crate::terminal::{note, print};
use crate::{Outcome, device, exit, interrupt};
use anyhow::{Context, Result};
use normalight_run::{RunError, RunState};
use normalight_search::{CompareEvent, CompareRun, compare};
use normalight_train::{TrainError, TrainRecipe};

/// Trains everything until the last step of the last one, or Ctrl-C.
pub(crate) fn run(args: &CompareArgs) -> Result<Outcome> {
    let mut recipe = named(&args.recipe, TrainRecipe::read_without_cells(&args.recipe))?;
    if let Some(threads) = args.threads {
        recipe.loader_threads = Some(threads as usize);
    }
    let device = device::open(args.device)?.device;
    let run = CompareRun {
        recipe,
        paths: args.paths.clone(),
        plain: args.plain,
        seeds: args.seeds.0.clone(),
        equal: args.equal.into(),
        multiply_adds: args.multiply_adds,
        folder: args.run.clone(),
        caller: exit::caller(),
    };
    let mut watch = Watch::new(args.quiet);
    let compared = compare(&run, &device, |event| {
        match event {
            CompareEvent::Note(text) => watch.tell(&text),
            CompareEvent::Begins { name, recipe } => watch.begin(name, recipe),
            CompareEvent::Training(event) => watch.training(event),
            CompareEvent::Ends(result) => {
                let step = result
                    .step
                    .map_or(String::new(), |step| format!(" at step {step}"));
                watch.end(result.degrees.map(f64::from), &step);
            }
        }
        interrupt::answer()
    });
    let comparison = match compared {
        // Of the schedule, whose file it does not name.
        Err(error @ TrainError::Run(RunError::Value { .. })) => {
            return Err(error).with_context(|| args.recipe.display().to_string());
        }
        compared => compared?,
    };
    drop(watch);
    if !args.quiet {
        print(&comparison.to_text())?;
    }
    if comparison.state == RunState::Finished {
        return Ok(Outcome::Done);
    }
    if !args.quiet {
        note("the same command goes on from here");
    }
    Ok(Outcome::Interrupted)
}
