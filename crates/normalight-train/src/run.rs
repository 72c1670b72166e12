//! A training run from its recipe to its summary.
use crate::light_task::LightTask;
use crate::model_card::model_card;
use crate::network_learner::{NetworkLearner, RESULT};
use crate::normal_task::NormalTask;
use crate::predicted::{Predictor, read_weights};
use crate::recipe::MOST_GIGABYTES;
use crate::samples::SampleMaker;
use crate::source::Source;
use crate::task::Task;
use crate::{NetworkRecipe, TrainError, TrainRecipe};
use burn::tensor::Device;
use normalight_run::{Caller, LoopSchedule, RunEvent, RunSpec, Session, StepsOn, Summary, run_job};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::available_parallelism;

/// What may change in a recipe when a run is continued: how long it runs and how often it reports, but not what it computes.
pub const FREE: [&str; 4] = [
    "checkpoint_every",
    "loader_threads",
    "steps",
    "validate_every",
];

/// A training run: one folder.
#[derive(Debug, Clone)]
pub struct TrainRun {
    /// What to train.
    pub recipe: TrainRecipe,
    /// Folder for log, curves, checkpoints and weights; created when missing.
    pub folder: PathBuf,
    /// Continue from the folder's checkpoint; without one a fresh start.
    pub resume: bool,
    /// The program that asks for it.
    pub caller: Caller,
}

/// Where a run computes.
#[derive(Debug, Clone, Copy)]
pub struct Devices<'a> {
    /// Holds the network and takes the steps.
    pub main: &'a Device,
    /// Compute the gradients of a part of every batch.
    pub others: &'a [Device],
    /// Where steps are computed.
    pub steps_on: StepsOn,
}

impl<'a> From<&'a Device> for Devices<'a> {
    fn from(main: &'a Device) -> Self {
        Self {
            main,
            others: &[],
            steps_on: StepsOn::Host,
        }
    }
}

/// Trains as the recipe says; `observe` is called after every step and may then stop the run, which
/// writes a checkpoint and can be continued. Its answers to notes are ignored.
///
/// The folder then holds `recipe.toml`, `log.txt`, `curves.csv`, `curves.png`,
/// `checkpoint.safetensors` and the one before it, `weights.safetensors` (best on validation),
/// `summary.json` and, at the end, `model-card.md`. Asked for a run that is finished, it does nothing.
///
/// `devices` must be plain ones; gradients are switched on inside. The first is the main one; others compute a part of
/// every batch.
///
/// # Errors
/// [`TrainError`], which the summary then tells, too, unless nothing has begun.
pub fn train<'a>(
    run: &TrainRun,
    devices: impl Into<Devices<'a>>,
    mut observe: impl FnMut(RunEvent) -> ControlFlow<()>,
) -> Result<Summary, TrainError> {
    train_observed(run, devices.into(), &mut observe)
}

/// Not generic: else every program that trains would compile the trainer again.
fn train_observed(
    run: &TrainRun,
    devices: Devices<'_>,
    mut observe: &mut dyn FnMut(RunEvent) -> ControlFlow<()>,
) -> Result<Summary, TrainError> {
    let (recipe, devices) = (&run.recipe, &devices);
    recipe.validate()?;
    let spec = RunSpec {
        folder: run.folder.clone(),
        resume: run.resume,
        recipe: recipe.to_toml()?,
        free: &FREE,
        network: recipe.network.kind().name().to_owned(),
        parameters: recipe.parameters(),
        seed: recipe.seed,
        schedule: LoopSchedule {
            steps: recipe.steps,
            validate_every: recipe.validate_every,
            checkpoint_every: recipe.checkpoint_every,
            batch: recipe.batch,
        },
        exit_codes: run.caller.exit_codes,
        result: RESULT,
    };
    let card = |summary: &Summary| model_card(recipe, summary, &run.caller.command);
    match &recipe.network {
        NetworkRecipe::Light(settings) => {
            let task = LightTask::new(settings);
            let train = |session: &mut Session<_>| train_network(task, recipe, devices, session);
            run_job(&spec, &mut observe, train, card)
        }
        NetworkRecipe::Normal(settings) => {
            let task = NormalTask::new(settings);
            let train = |session: &mut Session<_>| train_network(task, recipe, devices, session);
            run_job(&spec, &mut observe, train, card)
        }
    }
}

fn train_network<T, O>(
    task: T,
    recipe: &TrainRecipe,
    devices: &Devices<'_>,
    session: &mut Session<O>,
) -> Result<ControlFlow<()>, TrainError>
where
    T: Task,
    O: FnMut(RunEvent) -> ControlFlow<()>,
{
    // Before anything is written: a file that the recipe names may be missing.
    let source = Arc::new(Source::open(recipe, T::FRAMING)?);
    let predictor = Predictor::of(recipe, devices.main)?;
    let mut learner = NetworkLearner::new(task.clone(), recipe, *devices)?;
    session.begin(&mut learner, |learner| {
        let Some(init) = &recipe.init else {
            return Ok(format!(
                "started with random weights of seed {}",
                recipe.seed
            ));
        };
        learner.start_from(&read_weights(init)?)?;
        Ok(format!("started from {}", init.display()))
    })?;
    learner.validate_on(
        source.validation_objects(recipe, recipe.network.validation_pixels(recipe.size))?,
    );
    let maker = SampleMaker::new(task, recipe, &source, predictor);
    session.go(&mut learner, &maker, threads(recipe))
}

/// Threads that make samples: one core is left to the training, and no more memory is taken than a
/// recipe may ask for.
pub fn threads(recipe: &TrainRecipe) -> usize {
    recipe.loader_threads.unwrap_or_else(|| {
        let cores = available_parallelism().map_or(1, usize::from);
        let fit = MOST_GIGABYTES / recipe.gigabytes_of_scenes().max(1e-9);
        (cores - 1).min(fit as usize).max(1)
    })
}
