//! `normalight train`.
use crate::Outcome;
use crate::args::TrainArgs;
use crate::choices::word;
use crate::terminal::{note, print};
use crate::{device, interrupt, progress};
use anyhow::{Context, Result, bail};
use indicatif::ProgressBar;
use normalight_train::{StepReport, TrainError, TrainRecipe, TrainRun, train};
use std::path::Path;

/// Trains until the recipe's last step or Ctrl-C.
pub(crate) fn run(args: &TrainArgs) -> Result<Outcome> {
    let recipe = read_recipe(&args.recipe)?;
    if recipe.network != args.network.into() {
        bail!(
            "{}: this recipe does not train the {} network",
            args.recipe.display(),
            word(args.network)
        );
    }
    let checkpoint = args.out.join("checkpoint.safetensors");
    if checkpoint.exists() && !args.resume {
        bail!(
            "{}: a run is here already; continue it with --resume or choose another folder",
            args.out.display()
        );
    }
    let device = device::open(args.device)?.device;
    if !args.quiet {
        let parameters = recipe.parameters();
        note(&format!(
            "{} network, {parameters} parameters",
            word(args.network)
        ));
    }
    let mut monitor = Monitor::new(&recipe, args.quiet);
    let run = TrainRun {
        recipe,
        folder: args.out.clone(),
        resume: args.resume,
    };
    let best = train(&run, &device, |report| {
        monitor.show(report);
        interrupt::answer()
    })?;
    monitor.bar.finish_and_clear();
    let finished = monitor
        .last_step
        .is_none_or(|step| step == run.recipe.steps);
    if !finished {
        if !args.quiet {
            note("checkpoint written; continue with --resume");
        }
        return Ok(Outcome::Interrupted);
    }
    if !args.quiet {
        let weights = args.out.join("weights.safetensors");
        print(&format!(
            "best validation error: {best:.2} degrees\nweights: {}\n",
            weights.display()
        ))?;
    }
    Ok(Outcome::Done)
}

fn read_recipe(path: &Path) -> Result<TrainRecipe> {
    match TrainRecipe::read(path) {
        // These name the file themselves.
        Err(error @ (TrainError::File { .. } | TrainError::Recipe { .. })) => Err(error.into()),
        recipe => recipe.with_context(|| path.display().to_string()),
    }
}

/// Shows how the training goes: a bar on a terminal, a line for each validation elsewhere.
struct Monitor {
    bar: ProgressBar,
    quiet: bool,
    batch: usize,
    validation: Option<f32>,
    last_step: Option<usize>,
}

impl Monitor {
    fn new(recipe: &TrainRecipe, quiet: bool) -> Self {
        let template = "[{bar:30}] {pos}/{len}  {msg}  {eta} left";
        Self {
            bar: progress::bar(recipe.steps as u64, template, quiet),
            quiet,
            batch: recipe.batch,
            validation: None,
            last_step: None,
        }
    }

    fn show(&mut self, report: StepReport) {
        self.bar.set_position(report.step as u64);
        if self.last_step.is_none() {
            // Steps of an earlier run must not count for the speed.
            self.bar.reset_eta();
        }
        self.last_step = Some(report.step);
        self.validation = report.validation.or(self.validation);
        let speed = self.bar.per_sec() * self.batch as f64;
        let validation = self.validation.map_or(String::new(), |error| {
            format!("  validation {error:.2} (best {:.2}) degrees", report.best)
        });
        let line = format!("loss {:.4}{validation}  {speed:.1} samples/s", report.loss);
        if report.validation.is_some() && self.bar.is_hidden() && !self.quiet {
            note(&format!("step {}  {line}", report.step));
        }
        self.bar.set_message(line);
    }
}
