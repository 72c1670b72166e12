//! The program that asks for a run, as far as the run's files tell of it.
use crate::{Failure, RunError, RunState};

/// The program that asks for a run.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Caller {
    /// Its command line, for the card.
    pub command: String,
    /// What its process ends with, for `summary.json`; nothing for a program that carries out a run among other things.
    pub exit_codes: Option<ExitCodes>,
}

/// What a process ends with that carries out a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExitCodes {
    /// All steps are taken.
    pub finished: u8,
    /// An error ended it.
    pub failed: u8,
    /// It diverged: loss or gradient were no number any more.
    pub diverged: u8,
    /// It was asked to stop.
    pub interrupted: u8,
}

impl ExitCodes {
    /// That of a run in this state; none while it runs.
    pub fn of_state(&self, state: RunState) -> Option<u8> {
        match state {
            RunState::Running => None,
            RunState::Finished => Some(self.finished),
            RunState::Interrupted => Some(self.interrupted),
            RunState::Failed => Some(self.failed),
        }
    }

    /// That of a run which an error ended.
    pub fn of_error(&self, error: &impl Failure) -> u8 {
        match error.run_error() {
            Some(RunError::Diverged { .. }) => self.diverged,
            _ => self.failed,
        }
    }
}
