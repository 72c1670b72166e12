//! `summary.json`: how a run stands, for job schedulers and workflow engines.
use crate::{Best, Failure, RunSpec, TrainingState, sha256};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The file in a run's folder.
pub(crate) const SUMMARY: &str = "summary.json";

/// How a run stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RunState {
    /// It trains; or it was killed, when no process does.
    Running,
    /// All steps are taken.
    Finished,
    /// It was asked to stop, and can be continued.
    Interrupted,
    /// An error ended it.
    Failed,
}

/// Everything that a script wants to know of a run; the content of `summary.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// How it stands.
    pub state: RunState,
    /// What went wrong.
    pub reason: Option<String>,
    /// What the process ends with, as its program says; nothing while it runs.
    pub exit_code: Option<u8>,
    /// Which network.
    pub network: String,
    /// Its number of weights.
    pub parameters: usize,
    /// Seed of weights and samples.
    pub seed: u64,
    /// Steps taken.
    pub steps: usize,
    /// Steps to take.
    pub steps_planned: usize,
    /// The best validation.
    pub best: Option<Best>,
    /// Loss of the last step.
    pub loss: Option<f32>,
    /// Hours of training.
    pub hours: f64,
    /// How many of them were spent waiting for samples.
    pub hours_waited: f64,
    /// SHA-256 of `weights.safetensors`.
    pub weights_sha256: Option<String>,
    /// SHA-256 of `recipe.toml`.
    pub recipe_sha256: String,
    /// Version of Normalight.
    pub version: String,
}

impl Summary {
    /// `weights`: content of the weights file, where there is one.
    pub(crate) fn new(
        spec: &RunSpec,
        training_state: &TrainingState,
        state: RunState,
        weights: Option<&[u8]>,
    ) -> Self {
        let exit_code = spec.exit_codes.and_then(|codes| codes.of_state(state));
        Self {
            state,
            reason: None,
            exit_code,
            network: spec.network.clone(),
            parameters: spec.parameters,
            seed: spec.seed,
            steps: training_state.step,
            steps_planned: spec.schedule.steps,
            best: training_state.best.clone(),
            loss: training_state.loss,
            hours: hours(training_state.seconds),
            hours_waited: hours(training_state.waited),
            weights_sha256: weights.map(sha256),
            recipe_sha256: sha256(spec.recipe.as_bytes()),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// That of the run in a folder; nothing where there is none that can be read.
    pub fn read(folder: &Path) -> Option<Self> {
        let bytes = std::fs::read(folder.join(SUMMARY)).ok()?;
        serde_json::from_slice(&bytes).ok()
    }

    /// The same run ended by an error.
    pub(crate) fn failed(mut self, spec: &RunSpec, error: &impl Failure) -> Self {
        self.state = RunState::Failed;
        self.reason = Some(error.to_string());
        self.exit_code = spec.exit_codes.map(|codes| codes.of_error(error));
        self
    }

    /// Whether nothing is left to do of so many steps.
    pub fn is_end_of(&self, steps: usize) -> bool {
        self.state == RunState::Finished && self.steps >= steps
    }

    pub(crate) fn to_json(&self) -> String {
        let json = serde_json::to_string_pretty(self);
        // Numbers and text always become JSON.
        json.unwrap_or_default() + "\n"
    }
}

/// Seconds as hours; more digits than these would only be noise.
fn hours(seconds: f64) -> f64 {
    (seconds / 3600.0 * 1e6).round() / 1e6
}
