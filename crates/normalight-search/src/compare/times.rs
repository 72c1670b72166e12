//! Equal training times: how long a step of everything takes, and how many steps that leaves it.
use super::{CompareEvent, Entry, Observe};
use crate::folder::Folder;
use burn::tensor::Device;
use normalight_run::{BatchMaker, Learner, sha256};
use normalight_train::{Batch, NetworkLearner, SampleMaker, Task, TrainError, TrainRecipe};
use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

const TIMES: &str = "times.json";

/// Everything is measured so often, in turns, so that nothing has all of a bad moment.
const ROUNDS: usize = 2;

/// Steps before the clock starts.
const WARM_UP: usize = 3;

/// Steps and time that are measured, at least.
const FEWEST: usize = 5;
const LEAST: Duration = Duration::from_millis(500);

/// What was measured, and what follows; kept, so that a comparison that goes on does so with the same steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Times {
    /// In the order of what is compared.
    pub(super) entries: Vec<EntryTime>,
}

/// Of one that is compared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct EntryTime {
    pub(super) name: String,
    /// Seconds of a step, samples left out.
    pub(super) step_seconds: f64,
    /// How many take as long as the common steps of the one of median speed.
    pub(super) steps: usize,
    /// Of its recipe with the common steps.
    recipe_sha256: String,
}

impl Times {
    /// Those of the folder, or new ones by `measure`; nothing when that was stopped.
    ///
    /// # Errors
    /// [`RunError::OtherRecipe`] when the folder's are of other entries; those of `measure`.
    pub(super) fn of(
        folder: &Folder,
        entries: &[Entry],
        recipes: &[TrainRecipe],
        measure: impl FnOnce() -> Result<Option<Vec<f64>>, TrainError>,
    ) -> Result<Option<Self>, TrainError> {
        let hashes = recipes
            .iter()
            .map(|recipe| Ok(sha256(common(recipe).to_toml()?.as_bytes())));
        let hashes: Vec<String> = hashes.collect::<Result<_, TrainError>>()?;
        if let Some(kept) = folder.read_json::<Self>(TIMES)? {
            let known = kept.entries.iter();
            let known: Vec<_> = known
                .map(|one| (&one.name, &one.recipe_sha256, one.steps > 0))
                .collect();
            let asked = entries.iter().zip(&hashes);
            let asked: Vec<_> = asked.map(|(one, hash)| (&one.name, hash, true)).collect();
            if known == asked {
                return Ok(Some(kept));
            }
            let names = |all: &[(&String, &String, bool)]| {
                let names: Vec<_> = all
                    .iter()
                    .map(|(name, hash, _)| format!("{name} ({:.8})", hash))
                    .collect();
                names.join(", ")
            };
            return Err(folder.holds_another(format!(
                "{TIMES} is of {}, asked for are {}; equal times need all at once, in the same order",
                names(&known),
                names(&asked)
            )));
        }
        let Some(seconds) = measure()? else {
            return Ok(None);
        };
        let common = recipes.first().map_or(0, |recipe| recipe.steps);
        let steps = equal_steps(&seconds, common);
        let entries = entries.iter().zip(hashes).zip(seconds.iter().zip(steps));
        let entries = entries.map(
            |((entry, recipe_sha256), (&step_seconds, steps))| EntryTime {
                name: entry.name.clone(),
                step_seconds,
                steps,
                recipe_sha256,
            },
        );
        let times = Self {
            entries: entries.collect(),
        };
        folder.write_json(TIMES, &times)?;
        Ok(Some(times))
    }
}

/// Without what changes no result.
fn common(recipe: &TrainRecipe) -> TrainRecipe {
    TrainRecipe {
        loader_threads: None,
        ..recipe.clone()
    }
}

/// Steps that take everything as long as `steps` take the one of median speed.
fn equal_steps(seconds: &[f64], steps: usize) -> Vec<usize> {
    let mut sorted = seconds.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(median) = sorted.get(sorted.len().saturating_sub(1) / 2) else {
        return Vec::new();
    };
    let time = steps as f64 * median;
    let steps = seconds.iter().map(|one| (time / one).round().max(1.0));
    steps.map(|steps| steps as usize).collect()
}

/// Seconds of a step of every recipe on the same batch; nothing when `observe` stops it.
pub(super) fn measure<T: Task>(
    recipes: &[TrainRecipe],
    maker: &mut SampleMaker<T>,
    device: &Device,
    observe: &mut Observe<'_>,
) -> Result<Option<Vec<f64>>, TrainError> {
    let batch = maker.make(0)?;
    let mut seconds = vec![f64::INFINITY; recipes.len()];
    for round in 1..=ROUNDS {
        for (index, (recipe, best)) in recipes.iter().zip(&mut seconds).enumerate() {
            let note = format!(
                "measures the time of a step: {} of {}, round {round} of {ROUNDS}",
                index + 1,
                recipes.len()
            );
            if observe(CompareEvent::Note(note)).is_break() {
                return Ok(None);
            }
            *best = best.min(median_seconds::<T>(recipe, &batch, device)?);
        }
    }
    Ok(Some(seconds))
}

fn median_seconds<T: Task>(
    recipe: &TrainRecipe,
    batch: &Batch,
    device: &Device,
) -> Result<f64, TrainError> {
    let task = T::of(&recipe.network).expect("all recipes train the network of the schedule");
    let mut learner = NetworkLearner::new(task, recipe, device.into())?;
    for step in 0..WARM_UP {
        learner.learn(batch, step)?;
    }
    let mut times = Vec::new();
    let begun = Instant::now();
    while times.len() < FEWEST || begun.elapsed() < LEAST {
        let start = Instant::now();
        learner.learn(batch, WARM_UP + times.len())?;
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(times[times.len() / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slower_steps_are_fewer() {
        // 100 steps of 2 seconds.
        assert_eq!(equal_steps(&[4.0, 1.0, 2.0], 100), [50, 200, 100]);
        // Of two the faster one is the measure.
        assert_eq!(equal_steps(&[3.0, 1.0], 10), [3, 10]);
        assert_eq!(equal_steps(&[1.0, 1.0, 1000.0], 10), [10, 10, 1]);
        assert!(equal_steps(&[], 10).is_empty());
    }

    #[test]
    fn times_are_measured_once_for_the_same_entries() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::claim(place.path(), "steps = 1\n").unwrap();
        let text = "network = \"normal\"\nsteps = 60\nsize = 16\n";
        let recipe = TrainRecipe::parse("r.toml", text).unwrap();
        let entries = ["a", "b"].map(|name| Entry {
            name: name.to_owned(),
            ..Entry::plain()
        });
        let mut recipes = [recipe.clone(), recipe];
        let times = |entries: &[Entry], recipes: &[TrainRecipe], seconds: Option<Vec<f64>>| {
            Times::of(&folder, entries, recipes, || Ok(seconds))
        };
        // Stopped: nothing is kept.
        assert!(times(&entries, &recipes, None).unwrap().is_none());
        let first = times(&entries, &recipes, Some(vec![0.5, 1.5])).unwrap();
        let steps = |times: &Option<Times>| {
            let entries = times.iter().flat_map(|times| &times.entries);
            entries.map(|one| one.steps).collect::<Vec<_>>()
        };
        assert_eq!(steps(&first), [60, 20]);
        // More threads for the samples are no other recipe.
        recipes[0].loader_threads = Some(2);
        let again = times(&entries, &recipes, Some(vec![9.0, 1.0])).unwrap();
        assert_eq!(first, again);
        let error = times(&entries[..1], &recipes[..1], Some(vec![1.0])).unwrap_err();
        assert!(
            error.to_string().contains("times.json is of a ("),
            "{error}"
        );
        recipes[1].optimiser.learning_rate = 0.5;
        assert!(times(&entries, &recipes, Some(vec![1.0, 1.0])).is_err());
    }
}
