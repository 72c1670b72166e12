use crate::batch::Batch;
use crate::init::{check_same, check_start, init_error};
use crate::lights::{disturbed, mixed};
use crate::task::Task;
use crate::{NetworkRecipe, NormalSettings, TrainError};
use burn::module::Module;
use burn::tensor::{Device, Tensor, TensorData};
use normalight_core::{CalibratedStack, Light, normal_error};
use normalight_kernels::channels_first;
use normalight_model::{
    AuxiliaryTower, LoadedNetwork, LoadedNormalNetwork, NoopObserver, NormalInput, NormalNetwork,
    PipelineStage, Quality, Weights,
};
use normalight_run::{Validation, collect, fill};
use normalight_synth::{Framing, Sample};
use std::collections::BTreeMap;

/// The normal estimation network on crops, with lights that are a little wrong.
///
/// Target: `[samples, 4, size, size]`, the true normal times the pixel's weight in the loss, and that weight; all zero
/// outside the object.
#[derive(Debug, Clone)]
pub struct NormalTask {
    settings: NormalSettings,
}

impl NormalTask {
    /// With these settings.
    pub fn new(settings: &NormalSettings) -> Self {
        Self {
            settings: settings.clone(),
        }
    }

    /// What is kept of a training, as the pipeline uses it.
    fn loaded(&self, training: &NormalTraining, device: &Device) -> LoadedNormalNetwork {
        LoadedNetwork {
            architecture: self.settings.architecture.clone(),
            network: training.network.clone(),
            device: device.clone(),
        }
    }

    /// Its settings.
    pub fn settings(&self) -> &NormalSettings {
        &self.settings
    }
}

/// The normal network, and the tower that helps its features while it is trained and then goes.
#[derive(Module, Debug)]
pub struct NormalTraining {
    /// What is kept.
    pub network: NormalNetwork,
    auxiliary: Option<AuxiliaryTower>,
}

impl NormalTraining {
    /// With a tower if the recipe wants one.
    pub fn new(network: NormalNetwork, settings: &NormalSettings, device: &Device) -> Self {
        let tower = || AuxiliaryTower::new(&settings.architecture, device);
        let auxiliary = (settings.auxiliary_weight > 0.0).then(tower);
        Self { network, auxiliary }
    }
}

impl Task for NormalTask {
    type Network = NormalTraining;
    const FRAMING: Framing = Framing::Crop;

    fn of(network: &NetworkRecipe) -> Option<Self> {
        match network {
            NetworkRecipe::Normal(settings) => Some(Self::new(settings)),
            _ => None,
        }
    }

    fn network(&self, device: &Device) -> Result<NormalTraining, TrainError> {
        let network = NormalNetwork::new(&self.settings.architecture, false, device)?;
        Ok(NormalTraining::new(network, &self.settings, device))
    }

    fn start_from(
        &self,
        training: NormalTraining,
        weights: &Weights,
        device: &Device,
    ) -> Result<NormalTraining, TrainError> {
        let stored = weights.normal_network(device)?;
        let plain = !stored.architecture.body.is_normalised();
        let same = stored.architecture == self.settings.architecture;
        check_start(weights, plain, same)?;
        let NormalTraining { network, auxiliary } = training;
        let filled = fill(network, &mut collect(&stored.network));
        let network = filled.map_err(|reason| init_error(weights, reason))?;
        Ok(NormalTraining { network, auxiliary })
    }

    fn stored(&self, weights: &Weights, device: &Device) -> Result<NormalTraining, TrainError> {
        let stored = weights.normal_network(device)?;
        check_same(weights, stored.architecture == self.settings.architecture)?;
        Ok(NormalTraining {
            network: stored.network,
            auxiliary: None,
        })
    }

    fn append(&self, sample: &Sample, predicted: Option<&[Light]>, seed: u64, batch: &mut Batch) {
        let lights = mixed(&self.settings, &sample.lights, predicted, seed);
        let area = sample.size * sample.size;
        let images: Vec<&[f32]> = sample.images.chunks_exact(3 * area).collect();
        let mask_channel = self.settings.architecture.mask_channel;
        let read = |image: usize, planes: &mut [f32]| planes.copy_from_slice(images[image]);
        let input = NormalInput::new(mask_channel, sample.mask.clone(), &lights, read);
        let image_values = area * NormalInput::channels(mask_channel);
        let from = batch.input.len();
        batch.input.resize(from + images.len() * image_values, 0.0);
        let outs = batch.input[from..].chunks_exact_mut(image_values);
        for ((planes, light), out) in images.iter().zip(&lights).zip(outs) {
            input.encode(planes, light, |pixel| pixel, out);
        }
        // Weights of pixels enter as the length of the true normal and as the mask's value.
        let weights = pixel_weights(sample, self.settings.curvature_weight);
        for axis in 0..3 {
            let normals = sample.normals.iter().zip(&weights);
            batch
                .target
                .extend(normals.map(|(normal, weight)| normal[axis] * weight));
        }
        batch.target.extend(&weights);
    }

    fn channels(&self) -> usize {
        self.settings.architecture.input_channels()
    }

    fn loss(&self, training: &NormalTraining, batch: &Batch, device: &Device) -> Tensor<1> {
        let fused = training.network.fuse(batch.input(device), batch.samples);
        let (count, size) = (batch.samples, batch.size);
        let target = TensorData::new(batch.target.clone(), [count, 4, size, size]);
        let target = Tensor::<4>::from_data(target, device);
        let truth = target.clone().slice([0..count, 0..3, 0..size, 0..size]);
        let mask = target.slice([0..count, 3..4, 0..size, 0..size]);
        let inside = mask.sum();
        // The truth is zero outside the mask, so those pixels add nothing to the sum of cosines.
        let loss = |normals: Tensor<4>| {
            let cosines = (channels_first(normals) * truth.clone()).sum();
            -(cosines / inside.clone()) + 1.0
        };
        let auxiliary = training.auxiliary.as_ref();
        let auxiliary = auxiliary.map(|tower| loss(tower.forward(fused.features())));
        let main = loss(training.network.regress(fused));
        match auxiliary {
            Some(auxiliary) => main + auxiliary * self.settings.auxiliary_weight,
            None => main,
        }
    }

    /// Pixels inside the masks.
    fn weight(part: &Batch) -> f32 {
        let area = part.size * part.size;
        let samples = part.target.chunks_exact(4 * area);
        samples.flat_map(|planes| &planes[3 * area..]).sum()
    }

    fn validate(
        &self,
        training: &NormalTraining,
        objects: &[Sample],
        device: &Device,
    ) -> Result<Validation, TrainError> {
        let mut sum = 0.0;
        let mut shares = [0.0; 3];
        let loaded = self.loaded(training, device);
        for (index, sample) in objects.iter().enumerate() {
            let (stack, mask) = (sample.to_stack()?, sample.to_mask());
            let lights = disturbed(&self.settings, &sample.lights, index as u64);
            let calibrated = CalibratedStack::new(&stack, &mask, &lights)?;
            let views = Quality::Fast.views();
            let found = pollster::block_on(loaded.estimate(
                calibrated,
                views,
                PipelineStage::Normals,
                &mut NoopObserver,
            ))?;
            let error = normal_error(&found.normals, &sample.to_normal_map(), &mask)?;
            sum += error.mean;
            for (share, found) in shares.iter_mut().zip(error.shares) {
                *share += found / objects.len() as f32;
            }
        }
        let names = ["under_11_25", "under_22_5", "under_30"];
        Ok(Validation {
            degrees: (sum / objects.len() as f32).to_degrees(),
            figures: names.map(str::to_owned).into_iter().zip(shares).collect(),
        })
    }

    fn bytes(&self, training: &NormalTraining) -> Result<Vec<u8>, TrainError> {
        let architecture = &self.settings.architecture;
        Ok(Weights::normal_bytes(
            architecture,
            &training.network,
            &BTreeMap::new(),
        )?)
    }
}

/// Weight of every pixel in the loss: 0 outside the object, 1 inside plus `curvature` times the mean distance of its normal
/// from those of its neighbours (up to four).
fn pixel_weights(sample: &Sample, curvature: f32) -> Vec<f32> {
    let size = sample.size;
    let weight = |(pixel, &inside): (usize, &bool)| {
        if !inside || curvature == 0.0 {
            return f32::from(u8::from(inside));
        }
        let (x, y) = (pixel % size, pixel / size);
        let neighbours = [
            (x > 0).then(|| pixel - 1),
            (x + 1 < size).then(|| pixel + 1),
            (y > 0).then(|| pixel - size),
            (y + 1 < size).then(|| pixel + size),
        ];
        let neighbours = neighbours.into_iter().flatten();
        let (mut sum, mut count) = (0.0, 0.0f32);
        for neighbour in neighbours.filter(|&neighbour| sample.mask[neighbour]) {
            sum += sample.normals[neighbour].distance(sample.normals[pixel]);
            count += 1.0;
        }
        1.0 + curvature * sum / count.max(1.0)
    };
    sample.mask.iter().enumerate().map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LightMix;
    use glam::Vec3;
    use normalight_run::seeded;
    use normalight_synth::{Preset, Renderer};

    /// What training shows the network is what the pipeline shows it, up to rounding in the stack of photographs.
    #[test]
    fn training_and_pipeline_encode_alike() {
        let device = Device::flex();
        let settings = NormalSettings {
            lights: LightMix {
                truth: 0.0,
                perturbed: 1.0,
                ..LightMix::default()
            },
            ..NormalSettings::default()
        };
        let task = NormalTask::new(&settings);
        let renderer = Renderer::new(Preset::World.recipe()).unwrap();
        let training = seeded(&device, 1, || task.network(&device)).unwrap();
        for number in 0..3 {
            let mut sample = renderer.sample(number, 5, 16, Framing::Crop);
            // So that the pipeline's tile is the whole crop.
            sample.mask.fill(true);
            let mut batch = Batch {
                samples: 1,
                images: 5,
                size: 16,
                channels: task.channels(),
                input: Vec::new(),
                target: Vec::new(),
            };
            task.append(&sample, None, number, &mut batch);
            let fused = training.network.fuse(batch.input(&device), 1);
            let shown = training.network.regress(fused).into_data();
            let shown = shown.try_to_vec::<f32>().unwrap();
            let (stack, mask) = (sample.to_stack().unwrap(), sample.to_mask());
            let lights = mixed(&settings, &sample.lights, None, number);
            let calibrated = CalibratedStack::new(&stack, &mask, &lights).unwrap();
            let loaded = task.loaded(&training, &device);
            let views = Quality::Fast.views();
            let averaged = pollster::block_on(loaded.estimate(
                calibrated,
                views,
                PipelineStage::Normals,
                &mut NoopObserver,
            ))
            .unwrap();
            for (found, shown) in averaged.normals.normals().iter().zip(shown.chunks_exact(3)) {
                // Rounding grows where the vector before it gets unit length is short.
                assert!(found.distance(Vec3::from_slice(shown)) < 1e-4);
            }
        }
    }

    /// A fold of 90 degrees between two planes: its two columns weigh more, by the chord to one of their neighbours.
    #[test]
    fn folds_weigh_more() {
        let renderer = Renderer::new(Preset::World.recipe()).unwrap();
        let mut sample = renderer.sample(0, 3, 16, Framing::Crop);
        let size = sample.size;
        let slope = std::f32::consts::FRAC_1_SQRT_2;
        for pixel in 0..size * size {
            let side = if pixel % size < size / 2 {
                -slope
            } else {
                slope
            };
            sample.normals[pixel] = Vec3::new(side, 0.0, slope);
            sample.mask[pixel] = pixel / size > 0;
        }
        let weights = pixel_weights(&sample, 2.0);
        for (pixel, weight) in weights.iter().enumerate() {
            let (x, y) = (pixel % size, pixel / size);
            let neighbours = if y == 1 || y + 1 == size { 3.0 } else { 4.0 };
            let expected = match (y, x == size / 2 - 1 || x == size / 2) {
                (0, _) => 0.0,
                (_, false) => 1.0,
                (_, true) => 1.0 + 2.0 * 2.0f32.sqrt() / neighbours,
            };
            assert!((weight - expected).abs() < 1e-5, "{x} {y}: {weight}");
        }
        let plain = pixel_weights(&sample, 0.0);
        assert_eq!(plain.iter().sum::<f32>(), (size * (size - 1)) as f32);
    }
}
