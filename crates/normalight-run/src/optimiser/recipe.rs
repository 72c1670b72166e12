use crate::{RunError, check};
use serde::{Deserialize, Serialize};

/// How weights follow gradients.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OptimiserRecipe {
    /// Which weights follow which rule.
    pub kind: OptimiserKind,
    /// Settings of Muon.
    pub muon: MuonRecipe,
    /// Highest learning rate of Adam.
    pub learning_rate: f32,
    /// Adam's averaging of gradients and of their squares.
    pub betas: [f32; 2],
    /// Keeps Adam's division finite.
    pub epsilon: f32,
    /// Strength of the pull of weights towards zero; 0 is none.
    pub weight_decay: f32,
    /// How the pull is applied.
    pub decay: Decay,
    /// Steps over which the rate rises from zero.
    pub warm_up: usize,
    /// What the rate does after that.
    pub schedule: Schedule,
    /// Largest norm of the gradient over all weights.
    pub clip: f32,
    /// Decay of the exponential moving average of the weights, which then is what is validated and
    /// kept; 0 is no average.
    pub average: f32,
}

/// Rules for weights to follow gradients.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OptimiserKind {
    /// Adam (Kingma & Ba 2015) for all weights.
    Adam,
    /// Muon (Jordan et al. 2024) for convolutions and matrices but those of output layers, Adam for the rest.
    Muon,
}

/// Muon's settings; its five Newton-Schulz steps and their coefficients are as published.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MuonRecipe {
    /// Its learning rate over Adam's; one of 1 moves every weight of a square layer by about a learning rate over the
    /// root of its width.
    pub rate_factor: f32,
    /// Decay of the sum of gradients.
    pub momentum: f32,
    /// Who moves depthwise convolutions.
    pub depthwise: DepthwiseRule,
}

/// Rules for depthwise convolutions, whose channels are no matrix together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthwiseRule {
    /// Adam.
    Adam,
    /// Muon on every channel's filter by itself: steps of the same length for each.
    Filters,
}

impl Default for MuonRecipe {
    fn default() -> Self {
        Self {
            rate_factor: 10.0,
            momentum: 0.95,
            depthwise: DepthwiseRule::Adam,
        }
    }
}

/// How weights are pulled towards zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Decay {
    /// Apart from the gradient, on kernels and matrices only (Loshchilov & Hutter 2019).
    Decoupled,
    /// As a part of every weight's gradient, as in the paper.
    Coupled,
}

/// The learning rate over the steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Schedule {
    /// Half a cosine from the highest rate to a share of it at the last step.
    Cosine {
        /// That share.
        #[serde(default = "final_rate")]
        final_rate: f32,
    },
    /// Multiplied by a factor every so many steps.
    Step {
        /// Steps from one change to the next.
        every: usize,
        /// The factor.
        factor: f32,
    },
    /// Always the highest rate.
    Constant,
}

fn final_rate() -> f32 {
    0.03
}

impl Default for OptimiserRecipe {
    fn default() -> Self {
        Self {
            kind: OptimiserKind::Adam,
            muon: MuonRecipe::default(),
            learning_rate: 1e-3,
            betas: [0.9, 0.999],
            epsilon: 1e-8,
            weight_decay: 0.0,
            decay: Decay::Decoupled,
            warm_up: 50,
            schedule: Schedule::Cosine {
                final_rate: final_rate(),
            },
            clip: 5.0,
            average: 0.0,
        }
    }
}

impl OptimiserRecipe {
    /// Checks every number.
    ///
    /// # Errors
    /// [`RunError::Value`].
    pub fn validate(&self) -> Result<(), RunError> {
        let field = "optimiser.learning_rate";
        check(field, self.learning_rate, 1e-9..=1.0, "above 0, at most 1")?;
        let below_one = 1.0 - f32::EPSILON;
        for beta in self.betas {
            check("optimiser.betas", beta, 0.0..=below_one, "0 to below 1")?;
        }
        let field = "optimiser.muon.momentum";
        check(field, self.muon.momentum, 0.0..=below_one, "0 to below 1")?;
        let field = "optimiser.muon.rate_factor";
        check(field, self.muon.rate_factor, 1e-3..=1e3, "0.001 to 1000")?;
        let field = "optimiser.epsilon";
        check(field, self.epsilon, 1e-16..=1.0, "above 0, at most 1")?;
        let field = "optimiser.weight_decay";
        check(field, self.weight_decay, 0.0..=1.0, "0 to 1")?;
        check("optimiser.clip", self.clip, 1e-6..=1e6, "above 0")?;
        let field = "optimiser.average";
        check(field, self.average, 0.0..=below_one, "0 to below 1")?;
        let field = "optimiser.schedule";
        match self.schedule {
            Schedule::Cosine { final_rate } => check(field, final_rate, 0.0..=1.0, "0 to 1"),
            Schedule::Step { every, factor } => {
                check(field, every, 1..=usize::MAX, "a change every 1 or more")?;
                check(field, factor, 1e-6..=1.0, "a factor above 0, at most 1")
            }
            Schedule::Constant => Ok(()),
        }
    }

    /// Learning rate of step `step` (from 0) of `steps`: linear warm-up times the schedule.
    pub fn rate(&self, step: usize, steps: usize) -> f32 {
        let rise = ((step + 1) as f32 / self.warm_up.max(1) as f32).min(1.0);
        let share = match self.schedule {
            Schedule::Cosine { final_rate } => {
                let done = (step as f32 / steps.max(1) as f32).min(1.0);
                let cosine = 0.5 + 0.5 * (std::f32::consts::PI * done).cos();
                final_rate + (1.0 - final_rate) * cosine
            }
            Schedule::Step { every, factor } => factor.powf((step / every) as f32),
            Schedule::Constant => 1.0,
        };
        self.learning_rate * rise * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn optimiser(text: &str) -> OptimiserRecipe {
        let optimiser: OptimiserRecipe = toml::from_str(text).unwrap();
        optimiser.validate().unwrap();
        optimiser
    }

    #[test]
    fn the_rate_rises_and_falls() {
        let cosine = optimiser("");
        assert!(cosine.rate(0, 1000) < 3e-5);
        assert!((cosine.rate(50, 1000) - 1e-3).abs() < 1e-5);
        assert!((cosine.rate(1000, 1000) - 3e-5).abs() < 1e-7);
        let step = optimiser(
            "warm_up = 0\nlearning_rate = 0.5\nschedule = { kind = \"step\", every = 10, factor = 0.5 }",
        );
        assert_eq!([9, 10, 29].map(|at| step.rate(at, 100)), [0.5, 0.25, 0.125]);
        let constant = optimiser("warm_up = 0\nschedule = { kind = \"constant\" }");
        assert_eq!(constant.rate(99, 100), constant.rate(0, 100));
    }

    #[test]
    fn impossible_settings_are_refused() {
        for (text, part) in [
            ("betas = [0.9, 1.0]", "betas is 1"),
            ("muon = { momentum = 1.0 }", "momentum is 1"),
            ("muon = { rate_factor = 0.0 }", "rate_factor is 0"),
            ("average = 1.5", "average is 1.5"),
            (
                "schedule = { kind = \"step\", every = 0, factor = 0.5 }",
                "schedule is 0",
            ),
            ("weight_decay = -1.0", "weight_decay is -1"),
        ] {
            let optimiser: OptimiserRecipe = toml::from_str(text).unwrap();
            let error = optimiser.validate().unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
        for text in [
            "rate = 1",
            "schedule = { kind = \"cosine\", every = 3 }",
            "decay = \"l1\"",
            "kind = \"lion\"",
            "muon = { steps = 3 }",
        ] {
            assert!(toml::from_str::<OptimiserRecipe>(text).is_err(), "{text}");
        }
    }
}
