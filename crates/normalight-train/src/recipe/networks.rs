use crate::TrainError;
use normalight_model::{LightArchitecture, NormalArchitecture};
use normalight_run::check;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Settings of the light network and its loss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightSettings {
    /// The network.
    pub architecture: LightArchitecture,
    /// Deviation of the Gaussian labels, in classes; at 0.1 nearly all weight is on one class, as in
    /// the paper.
    pub label_deviation: f32,
    /// Weight of 1 - cos of the expected direction.
    pub direction_weight: f32,
    /// Weight of the squared error of the logarithm of the expected intensity.
    pub intensity_weight: f32,
}

impl Default for LightSettings {
    fn default() -> Self {
        Self {
            architecture: LightArchitecture::plain(),
            label_deviation: 1.0,
            direction_weight: 5.0,
            intensity_weight: 0.5,
        }
    }
}

impl LightSettings {
    pub(super) fn validate(&self) -> Result<(), TrainError> {
        let field = "light.label_deviation";
        check(field, self.label_deviation, 0.1..=10.0, "0.1 to 10")?;
        let field = "light.direction_weight";
        check(field, self.direction_weight, 0.0..=1e3, "0 to 1000")?;
        let field = "light.intensity_weight";
        check(field, self.intensity_weight, 0.0..=1e3, "0 to 1000")?;
        Ok(self.architecture.validate()?)
    }
}

/// Settings of the normal network and of the lights it is trained with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NormalSettings {
    /// The network.
    pub architecture: NormalArchitecture,
    /// Weight of the auxiliary tower's loss; 0 builds no tower.
    pub auxiliary_weight: f32,
    /// How much more bent surface counts in the loss: a pixel weighs 1 + this times the mean distance (chord) of its
    /// normal from those of its neighbours; 0 weighs all alike.
    pub curvature_weight: f32,
    /// Deviation of each light by itself, in degrees, where lights are perturbed.
    pub light_noise_degrees: f32,
    /// Deviation of a drift common to all lights of a sample, in degrees.
    pub light_drift_degrees: f32,
    /// Relative deviation of intensities.
    pub intensity_noise: f32,
    /// Which lights the samples come with.
    pub lights: LightMix,
}

impl Default for NormalSettings {
    fn default() -> Self {
        Self {
            architecture: NormalArchitecture::plain(),
            auxiliary_weight: 0.4,
            curvature_weight: 0.0,
            light_noise_degrees: 3.0,
            light_drift_degrees: 3.0,
            intensity_noise: 0.05,
            lights: LightMix::default(),
        }
    }
}

/// Shares of training samples by their lights; the three sum to 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightMix {
    /// The true lights.
    #[serde(rename = "true")]
    pub truth: f32,
    /// True lights with random errors, see [`NormalSettings`].
    pub perturbed: f32,
    /// Lights with the errors that a light network makes on the sample's scene.
    pub predicted: f32,
    /// The light network that predicts; the shipped one when missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub light_weights: Option<PathBuf>,
}

impl Default for LightMix {
    fn default() -> Self {
        Self {
            truth: 0.1,
            perturbed: 0.9,
            predicted: 0.0,
            light_weights: None,
        }
    }
}

impl NormalSettings {
    pub(super) fn validate(&self) -> Result<(), TrainError> {
        let field = "normal.auxiliary_weight";
        check(field, self.auxiliary_weight, 0.0..=10.0, "0 to 10")?;
        let field = "normal.curvature_weight";
        check(field, self.curvature_weight, 0.0..=100.0, "0 to 100")?;
        let field = "normal.light_noise_degrees";
        check(field, self.light_noise_degrees, 0.0..=45.0, "0 to 45")?;
        let field = "normal.light_drift_degrees";
        check(field, self.light_drift_degrees, 0.0..=45.0, "0 to 45")?;
        let field = "normal.intensity_noise";
        check(field, self.intensity_noise, 0.0..=0.5, "0 to 0.5")?;
        let mix = &self.lights;
        check("normal.lights.true", mix.truth, 0.0..=1.0, "0 to 1")?;
        check(
            "normal.lights.perturbed",
            mix.perturbed,
            0.0..=1.0,
            "0 to 1",
        )?;
        check(
            "normal.lights.predicted",
            mix.predicted,
            0.0..=1.0,
            "0 to 1",
        )?;
        let sum = mix.truth + mix.perturbed + mix.predicted;
        let field = "sum of the shares of normal.lights";
        check(field, sum, 0.999..=1.001, "1")?;
        Ok(self.architecture.validate()?)
    }
}
