use crate::TrainError;
use normalight_model::{LightArchitecture, NormalArchitecture, light_cost, normal_cost};
use normalight_synth::SceneRecipe;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Which network a recipe trains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Network {
    /// The light calibration network.
    Light,
    /// The normal estimation network.
    Normal,
}

/// Everything that decides a training run; one TOML file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainRecipe {
    /// Which network.
    pub network: Network,
    /// Number of optimiser steps.
    pub steps: usize,
    /// Samples per step.
    #[serde(default = "defaults::batch")]
    pub batch: usize,
    /// Fewest and most images of a sample; all samples of a step have the same number.
    #[serde(default = "defaults::images")]
    pub images: [usize; 2],
    /// Side of the training pictures in pixels: crops for normals, whole objects for lights.
    pub size: usize,
    /// Highest learning rate of Adam.
    #[serde(default = "defaults::learning_rate")]
    pub learning_rate: f32,
    /// Steps over which the rate rises from zero.
    #[serde(default = "defaults::warm_up")]
    pub warm_up: usize,
    /// The rate falls along a cosine to this share of the highest.
    #[serde(default = "defaults::final_rate")]
    pub final_rate: f32,
    /// Largest norm of the gradient over all weights.
    #[serde(default = "defaults::clip")]
    pub clip: f32,
    /// Seed of weights and samples.
    #[serde(default)]
    pub seed: u64,
    /// Steps between validations on unseen objects.
    #[serde(default = "defaults::validate_every")]
    pub validate_every: usize,
    /// Number of unseen objects.
    #[serde(default = "defaults::validation_objects")]
    pub validation_objects: usize,
    /// Steps between checkpoints.
    #[serde(default = "defaults::checkpoint_every")]
    pub checkpoint_every: usize,
    /// What the samples show.
    #[serde(default)]
    pub scene: SceneRecipe,
    /// Train on a published set instead of rendered scenes; brightness and camera still come from `scene`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub published: Option<PublishedRecipe>,
    /// Settings of the light network; needed when `network` is `light`.
    #[serde(default)]
    pub light: LightSettings,
    /// Settings of the normal network; needed when `network` is `normal`.
    #[serde(default)]
    pub normal: NormalSettings,
}

/// A set in the layout of Blobby and Sculpture.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedRecipe {
    /// Its folder, where `train_mtrl.txt` lies.
    pub folder: PathBuf,
    /// Which part of it.
    #[serde(default)]
    pub part: PublishedChoice,
}

/// Which part of a published set to train on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PublishedChoice {
    /// All of it: the set's own split, or 99 % and 1 %.
    #[default]
    Train,
    /// As in the paper's search: a tenth of it at 64x64, split by shape.
    Search,
}

/// Settings of the light network and its loss.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightSettings {
    /// The network.
    pub architecture: LightArchitecture,
    /// Deviation of the Gaussian labels, in classes.
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

/// Settings of the normal network and of the errors in the lights it is trained with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NormalSettings {
    /// The network.
    pub architecture: NormalArchitecture,
    /// Deviation of each light by itself, in degrees.
    pub light_noise_degrees: f32,
    /// Deviation of a drift common to all lights of a sample, in degrees.
    pub light_drift_degrees: f32,
    /// Relative deviation of intensities.
    pub intensity_noise: f32,
}

impl Default for NormalSettings {
    fn default() -> Self {
        Self {
            architecture: NormalArchitecture::plain(),
            light_noise_degrees: 3.0,
            light_drift_degrees: 3.0,
            intensity_noise: 0.05,
        }
    }
}

mod defaults {
    pub(super) fn batch() -> usize {
        16
    }
    pub(super) fn images() -> [usize; 2] {
        [6, 16]
    }
    pub(super) fn learning_rate() -> f32 {
        1e-3
    }
    pub(super) fn warm_up() -> usize {
        50
    }
    pub(super) fn final_rate() -> f32 {
        0.03
    }
    pub(super) fn clip() -> f32 {
        5.0
    }
    pub(super) fn validate_every() -> usize {
        250
    }
    pub(super) fn validation_objects() -> usize {
        24
    }
    pub(super) fn checkpoint_every() -> usize {
        100
    }
}

impl TrainRecipe {
    /// Reads and checks a recipe file; paths in it start at its folder.
    ///
    /// # Errors
    /// [`TrainError::File`], [`TrainError::Recipe`] or [`TrainError::Value`].
    pub fn read(path: &Path) -> Result<Self, TrainError> {
        let text = std::fs::read_to_string(path).map_err(|source| TrainError::File {
            path: path.to_owned(),
            source,
        })?;
        let mut recipe = Self::parse(&path.display().to_string(), &text)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        recipe.scene.resolve_paths(folder);
        if let Some(published) = &mut recipe.published {
            published.folder = folder.join(&published.folder);
        }
        Ok(recipe)
    }

    /// Parses and checks a recipe.
    ///
    /// # Errors
    /// [`TrainError::Recipe`] or [`TrainError::Value`].
    pub fn parse(file: &str, text: &str) -> Result<Self, TrainError> {
        let recipe: Self = toml::from_str(text).map_err(|error| TrainError::Recipe {
            file: file.to_owned(),
            reason: error.to_string(),
        })?;
        recipe.validate()?;
        Ok(recipe)
    }

    /// Scenes of a batch and validation objects are held in memory.
    fn check_memory(&self) -> Result<(), TrainError> {
        const EXPECTED: &str = "at most 16";
        let lights = self.scene.sampling.lights_per_scene.max(self.images[1]);
        let pixels = f64::from(self.scene.shapes.crop_object_pixels[1]).max(self.size as f64);
        let scenes = (self.batch * lights * 12) as f64 * pixels * pixels / 1e9;
        let field = "gigabytes of scenes (batch, scene.sampling.lights_per_scene, \
                     scene.shapes.crop_object_pixels)";
        check(field, scenes, 0.0, 16.0, EXPECTED)?;
        let objects = (self.validation_objects * 144) as f64 * (self.size * self.size) as f64 / 1e9;
        let field = "gigabytes of validation_objects";
        check(field, objects, 0.0, 16.0, EXPECTED)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`TrainError::Value`], or the errors of the scene and the architectures.
    pub fn validate(&self) -> Result<(), TrainError> {
        let [fewest, most] = self.images;
        check("steps", self.steps, 1, 100_000_000, "1 or more")?;
        check("batch", self.batch, 1, 1024, "1 to 1024")?;
        check(
            "images, fewest",
            fewest,
            3,
            most,
            "3 or more, at most the most",
        )?;
        check("images, most", most, fewest, 256, "at most 256")?;
        check("size", self.size, 16, 512, "16 to 512")?;
        let many = 1_000_000_000;
        check("validate_every", self.validate_every, 1, many, "1 or more")?;
        check(
            "checkpoint_every",
            self.checkpoint_every,
            1,
            many,
            "1 or more",
        )?;
        // More would not leave room for the steps in the seeds of samples.
        check("seed", self.seed, 0, (1 << 20) - 1, "0 to 1048575")?;
        self.check_memory()?;
        let field = "validation_objects";
        check(field, self.validation_objects, 1, 10_000, "1 to 10000")?;
        check(
            "learning_rate",
            self.learning_rate,
            1e-9,
            1.0,
            "above 0, at most 1",
        )?;
        check("final_rate", self.final_rate, 0.0, 1.0, "0 to 1")?;
        check("clip", self.clip, 1e-6, 1e6, "above 0")?;
        let light = &self.light;
        check(
            "light.label_deviation",
            light.label_deviation,
            0.1,
            10.0,
            "0.1 to 10",
        )?;
        check(
            "light.direction_weight",
            light.direction_weight,
            0.0,
            1e3,
            "0 to 1000",
        )?;
        check(
            "light.intensity_weight",
            light.intensity_weight,
            0.0,
            1e3,
            "0 to 1000",
        )?;
        let normal = &self.normal;
        let field = "normal.light_noise_degrees";
        check(field, normal.light_noise_degrees, 0.0, 45.0, "0 to 45")?;
        let field = "normal.light_drift_degrees";
        check(field, normal.light_drift_degrees, 0.0, 45.0, "0 to 45")?;
        check(
            "normal.intensity_noise",
            normal.intensity_noise,
            0.0,
            0.5,
            "0 to 0.5",
        )?;
        self.scene.validate()?;
        self.light.architecture.validate()?;
        self.normal.architecture.validate()?;
        if self.network == Network::Light && self.size != self.light.architecture.input_size {
            return Err(TrainError::Value {
                field: "size",
                found: self.size.to_string(),
                expected: "the light network's input_size",
            });
        }
        if self.network == Network::Normal && !self.size.is_multiple_of(8) {
            return Err(TrainError::Value {
                field: "size",
                found: self.size.to_string(),
                expected: "a multiple of 8",
            });
        }
        Ok(())
    }

    /// Number of trainable parameters of the network that is trained.
    pub fn parameters(&self) -> usize {
        match self.network {
            Network::Light => light_cost(&self.light.architecture).parameters,
            Network::Normal => normal_cost(&self.normal.architecture, 0).parameters,
        }
    }

    /// Learning rate of a step: linear warm-up, then half a cosine.
    pub fn rate(&self, step: usize) -> f32 {
        let rise = ((step + 1) as f32 / self.warm_up.max(1) as f32).min(1.0);
        let done = (step as f32 / self.steps as f32).min(1.0);
        let cosine = 0.5 + 0.5 * (std::f32::consts::PI * done).cos();
        self.learning_rate * rise * (self.final_rate + (1.0 - self.final_rate) * cosine)
    }
}

fn check<T: PartialOrd + std::fmt::Display>(
    field: &'static str,
    found: T,
    low: T,
    high: T,
    expected: &'static str,
) -> Result<(), TrainError> {
    // NaN compares false and is refused.
    if found >= low && found <= high {
        return Ok(());
    }
    Err(TrainError::Value {
        field,
        found: found.to_string(),
        expected,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_recipes_are_refused_with_the_reason() {
        let good = "network = \"normal\"\nsteps = 10\nsize = 32\n";
        assert!(TrainRecipe::parse("r.toml", good).is_ok());
        for (text, part) in [
            ("stepz = 3\n", "unknown field `stepz`"),
            ("batch = 0\n", "batch is 0, expected 1 to 1024"),
            ("learning_rate = nan\n", "learning_rate is NaN"),
            ("images = [9, 5]\n", "images, fewest is 9"),
            ("[scene.lights]\nrectangle = -1.0\n", "lights"),
        ] {
            let error = TrainRecipe::parse("r.toml", &format!("{good}{text}")).unwrap_err();
            assert!(error.to_string().contains(part), "{error}");
        }
        let light = good.replace("normal", "light");
        let error = TrainRecipe::parse("r.toml", &light).unwrap_err();
        assert!(error.to_string().contains("size is 32"), "{error}");
    }

    #[test]
    fn the_rate_rises_and_falls() {
        let text = "network = \"normal\"\nsteps = 1000\nsize = 32\n";
        let recipe = TrainRecipe::parse("r.toml", text).unwrap();
        assert!(recipe.rate(0) < 3e-5);
        assert!((recipe.rate(50) - 1e-3).abs() < 1e-5);
        assert!((recipe.rate(1000) - 3e-5).abs() < 1e-7);
    }
}
