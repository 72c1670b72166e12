use crate::batch::Batch;
use crate::init::{check_start, init_error};
use crate::lights::{disturbed, mixed};
use crate::named_tensors::{collect, fill};
use crate::predicted::Predicted;
use crate::task::{Task, Validation};
use crate::{TrainError, TrainRecipe};
use burn::module::Module;
use burn::tensor::{Device, Tensor, TensorData};
use normalight_core::normal_error;
use normalight_kernels::{channels_first, max_over_images};
use normalight_model::{
    AuxiliaryTower, NormalBody, NormalNetwork, Quiet, Stage, Weights, estimate_normals,
};
use normalight_synth::{Framing, Sample};
use std::collections::BTreeMap;

/// The normal estimation network on crops, with lights that are a little wrong.
///
/// Target: `[samples, 4, size, size]`, the true normal (zero outside the object) and the mask.
pub(crate) struct NormalTask;

/// The normal network, and the tower that helps its features while it is trained and then goes.
#[derive(Module, Debug)]
pub(crate) struct NormalTraining {
    pub(crate) network: NormalNetwork,
    auxiliary: Option<AuxiliaryTower>,
}

impl NormalTraining {
    /// With a tower if the recipe wants one.
    pub(crate) fn new(network: NormalNetwork, recipe: &TrainRecipe, device: &Device) -> Self {
        let settings = &recipe.normal;
        let tower = || AuxiliaryTower::new(&settings.architecture, device);
        let auxiliary = (settings.auxiliary_weight > 0.0).then(tower);
        Self { network, auxiliary }
    }
}

impl Task for NormalTask {
    type Network = NormalTraining;
    const FRAMING: Framing = Framing::Crop;

    fn network(recipe: &TrainRecipe, device: &Device) -> Result<NormalTraining, TrainError> {
        let network = NormalNetwork::new(&recipe.normal.architecture, false, device)?;
        Ok(NormalTraining::new(network, recipe, device))
    }

    fn start_from(
        recipe: &TrainRecipe,
        training: NormalTraining,
        weights: &Weights,
        device: &Device,
    ) -> Result<NormalTraining, TrainError> {
        let (found, stored) = weights.normal_network(device)?;
        let plain = matches!(found.body, NormalBody::Plain(_));
        check_start(weights, plain, found == recipe.normal.architecture)?;
        let NormalTraining { network, auxiliary } = training;
        let filled = fill(network, &mut collect(&stored));
        let network = filled.map_err(|reason| init_error(weights, reason))?;
        Ok(NormalTraining { network, auxiliary })
    }

    fn append(
        recipe: &TrainRecipe,
        sample: &Sample,
        predicted: Option<&Predicted>,
        seed: u64,
        batch: &mut Batch,
    ) {
        let predicted = predicted.map(|predicted| predicted.lights.as_slice());
        let lights = mixed(&recipe.normal, &sample.lights, predicted, seed);
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
            for (pixel, &inside) in sample.mask.iter().enumerate() {
                let colour = [0, 1, 2].map(|channel| {
                    let place = channel * area + pixel;
                    image[place] * factor * scale[place]
                });
                batch.input.extend(colour);
                batch.input.extend(light.direction.to_array());
                if recipe.normal.architecture.mask_channel {
                    batch.input.push(f32::from(u8::from(inside)));
                }
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
        recipe: &TrainRecipe,
        training: &NormalTraining,
        batch: &Batch,
        device: &Device,
    ) -> Tensor<1> {
        let features = training.network.features(batch.input(device));
        let fused = max_over_images(features, batch.samples);
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
        let main = loss(training.network.regress(fused.clone()));
        match &training.auxiliary {
            Some(tower) => main + loss(tower.forward(fused)) * recipe.normal.auxiliary_weight,
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
        recipe: &TrainRecipe,
        training: &NormalTraining,
        objects: &[Sample],
        device: &Device,
    ) -> Result<Validation, TrainError> {
        let mut sum = 0.0;
        let mut shares = [0.0; 3];
        for (index, sample) in objects.iter().enumerate() {
            let (stack, mask) = (sample.to_stack()?, sample.to_mask());
            let lights = disturbed(&recipe.normal, &sample.lights, index as u64);
            let normals = pollster::block_on(estimate_normals(
                &recipe.normal.architecture,
                &training.network,
                &stack,
                &mask,
                &lights,
                device,
                Stage::Normals,
                &mut Quiet,
            ))?;
            let error = normal_error(&normals, &sample.to_normal_map(), &mask)?;
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

    fn bytes(recipe: &TrainRecipe, training: &NormalTraining) -> Result<Vec<u8>, TrainError> {
        let architecture = &recipe.normal.architecture;
        Ok(Weights::normal_bytes(
            architecture,
            &training.network,
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
