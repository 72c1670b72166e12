//! A search from its recipe to its genotype.
use super::card::card;
use super::learner::{RESULT, SearchLearner};
use super::samples::HalvesMaker;
use super::{SearchRecipe, SearchTask};
use burn::tensor::Device;
use normalight_run::RunError;
use normalight_run::{
    Caller, Learner, LoopSchedule, RunEvent, RunSpec, Session, StepsOn, Summary, load, run_job,
};
use normalight_train::{FREE, LightTask, NetworkRecipe, NormalTask, TrainError, threads};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// A search: one folder.
#[derive(Debug, Clone)]
pub struct SearchRun {
    /// What to search.
    pub recipe: SearchRecipe,
    /// Folder for log, curves, checkpoints and the genotype; created when missing.
    pub folder: PathBuf,
    /// Continue from the folder's checkpoint; without one a fresh start.
    pub resume: bool,
    /// Where the steps of the weights are computed.
    pub steps_on: StepsOn,
    /// The program that asks for it.
    pub caller: Caller,
}

/// Searches as the recipe says; `observe` as in [`train`](normalight_train::train).
///
/// The folder then holds what one of a training run does, but instead of weights `genotype.json`, which training takes as
/// it is, drawings of the cells, and the operations' weights over time as `alpha.csv` and as drawings.
///
/// `device` must be a plain one; gradients are switched on inside.
///
/// # Errors
/// [`TrainError`], which the summary then tells, too, unless nothing has begun.
pub fn search(
    run: &SearchRun,
    device: &Device,
    mut observe: impl FnMut(RunEvent) -> ControlFlow<()>,
) -> Result<Summary, TrainError> {
    search_observed(run, device, &mut observe)
}

/// What is told of a run, and whether it goes on; not generic: else every program that searches would compile all of
/// it again.
type Observe<'a> = &'a mut dyn FnMut(RunEvent) -> ControlFlow<()>;

fn search_observed(
    run: &SearchRun,
    device: &Device,
    mut observe: Observe<'_>,
) -> Result<Summary, TrainError> {
    run.recipe.validate()?;
    match &run.recipe.training.network {
        NetworkRecipe::Light(settings) => {
            search_network(LightTask::new(settings), run, device, &mut observe)
        }
        NetworkRecipe::Normal(settings) => {
            search_network(NormalTask::new(settings), run, device, &mut observe)
        }
    }
}

/// What a search would have found with another cap on skips, or none: from the weights of its last checkpoint, without
/// searching again. Files by name: `genotype.json` and the drawings.
///
/// # Errors
/// Files of the run that are missing or broken; a cap that the recipe's operations cannot keep.
pub fn derive_again(
    folder: &Path,
    most_skips: Option<usize>,
    device: &Device,
) -> Result<Vec<(String, Vec<u8>)>, TrainError> {
    let mut recipe = SearchRecipe::read(&folder.join("recipe.toml"))?;
    recipe.search.most_skips = most_skips;
    recipe.validate()?;
    match &recipe.training.network {
        NetworkRecipe::Light(settings) => {
            derived(LightTask::new(settings), &recipe, folder, device)
        }
        NetworkRecipe::Normal(settings) => {
            derived(NormalTask::new(settings), &recipe, folder, device)
        }
    }
}

fn derived<T: SearchTask>(
    task: T,
    recipe: &SearchRecipe,
    folder: &Path,
    device: &Device,
) -> Result<Vec<(String, Vec<u8>)>, TrainError> {
    let mut learner = SearchLearner::new(task, recipe, device, StepsOn::Host)?;
    let loaded = load(folder)?;
    learner
        .restore(loaded.tensors, loaded.training_state.step)
        .map_err(|reason| {
            TrainError::Run(RunError::Checkpoint {
                path: loaded.path,
                reason,
            })
        })?;
    let genotype = learner.result()?.unwrap_or_default();
    let mut files = vec![(RESULT.to_owned(), genotype)];
    files.extend(learner.drawings());
    Ok(files)
}

fn search_network<T: SearchTask>(
    task: T,
    run: &SearchRun,
    device: &Device,
    observe: &mut Observe<'_>,
) -> Result<Summary, TrainError> {
    let recipe = &run.recipe;
    let mut learner = SearchLearner::new(task, recipe, device, run.steps_on)?;
    let training = &recipe.training;
    let spec = RunSpec {
        folder: run.folder.clone(),
        resume: run.resume,
        recipe: recipe.to_toml()?,
        free: &FREE,
        network: training.network.kind().name().to_owned(),
        parameters: learner.parameters(),
        seed: training.seed,
        schedule: LoopSchedule {
            steps: training.steps,
            validate_every: training.validate_every,
            checkpoint_every: training.checkpoint_every,
            batch: training.batch,
        },
        exit_codes: run.caller.exit_codes,
        result: RESULT,
    };
    run_job(
        &spec,
        observe,
        |session| go(recipe, device, &mut learner, session),
        |summary| card(recipe, summary, &run.caller.command),
    )
}

fn go<T: SearchTask, O: FnMut(RunEvent) -> ControlFlow<()>>(
    recipe: &SearchRecipe,
    device: &Device,
    learner: &mut SearchLearner<'_, T>,
    session: &mut Session<O>,
) -> Result<ControlFlow<()>, TrainError> {
    let training = &recipe.training;
    // Before anything is written: a file that the recipe names may be missing.
    let (maker, second) = HalvesMaker::open(learner.task(), training, device)?;
    session.begin(learner, |_| {
        Ok(format!(
            "started with random weights of seed {}",
            training.seed
        ))
    })?;
    let pixels = training.network.validation_pixels(training.size);
    learner.validate_on(second.validation_objects(training, pixels)?);
    session.go(learner, &maker, threads(training))
}
