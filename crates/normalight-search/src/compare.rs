//! Genotypes against each other: each trained for the same short schedule on the same data and seeds.
mod common;
mod entries;
mod report;
mod times;
mod width;

pub use report::{Comparison, EntryKind, EntryResult, Group, SeedResult};

use crate::folder::Folder;
use burn::tensor::Device;
use common::common_text;
use entries::{Body, Entry, read_entries};
use normalight_run::{Caller, RunError, RunEvent, RunState, check, sha256};
use normalight_train::{
    LightTask, NetworkRecipe, NormalTask, Predictor, SampleMaker, Source, Task, TrainError,
    TrainRecipe, TrainRun, train,
};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use times::Times;

const RESULT: &str = "compare.json";

/// What is the same for all that are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Equal {
    /// Multiply-adds of the network, and steps of its training.
    MultiplyAdds,
    /// Multiply-adds of the network, and seconds of its training: steps that are slower are fewer.
    TrainingTime,
}

/// A comparison: one folder.
#[derive(Debug, Clone)]
pub struct CompareRun {
    /// The common schedule, of a network of cells; those in it stand in, and so does their width.
    pub recipe: TrainRecipe,
    /// Files of genotypes, or folders: the `genotype.json` in one, else all files of genotypes.
    pub paths: Vec<PathBuf>,
    /// Whether the plain network takes part.
    pub plain: bool,
    /// Seeds of weights and samples: each trains everything once.
    pub seeds: Vec<u64>,
    /// What is the same for all.
    pub equal: Equal,
    /// Multiply-adds for a stack of ten images; those of the plain network as it ships where missing.
    pub multiply_adds: Option<u64>,
    /// Folder of the trainings and of `compare.json`; created when missing. What is finished in it is kept.
    pub folder: PathBuf,
    /// The program that asks for it.
    pub caller: Caller,
}

/// What happens during a comparison.
#[derive(Debug, Clone)]
pub enum CompareEvent<'a> {
    /// Something a person should know.
    Note(String),
    /// A training begins, or goes on.
    Begins {
        /// Its entry and seed.
        name: String,
        /// What is trained.
        recipe: &'a TrainRecipe,
    },
    /// Something happens during the training.
    Training(RunEvent),
    /// The training came to its end.
    Ends(&'a SeedResult),
}

/// Trains everything as asked; `observe` is called as in [`train`] and may stop it at any event. The same comparison asked
/// for again goes on where it was.
///
/// The folder then holds a run for every entry and seed, `compare.json`, and `recipe.toml`, the common schedule; where
/// training times are equal, `times.json` as well: the times that were measured and the steps that follow.
///
/// `device` must be a plain one; gradients are switched on inside.
///
/// # Errors
/// Files that hold no genotypes of the recipe's network, before anything is written; [`RunError::OtherRecipe`] where the
/// folder holds another comparison; those of [`train`] but [`RunError::Diverged`], which is a result like another.
pub fn compare(
    run: &CompareRun,
    device: &Device,
    mut observe: impl FnMut(CompareEvent) -> ControlFlow<()>,
) -> Result<Comparison, TrainError> {
    compare_observed(run, device, &mut observe)
}

fn compare_observed(
    run: &CompareRun,
    device: &Device,
    mut observe: Observe<'_>,
) -> Result<Comparison, TrainError> {
    match &run.recipe.network {
        NetworkRecipe::Light(settings) => {
            let runner = ComparisonRunner::prepare(LightTask::new(settings), run, device)?;
            runner.run(&mut observe)
        }
        NetworkRecipe::Normal(settings) => {
            let runner = ComparisonRunner::prepare(NormalTask::new(settings), run, device)?;
            runner.run(&mut observe)
        }
    }
}

/// What is told of a comparison, and whether it goes on; not generic: else every program that compares would compile all
/// of it again.
type Observe<'a> = &'a mut dyn FnMut(CompareEvent) -> ControlFlow<()>;

/// Everything read and checked, nothing written yet.
struct ComparisonRunner<'a, T> {
    run: &'a CompareRun,
    device: &'a Device,
    entries: Vec<Entry>,
    /// Of every entry.
    recipes: Vec<TrainRecipe>,
    seeds: Vec<u64>,
    /// The common schedule as text.
    common: String,
    multiply_adds: u64,
    maker: SampleMaker<T>,
}

impl<'a, T: Task> ComparisonRunner<'a, T> {
    fn prepare(task: T, run: &'a CompareRun, device: &'a Device) -> Result<Self, TrainError> {
        let recipe = &run.recipe;
        check_schedule(recipe)?;
        let mut entries = read_entries(&run.paths, recipe.network.kind())?;
        if run.plain {
            entries.push(Entry::plain());
        }
        let mut seeds = run.seeds.clone();
        seeds.sort_unstable();
        seeds.dedup();
        for (field, count) in [("genotypes", entries.len()), ("seeds", seeds.len())] {
            check(field, count, 1..=10_000, "1 to 10000 of them")?;
        }
        let multiply_adds = match run.multiply_adds {
            Some(target) => target,
            None => width::multiply_adds(&width::plain(recipe, width::STANDARD)),
        };
        let fitted = entries
            .iter()
            .map(|entry| width::fitted(recipe, entry, multiply_adds));
        let recipes: Vec<TrainRecipe> = fitted.collect::<Result<_, _>>()?;
        for recipe in &recipes {
            for &seed in &seeds {
                with_seed(recipe, seed).validate()?;
            }
        }
        // A file that the recipe names may be missing.
        let source = Arc::new(Source::open(recipe, T::FRAMING)?);
        let predictor = Predictor::of(recipe, device)?;
        Ok(Self {
            run,
            device,
            common: common_text(recipe, run.equal, multiply_adds)?,
            maker: SampleMaker::new(task, recipe, &source, predictor),
            entries,
            recipes,
            seeds,
            multiply_adds,
        })
    }

    fn run(mut self, observe: &mut Observe<'_>) -> Result<Comparison, TrainError> {
        let folder = Folder::claim(&self.run.folder, &self.common)?;
        let mut comparison = self.empty();
        if self.run.equal == Equal::TrainingTime {
            let (entries, recipes) = (&self.entries, &self.recipes);
            let measure = || times::measure(recipes, &mut self.maker, self.device, observe);
            let Some(times) = Times::of(&folder, entries, recipes, measure)? else {
                comparison.state = RunState::Interrupted;
                return Ok(comparison);
            };
            for (index, time) in times.entries.iter().enumerate() {
                self.recipes[index].steps = time.steps;
                comparison.entries[index].steps = time.steps;
                comparison.entries[index].step_seconds = Some(time.step_seconds);
            }
        }
        comparison.state = self.train_all(&folder, &mut comparison, observe)?;
        folder.write_json(RESULT, &comparison)?;
        Ok(comparison)
    }

    /// Seed by seed, so that what is finished can be compared.
    fn train_all(
        &self,
        folder: &Folder,
        comparison: &mut Comparison,
        observe: &mut Observe<'_>,
    ) -> Result<RunState, TrainError> {
        for &seed in &self.seeds {
            for (index, recipe) in self.recipes.iter().enumerate() {
                let name = format!("{}-s{seed}", self.entries[index].name);
                let recipe = with_seed(recipe, seed);
                let begins = CompareEvent::Begins {
                    name: name.clone(),
                    recipe: &recipe,
                };
                if observe(begins).is_break() {
                    return Ok(RunState::Interrupted);
                }
                let run = TrainRun {
                    folder: folder.path().join(&name),
                    resume: true,
                    caller: self.run.caller.clone(),
                    recipe: recipe.clone(),
                };
                let mut trained = false;
                let ended = train(&run, self.device, |event| {
                    trained |= matches!(event, RunEvent::Step(_));
                    observe(CompareEvent::Training(event))
                });
                let result = match ended {
                    Ok(summary) if summary.state == RunState::Finished => {
                        SeedResult::new(seed, &summary)
                    }
                    Ok(_) => return Ok(RunState::Interrupted),
                    Err(error @ TrainError::Run(RunError::Diverged { .. })) => {
                        observe_note(observe, format!("{name}: {error}"));
                        SeedResult::diverged(seed)
                    }
                    Err(error) => return Err(error),
                };
                let _ = observe(CompareEvent::Ends(&result));
                comparison.entries[index].add(result);
                comparison.summarise();
                if trained {
                    folder.write_json(RESULT, comparison)?;
                }
            }
        }
        Ok(RunState::Finished)
    }

    fn empty(&self) -> Comparison {
        let entries = self.entries.iter().zip(&self.recipes);
        Comparison {
            state: RunState::Running,
            network: self.run.recipe.network.kind(),
            equal: self.run.equal,
            multiply_adds: self.multiply_adds,
            recipe_sha256: sha256(self.common.as_bytes()),
            entries: entries
                .map(|(entry, recipe)| EntryResult::new(entry, recipe))
                .collect(),
            groups: Vec::new(),
        }
    }
}

fn observe_note(observe: &mut Observe<'_>, text: String) {
    let _ = observe(CompareEvent::Note(text));
}

fn with_seed(recipe: &TrainRecipe, seed: u64) -> TrainRecipe {
    TrainRecipe {
        seed,
        ..recipe.clone()
    }
}

/// A schedule must be one of cells, from random weights.
fn check_schedule(recipe: &TrainRecipe) -> Result<(), TrainError> {
    recipe.validate()?;
    let refused = |field, found: &str, expected| {
        Err(TrainError::Run(RunError::Value {
            field,
            found: found.to_owned(),
            expected,
        }))
    };
    if !recipe.network.has_cells() {
        let expected = "cells; those that are compared take their place";
        return refused("kind of the architecture's body", "plain", expected);
    }
    if recipe.init.is_some() {
        let expected = "none: all that are compared start from random weights";
        return refused("init", "given", expected);
    }
    Ok(())
}
