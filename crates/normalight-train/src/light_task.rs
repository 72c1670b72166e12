use crate::batch::Batch;
use crate::init::{check_same, check_start, init_error};
use crate::task::Task;
use crate::{LightSettings, NetworkRecipe, TrainError};
use burn::tensor::{Device, Tensor, TensorData, activation};
use normalight_core::{Light, LightBins, intensity_error, mean_light_error};
use normalight_kernels::max_over_images;
use normalight_model::{
    LightInput, LightNetwork, LightOptions, LoadedNetwork, NoopObserver, Weights,
};
use normalight_run::{Validation, collect, fill};
use normalight_synth::{Framing, Sample};
use std::collections::BTreeMap;
use std::f32::consts::PI;

/// The light calibration network on whole objects.
///
/// Target: `[samples * images, classes + 4]`: soft labels of the three heads side by side, the
/// true direction, the logarithm of the intensity relative to the sample's mean.
#[derive(Debug, Clone)]
pub struct LightTask {
    settings: LightSettings,
}

impl LightTask {
    /// With these settings.
    pub fn new(settings: &LightSettings) -> Self {
        Self {
            settings: settings.clone(),
        }
    }

    /// Its settings.
    pub fn settings(&self) -> &LightSettings {
        &self.settings
    }
}

impl Task for LightTask {
    type Network = LightNetwork;
    const FRAMING: Framing = Framing::WholeObject;

    fn of(network: &NetworkRecipe) -> Option<Self> {
        match network {
            NetworkRecipe::Light(settings) => Some(Self::new(settings)),
            _ => None,
        }
    }

    fn network(&self, device: &Device) -> Result<LightNetwork, TrainError> {
        Ok(LightNetwork::new(
            &self.settings.architecture,
            false,
            device,
        )?)
    }

    fn start_from(
        &self,
        network: LightNetwork,
        weights: &Weights,
        device: &Device,
    ) -> Result<LightNetwork, TrainError> {
        let stored = weights.light_network(device)?;
        let plain = !stored.architecture.body.is_normalised();
        let same = stored.architecture == self.settings.architecture;
        check_start(weights, plain, same)?;
        let filled = fill(network, &mut collect(&stored.network));
        filled.map_err(|reason| init_error(weights, reason))
    }

    fn stored(&self, weights: &Weights, device: &Device) -> Result<LightNetwork, TrainError> {
        let stored = weights.light_network(device)?;
        check_same(weights, stored.architecture == self.settings.architecture)?;
        Ok(stored.network)
    }

    fn append(&self, sample: &Sample, _predicted: Option<&[Light]>, _seed: u64, batch: &mut Batch) {
        let area = sample.size * sample.size;
        let inside = sample.mask.iter().filter(|&&inside| inside).count();
        // Outside the object samples are black.
        let sum: f64 = sample.images.iter().map(|&value| f64::from(value)).sum();
        let count = (3 * inside.max(1) * sample.lights.len()) as f64;
        let input = LightInput::new((sum / count) as f32);
        let from = batch.input.len();
        let values = sample.lights.len() * area * LightInput::CHANNELS;
        batch.input.resize(from + values, 0.0);
        let outs = batch.input[from..].chunks_exact_mut(area * LightInput::CHANNELS);
        for (planes, out) in sample.images.chunks_exact(3 * area).zip(outs) {
            input.encode(planes, &sample.mask, out);
        }
        let bins = &self.settings.architecture.bins;
        let brightness = sample.lights.iter().map(Light::mean_intensity);
        let mean = brightness.sum::<f32>() / sample.lights.len() as f32;
        for light in &sample.lights {
            let relative = Light::new(light.direction, light.mean_intensity() / mean);
            let positions = bins.positions(&relative);
            let deviation = self.settings.label_deviation;
            for (position, count) in positions.into_iter().zip(heads(bins)) {
                batch.target.extend(soft_label(position, count, deviation));
            }
            batch.target.extend(light.direction.to_array());
            batch.target.push(relative.mean_intensity().ln());
        }
    }

    fn channels(&self) -> usize {
        LightInput::CHANNELS
    }

    fn loss(&self, network: &LightNetwork, batch: &Batch, device: &Device) -> Tensor<1> {
        let settings = &self.settings;
        let bins = &settings.architecture.bins;
        let own = network.features(batch.input(device));
        let fused = repeat_per_image(max_over_images(own.clone(), batch.samples), batch.images);
        let scores = network.classify(own, fused);
        let [rows, classes] = scores.dims();
        let target = TensorData::new(batch.target.clone(), [rows, classes + 4]);
        let target = Tensor::<2>::from_data(target, device);
        let column = |from: usize, to: usize| target.clone().slice([0..rows, from..to]);
        let [azimuths, elevations, intensities] = heads(bins);
        let mut loss = Tensor::<1>::zeros([1], device);
        let mut expected = Vec::with_capacity(3);
        let mut from = 0;
        for count in [azimuths, elevations, intensities] {
            let head = scores.clone().slice([0..rows, from..from + count]);
            let log = activation::log_softmax(head, 1);
            loss = loss - (log.clone() * column(from, from + count)).sum() / rows as f32;
            let centres: Vec<f32> = (0..count).map(|k| k as f32 + 0.5).collect();
            let centres = Tensor::<2>::from_data(TensorData::new(centres, [1, count]), device);
            expected.push((log.exp() * centres).sum_dim(1));
            from += count;
        }
        let angle =
            |position: &Tensor<2>, count: usize| position.clone() * (PI / count as f32) - PI / 2.0;
        let azimuth = angle(&expected[0], azimuths);
        let elevation = angle(&expected[1], elevations);
        let flat = elevation.clone().cos();
        let direction = Tensor::cat(
            vec![
                azimuth.clone().sin() * flat.clone(),
                elevation.sin(),
                azimuth.cos() * flat,
            ],
            1,
        );
        let cosine = (direction * column(classes, classes + 3)).sum() / rows as f32;
        loss = loss + (-cosine + 1.0) * settings.direction_weight;
        // Classes are spaced evenly in the logarithm (ours) or linearly (the paper's); for the
        // latter the middle slope serves as an approximation.
        let per_class = (bins.intensity.high / bins.intensity.low).ln() / intensities as f32;
        let logarithm = expected[2].clone() * per_class + bins.intensity.low.ln();
        let error = (logarithm - column(classes + 3, classes + 4))
            .square()
            .sum()
            / rows as f32;
        loss + error * settings.intensity_weight
    }

    /// Samples; all have the same number of images.
    fn weight(part: &Batch) -> f32 {
        part.samples as f32
    }

    fn validate(
        &self,
        network: &LightNetwork,
        objects: &[Sample],
        device: &Device,
    ) -> Result<Validation, TrainError> {
        let (mut sum, mut intensity) = (0.0, 0.0);
        let loaded = LoadedNetwork {
            architecture: self.settings.architecture.clone(),
            network: network.clone(),
            device: device.clone(),
        };
        for sample in objects {
            let (stack, mask) = (sample.to_stack()?, sample.to_mask());
            let lights = pollster::block_on(loaded.estimate(
                &stack,
                &mask,
                LightOptions::FAST,
                &mut NoopObserver,
            ))?;
            sum += mean_light_error(&lights, &sample.lights)?;
            intensity += intensity_error(&lights, &sample.lights)?;
        }
        let intensity = intensity / objects.len() as f32;
        Ok(Validation {
            degrees: (sum / objects.len() as f32).to_degrees(),
            figures: BTreeMap::from([("intensity_error".to_owned(), intensity)]),
        })
    }

    fn bytes(&self, network: &LightNetwork) -> Result<Vec<u8>, TrainError> {
        let architecture = &self.settings.architecture;
        Ok(Weights::light_bytes(
            architecture,
            network,
            &BTreeMap::new(),
        )?)
    }
}

fn heads(bins: &LightBins) -> [usize; 3] {
    [bins.azimuth, bins.elevation, bins.intensity.count]
}

/// A Gaussian around a position on the class axis, summing to one.
fn soft_label(position: f32, count: usize, deviation: f32) -> Vec<f32> {
    let position = position.clamp(0.0, count as f32);
    let mut label: Vec<f32> = (0..count)
        .map(|class| (-0.5 * ((class as f32 + 0.5 - position) / deviation).powi(2)).exp())
        .collect();
    let sum: f32 = label.iter().sum();
    for value in &mut label {
        *value /= sum;
    }
    label
}

/// # Shapes
/// - fused: `[samples, height, width, channels]`
/// - output: `[samples * images, height, width, channels]`
fn repeat_per_image(fused: Tensor<4>, images: usize) -> Tensor<4> {
    let [samples, height, width, channels] = fused.dims();
    fused
        .reshape([samples, 1, height * width * channels])
        .expand([samples, images, height * width * channels])
        .reshape([samples * images, height, width, channels])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soft_labels_keep_their_mean() {
        for position in [6.2f32, 18.0, 29.9] {
            let label = soft_label(position, 36, 1.0);
            let weighted = label.iter().enumerate().map(|(k, p)| (k as f32 + 0.5) * p);
            assert!((weighted.sum::<f32>() - position).abs() < 1e-3);
        }
    }
}
