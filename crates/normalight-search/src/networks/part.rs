//! A round of a search in parts, for several machines.
use super::candidates::Search;
use super::halving::{NetworkSearchEvent, NetworkSearchRun, Observe};
use super::result::NetworkSearchResult;
use burn::tensor::Device;
use normalight_run::{RunError, RunState};
use normalight_train::TrainError;
use std::ops::ControlFlow;

/// A part of a round: every so-manieth of the candidates that are in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RoundPart {
    /// The round, from 1.
    pub round: usize,
    /// Which part, from 1.
    pub index: usize,
    /// Number of parts.
    pub of: usize,
}

/// Trains a part of a round in the folder of the whole search, which other processes may share: after all parts of all rounds
/// [`search_networks`](super::search_networks) has nothing left to train and writes what it would have without them. Where
/// time is the goal, the first part of the first round measures it first.
///
/// The result has one round, with the part's candidates.
///
/// # Errors
/// Those of [`search_networks`](super::search_networks); [`RunError::Value`] for a round or part that there is not;
/// [`RunError::Waits`] before the rounds before have come to their end.
pub fn search_part(
    run: &NetworkSearchRun,
    part: RoundPart,
    device: &Device,
    mut observe: impl FnMut(NetworkSearchEvent) -> ControlFlow<()>,
) -> Result<NetworkSearchResult, TrainError> {
    train_part(run, part, device, &mut observe)
}

fn train_part(
    run: &NetworkSearchRun,
    part: RoundPart,
    device: &Device,
    observe: Observe<'_>,
) -> Result<NetworkSearchResult, TrainError> {
    part.check(run.recipe.search.keep.len() + 1)?;
    let mut search = Search::open(run)?;
    let mut result = search.begun();
    let first = part.round == 1 && part.index == 1;
    if first && search.measure(device, observe)?.is_break() {
        result.state = RunState::Interrupted;
        return Ok(result);
    }
    let round = part.round - 1;
    let left = left_for(run, &search, round)?;
    result.rounds.push(search.rung(round));
    for &number in left.iter().skip(part.index - 1).step_by(part.of) {
        let Some(candidate) = search.trained(round, number, device, observe)? else {
            result.state = RunState::Interrupted;
            return Ok(result);
        };
        if let Some(rung) = result.rounds.last_mut() {
            rung.candidates.push(candidate);
        }
    }
    result.state = RunState::Finished;
    Ok(result)
}

/// Numbers of the candidates that the rounds before leave for a round (from 0).
fn left_for(
    run: &NetworkSearchRun,
    search: &Search<'_>,
    round: usize,
) -> Result<Vec<usize>, TrainError> {
    let waits = |what: String| {
        TrainError::Run(RunError::Waits {
            path: run.folder.clone(),
            what,
        })
    };
    let mut left = search.all();
    if round > 0 && search.lacks_times() {
        return Err(waits("part 1 of round 1, which measures times".to_owned()));
    }
    let mut result = search.begun();
    for (before, &count) in run.recipe.search.keep[..round].iter().enumerate() {
        let mut rung = search.rung(before);
        let mut missing = Vec::new();
        for &number in &left {
            match search.ended(before, number)? {
                Some(candidate) => rung.candidates.push(candidate),
                None => missing.push(number.to_string()),
            }
        }
        if !missing.is_empty() {
            let round = before + 1;
            return Err(waits(format!(
                "round {round}, network {}",
                missing.join(", ")
            )));
        }
        result.rounds.push(rung);
        left = result.kept(count);
    }
    Ok(left)
}

impl RoundPart {
    fn check(self, rounds: usize) -> Result<(), TrainError> {
        let value = |field, found: usize, expected| {
            Err(TrainError::Run(RunError::Value {
                field,
                found: found.to_string(),
                expected,
            }))
        };
        if self.round == 0 || self.round > rounds {
            return value(
                "round",
                self.round,
                "one of the search: search.keep has one fewer",
            );
        }
        if self.index == 0 || self.index > self.of {
            return value("part", self.index, "1 to the number of parts");
        }
        Ok(())
    }
}
