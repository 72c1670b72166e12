use crate::adam::{Adam, host};
use crate::checkpoint::{self, Standing, write_aside};
use crate::curves::{self, Point};
use crate::light_task::LightTask;
use crate::normal_task::NormalTask;
use crate::source::Source;
use crate::task::Task;
use crate::{Network, TrainError, TrainRecipe, loader};
use burn::module::Module;
use burn::tensor::Device;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Side in pixels of the whole objects that normals are validated on.
const VALIDATION_PIXELS: usize = 96;

/// A training run: one folder.
#[derive(Debug, Clone)]
pub struct TrainRun {
    /// What to train.
    pub recipe: TrainRecipe,
    /// Folder for log, curves, checkpoint and weights; created when missing.
    pub folder: PathBuf,
    /// Continue from the folder's checkpoint; without one a fresh start.
    pub resume: bool,
}

/// What a step gave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Steps taken so far.
    pub step: usize,
    /// Loss of this step.
    pub loss: f32,
    /// Norm of the gradient before clipping.
    pub gradient_norm: f32,
    /// Validation error in degrees, after a validation.
    pub validation: Option<f32>,
    /// Best validation error so far, in degrees.
    pub best: f32,
    /// Seconds of computing, waiting for samples left out.
    pub seconds: f64,
    /// Seconds of waiting for samples.
    pub waited: f64,
}

/// Trains as the recipe says; `observe` is called after every step and may stop the run, which
/// then writes a checkpoint.
///
/// Leaves `weights.safetensors` (best on validation), `checkpoint.safetensors`, `curves.csv` and
/// `curves.png` in the folder. Returns the best validation error in degrees.
///
/// `device` must be a plain device; gradients are switched on inside.
///
/// # Errors
/// [`TrainError`]; [`TrainError::Diverged`] leaves the last checkpoint untouched.
pub fn train(
    run: &TrainRun,
    device: &Device,
    observe: impl FnMut(StepReport) -> ControlFlow<()>,
) -> Result<f32, TrainError> {
    run.recipe.validate()?;
    match run.recipe.network {
        Network::Light => train_task::<LightTask>(run, device, observe),
        Network::Normal => train_task::<NormalTask>(run, device, observe),
    }
}

/// Whether the run in the folder, if any, was validated on the same objects.
fn same_objects(folder: &Path, recipe: &TrainRecipe) -> bool {
    let before = std::fs::read_to_string(folder.join("recipe.toml")).ok();
    let Some(before) = before.and_then(|text| TrainRecipe::parse("recipe.toml", &text).ok()) else {
        return true;
    };
    before.scene == recipe.scene
        && before.published == recipe.published
        && before.validation_objects == recipe.validation_objects
}

fn train_task<T: Task>(
    run: &TrainRun,
    device: &Device,
    mut observe: impl FnMut(StepReport) -> ControlFlow<()>,
) -> Result<f32, TrainError> {
    let recipe = &run.recipe;
    // Before anything is written: a file that the recipe names may be missing.
    let source = Arc::new(Source::open(recipe)?);
    std::fs::create_dir_all(&run.folder).map_err(|source| TrainError::File {
        path: run.folder.clone(),
        source,
    })?;
    let training = device.clone().autodiff();
    training.seed(recipe.seed);
    let fresh = T::network(recipe, &training)?;
    let checkpoint = run.folder.join("checkpoint.safetensors");
    let (mut network, mut adam, mut standing, mut points) = if run.resume && checkpoint.exists() {
        let (network, adam, standing) = checkpoint::load(&checkpoint, fresh)?;
        (network, adam, standing, curves::read(&run.folder))
    } else {
        let standing = Standing {
            step: 0,
            best: f32::INFINITY,
        };
        (fresh, Adam::default(), standing, Vec::new())
    };
    points.retain(|point| point.step <= standing.step);
    if !same_objects(&run.folder, recipe) {
        // Errors on other objects cannot be compared.
        standing.best = f32::INFINITY;
    }
    save_recipe(&run.folder, recipe)?;
    let pixels = match recipe.network {
        Network::Light => recipe.size,
        Network::Normal => VALIDATION_PIXELS,
    };
    let objects = source.validation_objects(recipe, pixels)?;
    let batches = loader::start::<T>(recipe, &source, standing.step);
    let mut recent = Vec::new();
    let mut seconds = points.last().map_or(0.0, |point| point.seconds);
    while standing.step < recipe.steps {
        let start = Instant::now();
        let batch = batches.recv().map_err(|_| TrainError::Loader)??;
        let waited = start.elapsed().as_secs_f64();
        let loss = T::loss(recipe, &network, &batch, &training);
        let gradients = loss.backward();
        let loss = host(loss).first().copied().unwrap_or(f32::NAN);
        if !loss.is_finite() {
            return Err(TrainError::Diverged {
                step: standing.step,
                loss,
            });
        }
        let rate = recipe.rate(standing.step);
        let (updated, gradient_norm) = adam.step(network, &gradients, rate, recipe.clip);
        network = updated;
        standing.step += 1;
        recent.push(loss);
        let step_seconds = start.elapsed().as_secs_f64();
        seconds += step_seconds;
        let last = standing.step == recipe.steps;
        let mut validation = None;
        if last || standing.step.is_multiple_of(recipe.validate_every) {
            let error = T::validate(recipe, &network.valid(), &objects, device)?;
            validation = Some(error);
            points.push(Point {
                step: standing.step,
                loss: recent.iter().sum::<f32>() / recent.len() as f32,
                error,
                seconds,
            });
            recent.clear();
            curves::write(&run.folder, &points)?;
            if error < standing.best {
                standing.best = error;
                let bytes = T::bytes(recipe, &network.valid())?;
                write_aside(&run.folder.join("weights.safetensors"), &bytes)?;
            }
        }
        let stop = observe(StepReport {
            step: standing.step,
            loss,
            gradient_norm,
            validation,
            best: standing.best,
            seconds: step_seconds - waited,
            waited,
        })
        .is_break();
        if last || stop || standing.step.is_multiple_of(recipe.checkpoint_every) {
            checkpoint::save(&checkpoint, &network, &adam, standing)?;
        }
        if stop {
            break;
        }
    }
    Ok(standing.best)
}

/// Keeps the recipe beside the results.
fn save_recipe(folder: &Path, recipe: &TrainRecipe) -> Result<(), TrainError> {
    let text = toml::to_string(recipe).map_err(|error| TrainError::Recipe {
        file: "recipe.toml".into(),
        reason: error.to_string(),
    })?;
    write_aside(&folder.join("recipe.toml"), text.as_bytes())
}
