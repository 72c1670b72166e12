//! A training run from its recipe to its summary.
use crate::checkpoint::{self, Standing};
use crate::learner::Learner;
use crate::light_task::LightTask;
use crate::loader::Batches;
use crate::model_card::model_card;
use crate::network_learner::NetworkLearner;
use crate::normal_task::NormalTask;
use crate::predicted::{Predictor, read_weights};
use crate::recipe::MOST_GIGABYTES;
use crate::run_folder::{Found, RunFolder};
use crate::samples::SampleMaker;
use crate::source::Source;
use crate::task::Task;
use crate::training_loop::{Pace, StepReport, train_loop};
use crate::{Network, RunState, Summary, TrainError, TrainRecipe};
use burn::tensor::Device;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::available_parallelism;

/// Side in pixels of the whole objects that normals are validated on.
const VALIDATION_PIXELS: usize = 96;

/// A training run: one folder.
#[derive(Debug, Clone)]
pub struct TrainRun {
    /// What to train.
    pub recipe: TrainRecipe,
    /// Folder for log, curves, checkpoints and weights; created when missing.
    pub folder: PathBuf,
    /// Continue from the folder's checkpoint; without one a fresh start.
    pub resume: bool,
    /// The command line that asks for it, for the model card.
    pub command: String,
}

/// What happens during a run.
#[derive(Debug, Clone, PartialEq)]
pub enum TrainEvent {
    /// Something a person should know.
    Note(String),
    /// A step.
    Step(StepReport),
}

/// Trains as the recipe says; `observe` is called after every step and may then stop the run, which
/// writes a checkpoint and can be continued. Its answers to notes are ignored.
///
/// The folder then holds `recipe.toml`, `log.txt`, `curves.csv`, `curves.png`,
/// `checkpoint.safetensors` and the one before it, `weights.safetensors` (best on validation),
/// `summary.json` and, at the end, `model-card.md`. Asked for a run that is finished, it does nothing.
///
/// `device` must be a plain device; gradients are switched on inside.
///
/// # Errors
/// [`TrainError`], which the summary then tells, too, unless nothing has begun.
pub fn train(
    run: &TrainRun,
    device: &Device,
    mut observe: impl FnMut(TrainEvent) -> ControlFlow<()>,
) -> Result<Summary, TrainError> {
    run.recipe.validate()?;
    let folder = RunFolder::open(&run.folder)?;
    let note = match folder.find(&run.recipe, run.resume)? {
        Found::Begun(note) => note,
        Found::Finished(summary) => {
            let _ = observe(TrainEvent::Note(
                "finished already, nothing is left to do".into(),
            ));
            return Ok(summary);
        }
    };
    let mut standing = Standing::start();
    let mut session = Session {
        run,
        device,
        folder: &folder,
        standing: &mut standing,
        observe: &mut observe,
    };
    let result = match run.recipe.network {
        Network::Light => session.train::<LightTask>(note),
        Network::Normal => session.train::<NormalTask>(note),
    };
    let state = match &result {
        Ok(ControlFlow::Continue(())) => RunState::Finished,
        Ok(ControlFlow::Break(())) => RunState::Interrupted,
        Err(_) => RunState::Failed,
    };
    let weights = folder.read("weights.safetensors");
    let summary = Summary::new(&run.recipe, &standing, state, weights.as_deref());
    if let Err(error) = result {
        if folder.has_run() {
            folder.log(&format!("error: {error}"));
            // The error itself matters more than one in telling about it, on a full disk say.
            let _ = folder.write_summary(&summary.failed(&error));
        } else {
            folder.abandon();
        }
        return Err(error);
    }
    if state == RunState::Finished {
        let card = model_card(&run.recipe, &summary, &run.command);
        folder.write("model-card.md", card.as_bytes())?;
    }
    folder.log(match state {
        RunState::Finished => "finished",
        _ => "interrupted",
    });
    folder.write_summary(&summary)?;
    Ok(summary)
}

/// What the parts of a run share.
struct Session<'a, O> {
    run: &'a TrainRun,
    device: &'a Device,
    folder: &'a RunFolder,
    standing: &'a mut Standing,
    observe: &'a mut O,
}

impl<O: FnMut(TrainEvent) -> ControlFlow<()>> Session<'_, O> {
    fn train<T: Task>(&mut self, note: Option<String>) -> Result<ControlFlow<()>, TrainError> {
        let recipe = &self.run.recipe;
        // Before anything is written: a file that the recipe names may be missing.
        let source = Arc::new(Source::open(recipe, T::FRAMING)?);
        let mix = &recipe.normal.lights;
        let predictor = (recipe.network == Network::Normal && mix.predicted > 0.0)
            .then(|| Predictor::new(mix.light_weights.as_deref(), self.device))
            .transpose()?;
        let mut learner = NetworkLearner::<T>::new(recipe, self.device)?;
        let notes = self.prepare(&mut learner)?;
        self.folder.clean();
        self.folder.write_recipe(recipe)?;
        for note in note.into_iter().chain(notes) {
            self.folder.log(&note);
            let _ = (self.observe)(TrainEvent::Note(note));
        }
        let weights = self.folder.read(NetworkLearner::<T>::RESULT);
        let state = RunState::Running;
        let summary = Summary::new(recipe, self.standing, state, weights.as_deref());
        self.folder.write_summary(&summary)?;
        let pixels = match recipe.network {
            Network::Light => recipe.size,
            Network::Normal => VALIDATION_PIXELS,
        };
        learner.validate_on(source.validation_objects(recipe, pixels)?);
        let maker = SampleMaker::<T>::new(recipe, &source, predictor);
        let (threads, first) = (threads(recipe), self.standing.step);
        let mut batches = Batches::start(&maker, threads, first, recipe.steps);
        let pace = Pace {
            steps: recipe.steps,
            validate_every: recipe.validate_every,
            checkpoint_every: recipe.checkpoint_every,
            batch: recipe.batch,
        };
        let observe = &mut *self.observe;
        let observe = |report| observe(TrainEvent::Step(report));
        let (folder, standing) = (self.folder, &mut *self.standing);
        train_loop(&mut learner, &mut batches, folder, pace, standing, observe)
    }

    /// Continues from a checkpoint, or starts from weights or at random; tells which.
    fn prepare<T: Task>(
        &mut self,
        learner: &mut NetworkLearner<T>,
    ) -> Result<Vec<String>, TrainError> {
        let recipe = &self.run.recipe;
        let path = self.folder.path();
        if self.run.resume && checkpoint::exists(path) {
            let loaded = checkpoint::load(path)?;
            let step = loaded.standing.step;
            let refused = |reason| TrainError::Checkpoint {
                path: path.join("checkpoint.safetensors"),
                reason,
            };
            learner.restore(loaded.tensors, step).map_err(refused)?;
            *self.standing = loaded.standing;
            let continued = format!("continued after step {step} of {}", recipe.steps);
            return Ok(loaded.note.into_iter().chain([continued]).collect());
        }
        let start = match &recipe.init {
            Some(init) => {
                learner.start_from(&read_weights(init)?)?;
                format!("started from {}", init.display())
            }
            None => format!("started with random weights of seed {}", recipe.seed),
        };
        Ok(vec![start])
    }
}

/// Threads that make samples: one core is left to the training, and no more memory is taken than a
/// recipe may ask for.
fn threads(recipe: &TrainRecipe) -> usize {
    recipe.loader_threads.unwrap_or_else(|| {
        let cores = available_parallelism().map_or(1, usize::from);
        let fit = MOST_GIGABYTES / recipe.gigabytes_of_scenes().max(1e-9);
        (cores - 1).min(fit as usize).max(1)
    })
}
