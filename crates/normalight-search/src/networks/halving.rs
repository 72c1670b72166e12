//! Successive halving: candidates trained for a short schedule, the better ones for longer ones.
use super::candidates::Search;
use super::recipe::NetworkSearchRecipe;
use super::result::{CandidateResult, NetworkSearchResult};
use burn::tensor::Device;
use normalight_io::write_files;
use normalight_run::{Caller, RunEvent, RunState};
use normalight_train::{TrainError, TrainRecipe};
use std::ops::ControlFlow;
use std::path::PathBuf;

const RESULT: &str = "search.json";
/// A search of whole networks: one folder.
#[derive(Debug, Clone)]
pub struct NetworkSearchRun {
    /// What to search.
    pub recipe: NetworkSearchRecipe,
    /// Folder of the trainings and of `search.json`; created when missing. What is finished in it is kept.
    pub folder: PathBuf,
    /// The program that asks for it.
    pub caller: Caller,
}

/// What happens during a search.
#[derive(Debug, Clone)]
pub enum NetworkSearchEvent<'a> {
    /// Something a person should know.
    Note(String),
    /// The training of a candidate begins, or goes on.
    Begins {
        /// Its round and number, from 1.
        name: String,
        /// What is trained.
        recipe: &'a TrainRecipe,
    },
    /// Something happens during the training.
    Training(RunEvent),
    /// The training came to its end.
    Ends(&'a CandidateResult),
}

/// What is told, and whether it goes on; not generic: else every program that searches would compile all of it again.
pub(super) type Observe<'a> = &'a mut dyn FnMut(NetworkSearchEvent) -> ControlFlow<()>;

/// Trains random networks of the recipe's space for its steps, keeps those that are best by error and cost, trains them
/// from the start for more, and so on; `observe` may stop it at any event. Asked for again, it goes on where it was.
///
/// The folder then holds a training run for every candidate of every round (`round-1/7`), `search.json`, `recipe.toml`, and
/// `front-7.toml`, a recipe for `normalight train`, for each candidate on the last round's front; where time is the goal
/// `times.json`, measured before anything is trained, while nothing else should run.
///
/// `device` must be a plain one; gradients are switched on inside.
///
/// # Errors
/// Those of the recipe and of [`train`](normalight_train::train) but
/// [`RunError::Diverged`](normalight_run::RunError::Diverged), which is a result like another;
/// [`RunError::OtherRecipe`](normalight_run::RunError::OtherRecipe) where the folder holds another search.
pub fn search_networks(
    run: &NetworkSearchRun,
    device: &Device,
    mut observe: impl FnMut(NetworkSearchEvent) -> ControlFlow<()>,
) -> Result<NetworkSearchResult, TrainError> {
    halve(run, device, &mut observe)
}

fn halve(
    run: &NetworkSearchRun,
    device: &Device,
    observe: Observe<'_>,
) -> Result<NetworkSearchResult, TrainError> {
    let mut search = Search::open(run)?;
    let mut result = search.begun();
    if search.measure(device, observe)?.is_break() {
        result.state = RunState::Interrupted;
        return Ok(result);
    }
    let mut left = search.all();
    for round in 0..=run.recipe.search.keep.len() {
        result.rounds.push(search.rung(round));
        for &number in &left {
            let Some(candidate) = search.trained(round, number, device, observe)? else {
                result.state = RunState::Interrupted;
                return Ok(result);
            };
            if let Some(rung) = result.rounds.last_mut() {
                rung.candidates.push(candidate);
            }
            result.summarise();
            search.folder.write_json(RESULT, &result)?;
        }
        if let Some(&count) = run.recipe.search.keep.get(round) {
            left = result.kept(count);
        }
    }
    result.state = RunState::Finished;
    write_front(run, &result)?;
    search.folder.write_json(RESULT, &result)?;
    Ok(result)
}

/// Recipes that train what the last round's front found.
fn write_front(run: &NetworkSearchRun, result: &NetworkSearchResult) -> Result<(), TrainError> {
    let last = result
        .rounds
        .last()
        .map_or(&[][..], |rung| &rung.candidates);
    let mut files = Vec::new();
    for candidate in last.iter().filter(|one| one.on_front) {
        let recipe = candidate.candidate.trained_as(&run.recipe.training)?;
        files.push((
            format!("front-{}.toml", candidate.number),
            recipe.to_toml()?,
        ));
    }
    Ok(write_files(&run.folder, &files)?)
}
