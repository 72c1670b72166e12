//! `normalight train`.
use crate::Outcome;
use crate::args::TrainArgs;
use crate::choices::word;
use crate::terminal::{note, print};
use crate::{device, interrupt, progress};
use anyhow::{Context, Result, bail};
use indicatif::ProgressBar;
use normalight_train::{
    Devices, RunState, StepReport, Summary, TrainError, TrainEvent, TrainRecipe, TrainRun, train,
};
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
    let mut monitor = Monitor::new(&recipe, args.quiet);
    let run = TrainRun {
        recipe,
        folder: args.run.clone(),
        resume: args.resume,
        command: std::env::args().collect::<Vec<_>>().join(" "),
    };
    let summary = train(&run, Devices { main, others }, |event| {
        monitor.show(event);
        interrupt::answer()
    })?;
    monitor.bar.finish_and_clear();
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
        Err(error @ (TrainError::File { .. } | TrainError::Recipe { .. })) => {
            return Err(error.into());
        }
        recipe => recipe.with_context(|| path.display().to_string())?,
    };
    if recipe.network != args.network.into() {
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
    let best = match &summary.best {
        Some(best) => format!("{:.2} degrees at step {}", best.degrees, best.step),
        None => "none".to_owned(),
    };
    let waited = 100.0 * summary.hours_waited / summary.hours.max(1e-12);
    format!(
        "best validation error: {best}\nhours: {:.2} ({waited:.0} % waiting for samples)\n\
         weights: {}\n",
        summary.hours,
        weights.display()
    )
}

/// Shows how the training goes: a bar on a terminal, a line for each validation elsewhere.
struct Monitor {
    bar: ProgressBar,
    quiet: bool,
    batch: usize,
    validation: Option<f32>,
    begun: bool,
}

impl Monitor {
    fn new(recipe: &TrainRecipe, quiet: bool) -> Self {
        let template = "[{bar:30}] {pos}/{len}  {msg}  {eta} left";
        Self {
            bar: progress::bar(recipe.steps as u64, template, quiet),
            quiet,
            batch: recipe.batch,
            validation: None,
            begun: false,
        }
    }

    fn show(&mut self, event: TrainEvent) {
        match event {
            TrainEvent::Step(report) => self.step(report),
            TrainEvent::Note(text) if !self.quiet => self.bar.suspend(|| note(&text)),
            TrainEvent::Note(_) => {}
        }
    }

    fn step(&mut self, report: StepReport) {
        self.bar.set_position(report.step as u64);
        if !self.begun {
            // Steps of an earlier run must not count for the speed.
            self.bar.reset_eta();
            self.begun = true;
        }
        self.validation = report.validation.or(self.validation);
        let speed = self.bar.per_sec() * self.batch as f64;
        let best = report
            .best
            .map_or(String::new(), |best| format!(" (best {best:.2})"));
        let validation = self.validation.map_or(String::new(), |error| {
            format!("  validation {error:.2}{best} degrees")
        });
        let line = format!("loss {:.4}{validation}  {speed:.1} samples/s", report.loss);
        if report.validation.is_some() && self.bar.is_hidden() && !self.quiet {
            note(&format!("step {}  {line}", report.step));
        }
        self.bar.set_message(line);
    }
}
