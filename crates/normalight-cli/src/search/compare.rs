//! `normalight search compare`.
use super::named;
use crate::args::CompareArgs;
use crate::monitor::Monitor;
use crate::terminal::{note, print};
use crate::{Outcome, device, exit, interrupt};
use anyhow::{Context, Result};
use normalight_run::{RunError, RunEvent, RunState};
use normalight_search::{CompareEvent, CompareRun, SeedResult, compare};
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
        watch.show(event);
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

/// A line for every training, and a bar while it runs.
struct Watch {
    quiet: bool,
    training: Option<(String, Monitor)>,
    /// Whether the training did anything: it may have been finished.
    trained: bool,
}

impl Watch {
    fn new(quiet: bool) -> Self {
        Self {
            quiet,
            training: None,
            trained: false,
        }
    }

    fn show(&mut self, event: CompareEvent) {
        match event {
            CompareEvent::Note(text) => self.tell(&text),
            CompareEvent::Begins { name, recipe } => {
                let monitor = Monitor::only_bar(recipe.steps, recipe.batch, self.quiet);
                self.training = Some((name, monitor));
                self.trained = false;
            }
            CompareEvent::Training(event) => {
                self.trained |= matches!(event, RunEvent::Step(_));
                if let Some((_, monitor)) = &mut self.training {
                    monitor.show(event);
                }
            }
            CompareEvent::Ends(result) => {
                if let Some((name, monitor)) = self.training.take() {
                    drop(monitor);
                    self.tell(&line(&name, result, self.trained));
                }
            }
        }
    }

    fn tell(&self, text: &str) {
        if !self.quiet {
            note(text);
        }
    }
}

fn line(name: &str, result: &SeedResult, trained: bool) -> String {
    let error = match result.degrees {
        Some(degrees) => format!("{degrees:.2} degrees"),
        None => "no error".to_owned(),
    };
    let step = result
        .step
        .map_or(String::new(), |step| format!(" at step {step}"));
    let earlier = if trained { "" } else { ", finished already" };
    format!("{name}: {error}{step}{earlier}")
}
