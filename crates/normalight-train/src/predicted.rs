//! The errors that a light network makes, as the lights of training samples.
use crate::{NetworkRecipe, TrainError, TrainRecipe};
use burn::tensor::Device;
use glam::Vec3;
use normalight_core::Light;
use normalight_model::{LightOptions, LoadedLightNetwork, NoopObserver, Weights, default_weights};
use normalight_run::RunError;
use normalight_synth::{Sample, Scene};
use std::path::Path;
use std::sync::Arc;

/// A light network that looks at scenes. Every thread has its own: GPUs keep their work by thread.
pub struct Predictor {
    weights: Arc<Weights>,
    device: Device,
    network: Option<LoadedLightNetwork>,
}

impl Clone for Predictor {
    fn clone(&self) -> Self {
        Self {
            weights: Arc::clone(&self.weights),
            device: self.device.clone(),
            network: None,
        }
    }
}

/// What a light network says about the lamps of one scene.
#[derive(Debug)]
pub struct Prediction {
    /// Directions in the scene's axes, by lamp.
    directions: Vec<Vec3>,
    /// Predicted over true intensity, both relative to their means over the lamps.
    factors: Vec<f32>,
}

impl Predictor {
    /// For a recipe that asks for predicted lights.
    ///
    /// # Errors
    /// The file, or weights of another network.
    pub fn of(recipe: &TrainRecipe, device: &Device) -> Result<Option<Self>, TrainError> {
        match &recipe.network {
            NetworkRecipe::Normal(settings) if settings.lights.predicted > 0.0 => {
                Self::new(settings.lights.light_weights.as_deref(), device).map(Some)
            }
            _ => Ok(None),
        }
    }

    /// `file`: a light network's weights; the shipped ones when missing.
    ///
    /// # Errors
    /// The file, or weights of another network.
    pub fn new(file: Option<&Path>, device: &Device) -> Result<Self, TrainError> {
        let weights = match file {
            Some(path) => read_weights(path)?,
            None => {
                let [light, _] = default_weights()?;
                light
            }
        };
        // Found out here, not on another thread.
        weights.light_network(device)?;
        Ok(Self {
            weights: Arc::new(weights),
            device: device.clone(),
            network: None,
        })
    }

    /// Looks once at the whole scene under all of its lamps.
    pub fn predict(&mut self, scene: &Scene) -> Result<Prediction, TrainError> {
        let sample = scene.whole(scene.lamps());
        let (stack, mask) = (sample.to_stack()?, sample.to_mask());
        let network = match &mut self.network {
            Some(network) => network,
            none => none.insert(self.weights.light_network(&self.device)?),
        };
        let predicted = pollster::block_on(network.estimate(
            &stack,
            &mask,
            LightOptions::FAST,
            &mut NoopObserver,
        ))?;
        Ok(Prediction::new(&predicted, &sample.lights))
    }
}

impl Prediction {
    fn new(predicted: &[Light], truth: &[Light]) -> Self {
        let (predicted_mean, true_mean) = (mean(predicted), mean(truth));
        let pairs = predicted.iter().zip(truth);
        let factor = |(predicted, truth): (&Light, &Light)| {
            let found = predicted.mean_intensity() / predicted_mean;
            found / (truth.mean_intensity() / true_mean).max(1e-6)
        };
        Self {
            directions: predicted.iter().map(|light| light.direction).collect(),
            factors: pairs.map(factor).collect(),
        }
    }

    /// The lights of a sample of the scene with the errors of its lamps; intensities relative to their
    /// mean.
    pub fn lights(&self, sample: &Sample) -> Vec<Light> {
        let lights: Vec<Light> = sample
            .lights
            .iter()
            .zip(&sample.lamps)
            .map(|(light, &lamp)| {
                let direction = sample.axes * self.directions[lamp];
                Light::new(direction, light.mean_intensity() * self.factors[lamp])
            })
            .collect();
        let mean = mean(&lights);
        let relative = |light: &Light| Light::new(light.direction, light.mean_intensity() / mean);
        lights.iter().map(relative).collect()
    }
}

/// Mean intensity, never quite zero.
fn mean(lights: &[Light]) -> f32 {
    let sum: f32 = lights.iter().map(Light::mean_intensity).sum();
    (sum / lights.len().max(1) as f32).max(1e-6)
}

/// Reads a weights file of either network.
pub fn read_weights(path: &Path) -> Result<Weights, TrainError> {
    let bytes = std::fs::read(path).map_err(|reason| {
        TrainError::Run(RunError::File {
            path: path.to_owned(),
            reason,
        })
    })?;
    Ok(Weights::from_bytes(&path.display().to_string(), &bytes)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_synth::{Preset, Renderer};

    /// What is predicted right stays right in every crop, however it is turned; an error of one lamp
    /// appears in the images under that lamp alone.
    #[test]
    fn errors_follow_their_lamps() {
        let renderer = Renderer::new(Preset::World.recipe()).unwrap();
        let scene = renderer.crop_scene(3, 8, 32);
        let truth = scene.whole(scene.lamps()).lights;
        let exact = Prediction::new(&truth, &truth);
        let mut wrong = truth.clone();
        wrong[5] = Light::new(Vec3::Z, wrong[5].mean_intensity());
        let wrong = Prediction::new(&wrong, &truth);
        let mut seen = 0;
        for part in 0..8 {
            let sample = scene.crop(part, 8);
            let mean = mean(&sample.lights);
            let lights = exact.lights(&sample).into_iter().zip(wrong.lights(&sample));
            for ((truth, &lamp), (exact, wrong)) in
                sample.lights.iter().zip(&sample.lamps).zip(lights)
            {
                assert!((exact.direction - truth.direction).length() < 1e-5);
                let relative = truth.mean_intensity() / mean;
                assert!((exact.mean_intensity() / relative - 1.0).abs() < 1e-4);
                let expected = if lamp == 5 { Vec3::Z } else { truth.direction };
                assert!((wrong.direction - expected).length() < 1e-5);
                seen += usize::from(lamp == 5);
            }
        }
        assert!(seen > 0, "no crop was taken under lamp 5");
    }

    /// The shipped network is far better than chance on a scene it has never seen.
    #[test]
    fn the_shipped_network_predicts() {
        let mut predictor = Predictor::new(None, &Device::flex()).unwrap();
        let renderer = Renderer::new(Preset::World.recipe()).unwrap();
        let mut errors = Vec::new();
        for number in 0..4 {
            let scene = renderer.crop_scene(number, 8, 32);
            let prediction = predictor.predict(&scene).unwrap();
            let sample = scene.crop(0, 8);
            for (found, truth) in prediction.lights(&sample).iter().zip(&sample.lights) {
                errors.push(found.direction.angle_between(truth.direction).to_degrees());
            }
        }
        let mean = errors.iter().sum::<f32>() / errors.len() as f32;
        assert!((0.5..20.0).contains(&mean), "{mean} degrees");
    }
}
