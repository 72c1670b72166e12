//! Successive halving: candidates trained for a short schedule, the better ones for longer ones.
use super::recipe::{Goal, IMAGES, NetworkSearchRecipe};
use super::result::{CandidateResult, NetworkSearchResult, Rung};
use super::space::Candidate;
use crate::folder::Folder;
use burn::tensor::{Device, Distribution, Tensor};
use normalight_io::write_files;
use normalight_model::{LightNetwork, NormalNetwork};
use normalight_run::{Caller, RunError, RunEvent, RunState, sha256};
use normalight_train::{NetworkRecipe, TrainError, TrainRecipe, TrainRun, train};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::Instant;

const RESULT: &str = "search.json";
const TIMES: &str = "times.json";
/// Side in pixels of the pictures that the time of a normal network is measured with.
const SIDE: usize = 128;
/// Measurements, of which the shortest counts, in turns over the candidates.
const TIMED: usize = 5;

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
type Observe<'a> = &'a mut dyn FnMut(NetworkSearchEvent) -> ControlFlow<()>;

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
/// Those of the recipe and of [`train`] but [`RunError::Diverged`], which is a result like another;
/// [`RunError::OtherRecipe`] where the folder holds another search.
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
    let recipe = &run.recipe;
    recipe.validate()?;
    let candidates = recipe.candidates()?;
    let mut free = recipe.clone();
    // It changes no result.
    free.training.loader_threads = None;
    let common = free.to_toml()?;
    let folder = Folder::claim(&run.folder, &common)?;
    let mut result = NetworkSearchResult {
        state: RunState::Running,
        network: recipe.training.network.kind(),
        goal: recipe.search.goal,
        recipe_sha256: sha256(common.as_bytes()),
        rounds: Vec::new(),
    };
    let times = match recipe.search.goal {
        Goal::Time => match times(&folder, &candidates, recipe, device, observe)? {
            Some(times) => Some(times),
            None => {
                result.state = RunState::Interrupted;
                return Ok(result);
            }
        },
        Goal::MultiplyAdds | Goal::Parameters => None,
    };
    let mut left: Vec<usize> = (1..=candidates.len()).collect();
    for round in 0..=recipe.search.keep.len() {
        result.rounds.push(Rung {
            steps: recipe.steps(round),
            candidates: Vec::new(),
            tau: None,
        });
        for &number in &left {
            let candidate = &candidates[number - 1];
            let mut training = candidate.trained_as(&recipe.training)?;
            training.steps = recipe.steps(round);
            let times = times.as_ref().and_then(|times| times.get(&number));
            let milliseconds = times.map(|&microseconds| microseconds as f64 / 1000.0);
            let candidate = CandidateResult {
                number,
                parameters: training.parameters(),
                multiply_adds: recipe.multiply_adds(&training),
                milliseconds,
                degrees: None,
                hours: None,
                on_front: false,
                candidate: candidate.clone(),
            };
            let Some(candidate) = trained(run, device, (round, candidate), training, observe)?
            else {
                result.state = RunState::Interrupted;
                return Ok(result);
            };
            if let Some(rung) = result.rounds.last_mut() {
                rung.candidates.push(candidate);
            }
            result.summarise();
            folder.write_json(RESULT, &result)?;
        }
        if let Some(&count) = recipe.search.keep.get(round) {
            left = result.kept(count);
        }
    }
    result.state = RunState::Finished;
    write_front(run, &result)?;
    folder.write_json(RESULT, &result)?;
    Ok(result)
}

/// One candidate of a round; nothing when it was stopped.
fn trained(
    run: &NetworkSearchRun,
    device: &Device,
    (round, mut candidate): (usize, CandidateResult),
    recipe: TrainRecipe,
    observe: &mut dyn FnMut(NetworkSearchEvent) -> ControlFlow<()>,
) -> Result<Option<CandidateResult>, TrainError> {
    let name = format!("round {}, network {}", round + 1, candidate.number);
    let begins = NetworkSearchEvent::Begins {
        name: name.clone(),
        recipe: &recipe,
    };
    if observe(begins).is_break() {
        return Ok(None);
    }
    let run = TrainRun {
        folder: run
            .folder
            .join(format!("round-{}/{}", round + 1, candidate.number)),
        resume: true,
        caller: run.caller.clone(),
        recipe,
    };
    let ended = train(&run, device, |event| {
        observe(NetworkSearchEvent::Training(event))
    });
    match ended {
        Ok(summary) if summary.state == RunState::Finished => {
            candidate.degrees = summary.best.as_ref().map(|best| f64::from(best.degrees));
            candidate.hours = Some(summary.hours);
        }
        Ok(_) => return Ok(None),
        Err(error @ TrainError::Run(RunError::Diverged { .. })) => {
            let _ = observe(NetworkSearchEvent::Note(format!("{name}: {error}")));
        }
        Err(error) => return Err(error),
    }
    let _ = observe(NetworkSearchEvent::Ends(&candidate));
    Ok(Some(candidate))
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

/// Microseconds of each candidate by its number: those that the folder keeps, or new ones; nothing when it was stopped.
fn times(
    folder: &Folder,
    candidates: &[Candidate],
    recipe: &NetworkSearchRecipe,
    device: &Device,
    observe: &mut dyn FnMut(NetworkSearchEvent) -> ControlFlow<()>,
) -> Result<Option<BTreeMap<usize, u64>>, TrainError> {
    if let Some(kept) = folder.read_json::<BTreeMap<usize, u64>>(TIMES)? {
        return Ok(Some(kept));
    }
    let mut shortest: BTreeMap<usize, u64> = BTreeMap::new();
    for turn in 1..=TIMED {
        let note = format!(
            "measures the time of {} networks, {turn} of {TIMED}",
            candidates.len()
        );
        if observe(NetworkSearchEvent::Note(note)).is_break() {
            return Ok(None);
        }
        for (place, candidate) in candidates.iter().enumerate() {
            let took = microseconds(&candidate.trained_as(&recipe.training)?, device)?;
            let best = shortest.entry(place + 1).or_insert(u64::MAX);
            *best = (*best).min(took);
        }
    }
    folder.write_json(TIMES, &shortest)?;
    Ok(Some(shortest))
}

/// Microseconds of a network for ten images, as it is stored: random weights take as long as any.
fn microseconds(recipe: &TrainRecipe, device: &Device) -> Result<u64, TrainError> {
    let noise = |side: usize, channels: usize| {
        Tensor::<4>::random(
            [IMAGES, side, side, channels],
            Distribution::Default,
            device,
        )
    };
    let timed = |work: &dyn Fn() -> f32| {
        // Buffers are made the first time.
        work();
        let start = Instant::now();
        let sum = work();
        // Reading a number back waits for the device.
        std::hint::black_box(sum);
        start.elapsed().as_micros() as u64
    };
    Ok(match &recipe.network {
        NetworkRecipe::Normal(settings) => {
            let network = NormalNetwork::new(&settings.architecture, true, device)?;
            let input = noise(SIDE, settings.architecture.input_channels());
            timed(&|| {
                network
                    .regress(network.fuse(input.clone(), 1))
                    .sum()
                    .into_scalar()
            })
        }
        NetworkRecipe::Light(settings) => {
            let network = LightNetwork::new(&settings.architecture, true, device)?;
            let input = noise(settings.architecture.input_size, 4);
            timed(&|| {
                let own = network.features(input.clone());
                let fused = own.clone().max_dim(0).expand(own.dims());
                network.classify(own, fused).sum().into_scalar()
            })
        }
    })
}
