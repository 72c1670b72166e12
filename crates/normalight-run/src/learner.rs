//! The seam between the training loop and what is trained.
use crate::Failure;
use crate::named_tensors::NamedTensors;
use std::collections::BTreeMap;

/// Errors on unseen objects.
#[derive(Debug, Clone, PartialEq)]
pub struct Validation {
    /// Mean error in degrees; it decides which weights are the best.
    pub degrees: f32,
    /// More about it, by name.
    pub figures: BTreeMap<String, f32>,
}

/// What the training loop drives. The loop brings batches, validations, checkpoints, curves and the
/// run's folder; a learner brings its networks, optimisers and losses.
pub trait Learner {
    /// What it takes in at one step.
    type Batch: Send + 'static;

    /// What can go wrong with it.
    type Error: Failure;

    /// Step `step`, from 0. Where loss or gradient is not finite, everything stays as it was.
    ///
    /// # Errors
    /// What the learner meets.
    fn learn(&mut self, batch: &Self::Batch, step: usize) -> Result<StepOutcome, Self::Error>;

    /// Errors on unseen objects after so many steps.
    ///
    /// # Errors
    /// What the learner meets.
    fn validate(&mut self, step: usize) -> Result<Validation, Self::Error>;

    /// Whether the newest result is kept instead of the best on validation.
    const KEEPS_NEWEST: bool = false;

    /// Content of the result's file; nothing for a result that no file can hold.
    ///
    /// # Errors
    /// What the learner meets.
    fn result(&self) -> Result<Option<Vec<u8>>, Self::Error>;

    /// Files that show how it stands, by name; written after every validation.
    fn drawings(&self) -> Vec<(String, Vec<u8>)> {
        Vec::new()
    }

    /// Everything that a continued run needs.
    fn state(&self) -> NamedTensors;

    /// Goes on from a state taken after `step` steps.
    ///
    /// # Errors
    /// What is missing in the state or does not fit.
    fn restore(&mut self, state: NamedTensors, step: usize) -> Result<(), String>;

    /// Learning rate of a step, for the log.
    fn rate(&self, step: usize) -> f32;

    /// What brings the batch of a step back: the number of its first scene.
    fn batch_seed(&self, step: usize) -> u64;
}

/// What a step gave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepOutcome {
    /// Loss of the batch.
    pub loss: f32,
    /// Norm of the gradient over all weights, before clipping.
    pub gradient_norm: f32,
}

impl StepOutcome {
    /// The first number that is not finite, and what it is.
    pub fn failure(&self) -> Option<(&'static str, f32)> {
        let numbers = [
            ("loss", self.loss),
            ("norm of the gradient", self.gradient_norm),
        ];
        numbers.into_iter().find(|(_, value)| !value.is_finite())
    }
}
