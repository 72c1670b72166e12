//! The candidates of a search in its folder: what each costs, its training, and how that ended.
use super::halving::{NetworkSearchEvent, NetworkSearchRun, Observe};
use super::recipe::{Goal, NetworkSearchRecipe};
use super::result::{CandidateResult, NetworkSearchResult, Rung};
use super::space::Candidate;
use super::times::{self, Times};
use crate::folder::Folder;
use burn::tensor::Device;
use normalight_run::{RunError, RunState, Summary, sha256};
use normalight_train::{TrainError, TrainRecipe, TrainRun, train};
use std::ops::ControlFlow;
use std::path::PathBuf;

/// A search and its folder.
pub(super) struct Search<'a> {
    run: &'a NetworkSearchRun,
    pub(super) folder: Folder,
    candidates: Vec<Candidate>,
    /// Of its recipe.
    sha256: String,
    /// Where time is the goal.
    times: Option<Times>,
}

impl<'a> Search<'a> {
    /// Makes the folder when it is missing.
    ///
    /// # Errors
    /// Those of the recipe; [`RunError::OtherRecipe`] where the folder holds another search.
    pub(super) fn open(run: &'a NetworkSearchRun) -> Result<Self, TrainError> {
        let recipe = &run.recipe;
        recipe.validate()?;
        let candidates = recipe.candidates()?;
        let mut free = recipe.clone();
        // It changes no result.
        free.training.loader_threads = None;
        let common = free.to_toml()?;
        let folder = Folder::claim(&run.folder, &common)?;
        let times = match recipe.search.goal {
            Goal::Time => times::kept(&folder)?,
            Goal::MultiplyAdds | Goal::Parameters => None,
        };
        Ok(Self {
            run,
            folder,
            candidates,
            sha256: sha256(common.as_bytes()),
            times,
        })
    }

    /// Numbers of all candidates.
    pub(super) fn all(&self) -> Vec<usize> {
        (1..=self.candidates.len()).collect()
    }

    /// A result without rounds.
    pub(super) fn begun(&self) -> NetworkSearchResult {
        let recipe = &self.run.recipe;
        NetworkSearchResult {
            state: RunState::Running,
            network: recipe.training.network.kind(),
            goal: recipe.search.goal,
            recipe_sha256: self.sha256.clone(),
            rounds: Vec::new(),
        }
    }

    /// A round without candidates.
    pub(super) fn rung(&self, round: usize) -> Rung {
        Rung {
            round: round + 1,
            steps: self.run.recipe.steps(round),
            candidates: Vec::new(),
            tau: None,
        }
    }

    /// Whether times are wanted that nobody has measured yet.
    pub(super) fn lacks_times(&self) -> bool {
        self.run.recipe.search.goal == Goal::Time && self.times.is_none()
    }

    /// Measures the times that are lacking; `Break` when it was stopped.
    pub(super) fn measure(
        &mut self,
        device: &Device,
        observe: Observe<'_>,
    ) -> Result<ControlFlow<()>, TrainError> {
        if !self.lacks_times() {
            return Ok(ControlFlow::Continue(()));
        }
        let recipe: &NetworkSearchRecipe = &self.run.recipe;
        match times::measured(&self.folder, &self.candidates, recipe, device, observe)? {
            ControlFlow::Continue(times) => self.times = Some(times),
            ControlFlow::Break(()) => return Ok(ControlFlow::Break(())),
        }
        Ok(ControlFlow::Continue(()))
    }

    /// A candidate of a round before its training, and the training.
    fn untrained(
        &self,
        round: usize,
        number: usize,
    ) -> Result<(CandidateResult, TrainRecipe), TrainError> {
        let recipe = &self.run.recipe;
        let candidate = &self.candidates[number - 1];
        let mut training = candidate.trained_as(&recipe.training)?;
        training.steps = recipe.steps(round);
        let times = self.times.as_ref().and_then(|times| times.get(&number));
        let candidate = CandidateResult {
            number,
            parameters: training.parameters(),
            multiply_adds: recipe.multiply_adds(&training),
            milliseconds: times.map(|&microseconds| microseconds as f64 / 1000.0),
            degrees: None,
            hours: None,
            on_front: false,
            candidate: candidate.clone(),
        };
        Ok((candidate, training))
    }

    fn folder_of(&self, round: usize, number: usize) -> PathBuf {
        let name = format!("round-{}/{number}", round + 1);
        self.folder.path().join(name)
    }

    /// Trains a candidate of a round (from 0), or goes on with it; nothing when it was stopped.
    pub(super) fn trained(
        &self,
        round: usize,
        number: usize,
        device: &Device,
        observe: Observe<'_>,
    ) -> Result<Option<CandidateResult>, TrainError> {
        let (mut candidate, recipe) = self.untrained(round, number)?;
        let name = format!("round {}, network {number}", round + 1);
        let begins = NetworkSearchEvent::Begins {
            name: name.clone(),
            recipe: &recipe,
        };
        if observe(begins).is_break() {
            return Ok(None);
        }
        let run = TrainRun {
            folder: self.folder_of(round, number),
            resume: true,
            caller: self.run.caller.clone(),
            recipe,
        };
        let ended = train(&run, device, |event| {
            observe(NetworkSearchEvent::Training(event))
        });
        match ended {
            Ok(summary) if summary.state == RunState::Finished => candidate.take(&summary),
            Ok(_) => return Ok(None),
            Err(error @ TrainError::Run(RunError::Diverged { .. })) => {
                let _ = observe(NetworkSearchEvent::Note(format!("{name}: {error}")));
            }
            Err(error) => return Err(error),
        }
        let _ = observe(NetworkSearchEvent::Ends(&candidate));
        Ok(Some(candidate))
    }

    /// A candidate whose training in a round (from 0) has come to its end, diverged or not; nothing before.
    pub(super) fn ended(
        &self,
        round: usize,
        number: usize,
    ) -> Result<Option<CandidateResult>, TrainError> {
        let (mut candidate, recipe) = self.untrained(round, number)?;
        let Some(summary) = Summary::read(&self.folder_of(round, number)) else {
            return Ok(None);
        };
        let codes = self.run.caller.exit_codes;
        let diverged = summary.state == RunState::Failed
            && codes.is_some_and(|codes| summary.exit_code == Some(codes.diverged));
        if summary.is_end_of(recipe.steps) {
            candidate.take(&summary);
        } else if !diverged {
            return Ok(None);
        }
        Ok(Some(candidate))
    }
}
