//! Where a run stands.
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The best validation of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Best {
    /// Step after which it was.
    pub step: usize,
    /// Mean error on unseen objects in degrees.
    pub degrees: f32,
    /// More about it, by name: what the learner measures.
    pub figures: BTreeMap<String, f32>,
}

/// Where a run stands, beside its tensors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// Steps taken.
    pub step: usize,
    /// Best validation so far.
    pub best: Option<Best>,
    /// Loss of the last step.
    pub loss: Option<f32>,
    /// Sum of the losses since the last validation, and their number. In f32, which comes back from
    /// JSON exactly.
    pub recent: (f32, usize),
    /// Seconds of training in all.
    pub seconds: f64,
    /// How many of them were spent waiting for samples.
    pub waited: f64,
}

impl TrainingState {
    pub(crate) fn start() -> Self {
        Self {
            step: 0,
            best: None,
            loss: None,
            recent: (0.0, 0),
            seconds: 0.0,
            waited: 0.0,
        }
    }
}
