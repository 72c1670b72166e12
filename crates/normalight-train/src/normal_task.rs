use crate::batch::Batch;
use crate::task::Task;
use crate::{TrainError, TrainRecipe};
use burn::tensor::{Device, Tensor, TensorData};
use glam::{Quat, Vec3};
use normalight_core::{Light, normal_error};
use normalight_kernels::{channels_first, max_over_images};
use normalight_model::{NormalNetwork, Quiet, Stage, Weights, estimate_normals};
use normalight_synth::{Framing, Sample, scrambled};
use std::collections::BTreeMap;

/// The normal estimation network on crops, with lights that are a little wrong.
///
/// Target: `[samples, 4, size, size]`, the true normal (zero outside the object) and the mask.
pub(crate) struct NormalTask;

impl Task for NormalTask {
    type Network = NormalNetwork;
    const FRAMING: Framing = Framing::Crop;

    fn network(recipe: &TrainRecipe, device: &Device) -> Result<NormalNetwork, TrainError> {
        let architecture = &recipe.normal.architecture;
        Ok(NormalNetwork::new(architecture, false, device)?)
    }

    fn append(recipe: &TrainRecipe, sample: &Sample, seed: u64, batch: &mut Batch) {
        let lights = disturbed(recipe, &sample.lights, seed);
        let area = sample.size * sample.size;
        let mut squares = vec![0.0f32; 3 * area];
        for (image, light) in sample.images.chunks_exact(3 * area).zip(&lights) {
            let factor = 1.0 / light.mean_intensity();
            for (square, value) in squares.iter_mut().zip(image) {
                *square += (value * factor).powi(2);
            }
        }
        let scale: Vec<f32> = squares
            .iter()
            .map(|square| {
                let rms = (square / lights.len() as f32).sqrt();
                if rms > 1e-6 { 1.0 / rms } else { 0.0 }
            })
            .collect();
        for (image, light) in sample.images.chunks_exact(3 * area).zip(&lights) {
            let factor = 1.0 / light.mean_intensity();
            let scaled = image.iter().zip(&scale);
            batch
                .input
                .extend(scaled.map(|(value, scale)| value * factor * scale));
            for component in light.direction.to_array() {
                batch.input.extend(std::iter::repeat_n(component, area));
            }
            if recipe.normal.architecture.mask_channel {
                batch.input.extend(mask_plane(sample));
            }
        }
        for axis in 0..3 {
            batch
                .target
                .extend(sample.normals.iter().map(|normal| normal[axis]));
        }
        batch.target.extend(mask_plane(sample));
    }

    fn channels(recipe: &TrainRecipe) -> usize {
        recipe.normal.architecture.input_channels()
    }

    fn loss(
        _recipe: &TrainRecipe,
        network: &NormalNetwork,
        batch: &Batch,
        device: &Device,
    ) -> Tensor<1> {
        let features = network.features(batch.input(device));
        let fused = max_over_images(features, batch.samples);
        let normals = channels_first(network.regress(fused));
        let (count, size) = (batch.samples, batch.size);
        let target = TensorData::new(batch.target.clone(), [count, 4, size, size]);
        let target = Tensor::<4>::from_data(target, device);
        let truth = target.clone().slice([0..count, 0..3, 0..size, 0..size]);
        let mask = target.slice([0..count, 3..4, 0..size, 0..size]);
        // The truth is zero outside the mask, so those pixels add nothing to the sum of cosines.
        let cosines = (normals * truth).sum();
        let inside = mask.sum();
        -(cosines / inside) + 1.0
    }

    fn validate(
        recipe: &TrainRecipe,
        network: &NormalNetwork,
        objects: &[Sample],
        device: &Device,
    ) -> Result<f32, TrainError> {
        let mut sum = 0.0;
        for (index, sample) in objects.iter().enumerate() {
            let (stack, mask) = (sample.to_stack()?, sample.to_mask());
            let lights = disturbed(recipe, &sample.lights, index as u64);
            let normals = pollster::block_on(estimate_normals(
                &recipe.normal.architecture,
                network,
                &stack,
                &mask,
                &lights,
                device,
                Stage::Normals,
                &mut Quiet,
            ))?;
            sum += normal_error(&normals, &sample.to_normal_map(), &mask)?.mean;
        }
        Ok((sum / objects.len() as f32).to_degrees())
    }

    fn bytes(recipe: &TrainRecipe, network: &NormalNetwork) -> Result<Vec<u8>, TrainError> {
        let architecture = &recipe.normal.architecture;
        Ok(Weights::normal_bytes(
            architecture,
            network,
            &BTreeMap::new(),
        )?)
    }
}

fn mask_plane(sample: &Sample) -> impl Iterator<Item = f32> {
    sample
        .mask
        .iter()
        .map(|&inside| f32::from(u8::from(inside)))
}

/// Lights as a light network would give them: each a little off, all a little off together, and
/// intensities relative to their mean.
fn disturbed(recipe: &TrainRecipe, lights: &[Light], seed: u64) -> Vec<Light> {
    let settings = &recipe.normal;
    let mut noise = Noise::new(seed);
    let single = settings.light_noise_degrees.to_radians() * noise.share();
    let common = settings.light_drift_degrees.to_radians() * noise.share();
    let drift = Quat::from_scaled_axis(noise.vector() * common);
    // Stretching one axis imitates the light networks' typical error: angles too small or large.
    let stretch = 1.0 + 0.5 * common * noise.vector();
    let mean = lights.iter().map(Light::mean_intensity).sum::<f32>() / lights.len() as f32;
    lights
        .iter()
        .map(|light| {
            let turned = drift * (light.direction * stretch);
            let direction = Quat::from_scaled_axis(noise.vector() * single) * turned.normalize();
            let factor = 1.0 + settings.intensity_noise * noise.normal();
            Light::new(direction, light.mean_intensity() / mean * factor.max(0.3))
        })
        .collect()
}

/// What SplitMix64 adds to its state.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// A small reproducible source of disturbances (SplitMix64, Steele et al. 2014).
struct Noise(u64);

impl Noise {
    fn new(seed: u64) -> Self {
        Self(seed ^ 0x6c69_6768_7473)
    }

    fn unit(&mut self) -> f32 {
        let number = scrambled(self.0);
        self.0 = self.0.wrapping_add(STEP);
        (number >> 40) as f32 / 16_777_216.0
    }

    /// Strength of this sample's disturbance: from none to twice the recipe's.
    fn share(&mut self) -> f32 {
        2.0 * self.unit()
    }

    /// Mean 0, deviation 1.
    fn normal(&mut self) -> f32 {
        (0..12).map(|_| self.unit()).sum::<f32>() - 6.0
    }

    fn vector(&mut self) -> Vec3 {
        // Deviation 1 over the two axes that move a direction.
        Vec3::new(self.normal(), self.normal(), self.normal()) * std::f32::consts::FRAC_1_SQRT_2
    }
}
