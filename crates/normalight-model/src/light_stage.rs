use crate::observer::{Observer, PipelineStage, report};
use crate::{LightInput, LightView, LoadedLightNetwork, ModelError, Quality, light_cost};
use burn::tensor::{Tensor, TensorData, activation};
use normalight_core::{Decoding, ImageStack, Light, Mask};
use std::ops::Range;

/// Images that go through the network together: bounds the memory, whatever the size of the stack.
const BATCH: usize = 16;

/// How lights are estimated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightOptions {
    /// How classes become numbers.
    pub decoding: Decoding,
    /// Whether mirrored photographs are looked at, too.
    pub quality: Quality,
}

impl LightOptions {
    /// One look, for lights that are needed often: in training.
    pub const FAST: Self = Self {
        decoding: Decoding::SoftArgmax,
        quality: Quality::Fast,
    };
}

impl LoadedLightNetwork {
    /// Multiply-adds of an estimate: features are computed twice, for their maximum and to be classified beside it.
    pub(crate) fn multiply_adds(&self, images: usize, quality: Quality) -> u64 {
        let views = if quality.mirrors_lights() { 2 } else { 1 };
        2 * views * light_cost(&self.architecture).multiply_adds(images)
    }

    /// Estimates the light of every image: one pass for the maximum of the features over the images,
    /// one to classify each image against it.
    ///
    /// A quality that averages does all of this for the mirrored photographs too and takes the mean of
    /// the class probabilities. With soft-argmax that is the mean of the angles, and views that
    /// disagree spread the probabilities, which lowers the confidence.
    ///
    /// Intensities come back relative to their mean.
    ///
    /// # Errors
    /// [`ModelError::Cancelled`] or [`ModelError::Device`].
    pub async fn estimate(
        &self,
        stack: &ImageStack,
        mask: &Mask,
        options: LightOptions,
        observer: &mut impl Observer,
    ) -> Result<Vec<Light>, ModelError> {
        let bins = &self.architecture.bins;
        let views: &[bool] = if options.quality.mirrors_lights() {
            &[false, true]
        } else {
            &[false]
        };
        let mut look = Look {
            loaded: self,
            view: LightView::new(stack, mask, self.architecture.input_size),
            stack,
            mirrored: false,
            done: 0,
            steps: 2 * stack.len() * views.len(),
        };
        let mut probabilities = vec![0.0; stack.len() * bins.classes()];
        for &mirrored in views {
            look.mirrored = mirrored;
            let found = look.probabilities(observer).await?;
            for (sum, value) in probabilities.iter_mut().zip(found) {
                *sum += value / views.len() as f32;
            }
        }
        report(observer, PipelineStage::Lights, 1.0).await?;
        let lights = probabilities.chunks_exact(bins.classes()).map(|row| {
            let (azimuth, rest) = row.split_at(bins.azimuth);
            let (elevation, intensity) = rest.split_at(bins.elevation);
            bins.decode(azimuth, elevation, intensity, options.decoding)
        });
        Ok(relative(lights.collect()))
    }
}

/// One look of the network at all photographs.
struct Look<'a> {
    loaded: &'a LoadedLightNetwork,
    view: LightView,
    stack: &'a ImageStack,
    /// Left and right exchanged.
    mirrored: bool,
    /// Images that have passed the network, and how many will have in the end.
    done: usize,
    steps: usize,
}

impl Look<'_> {
    /// Probabilities of the classes; those of mirrored photographs are mirrored back.
    ///
    /// # Shapes
    /// `[images, classes]`: azimuth, elevation, intensity side by side.
    async fn probabilities(
        &mut self,
        observer: &mut impl Observer,
    ) -> Result<Vec<f32>, ModelError> {
        let LoadedLightNetwork {
            architecture,
            network,
            ..
        } = self.loaded;
        let bins = &architecture.bins;
        let count = self.stack.len();
        let mut fused: Option<Tensor<4>> = None;
        for first in (0..count).step_by(BATCH) {
            let images = first..count.min(first + BATCH);
            let most = network
                .features(self.batch(images, observer).await?)
                .max_dim(0);
            fused = Some(match fused {
                Some(before) => before.max_pair(most),
                None => most,
            });
        }
        let Some(fused) = fused else {
            return Ok(Vec::new());
        };
        let (azimuths, elevations) = (bins.azimuth, bins.elevation);
        let mut probabilities = Vec::with_capacity(count * bins.classes());
        for first in (0..count).step_by(BATCH) {
            let images = first..count.min(first + BATCH);
            let own = network.features(self.batch(images, observer).await?);
            let together = fused.clone().expand(own.dims());
            let scores = network.classify(own, together);
            let [rows, classes] = scores.dims();
            let softmax = |from: usize, to: usize| {
                activation::softmax(scores.clone().slice([0..rows, from..to]), 1)
            };
            let heads = vec![
                softmax(0, azimuths),
                softmax(azimuths, azimuths + elevations),
                softmax(azimuths + elevations, classes),
            ];
            probabilities.extend(read_back(Tensor::cat(heads, 1)).await?);
        }
        if self.mirrored {
            for row in probabilities.chunks_exact_mut(bins.classes()) {
                row[..azimuths].reverse();
            }
        }
        Ok(probabilities)
    }

    /// Some images, after a word to the observer.
    ///
    /// # Shapes
    /// `[images, size, size, 4]`
    async fn batch(
        &mut self,
        images: Range<usize>,
        observer: &mut impl Observer,
    ) -> Result<Tensor<4>, ModelError> {
        let fraction = self.done as f32 / self.steps as f32;
        report(observer, PipelineStage::Lights, fraction).await?;
        self.done += images.len();
        let size = self.view.size();
        let shape = [images.len(), size, size, LightInput::CHANNELS];
        let mut values = vec![0.0; shape.iter().product()];
        let outs = values.chunks_exact_mut(size * size * LightInput::CHANNELS);
        for (out, image) in outs.zip(images) {
            self.view.image(self.stack, image, self.mirrored, out);
        }
        let data = TensorData::new(values, shape);
        Ok(Tensor::from_data(data, &self.loaded.device))
    }
}

/// Waits for a tensor's values; works in browsers too.
pub(crate) async fn read_back<const D: usize>(tensor: Tensor<D>) -> Result<Vec<f32>, ModelError> {
    let data = tensor
        .into_data_async()
        .await
        .map_err(|error| ModelError::Device(format!("{error:?}")))?;
    data.convert::<f32>()
        .try_to_vec::<f32>()
        .map_err(|error| ModelError::Device(format!("{error:?}")))
}

/// Intensities divided by their mean.
fn relative(mut lights: Vec<Light>) -> Vec<Light> {
    let mean = lights.iter().map(Light::mean_intensity).sum::<f32>() / lights.len() as f32;
    for light in &mut lights {
        light.intensity = light.intensity.map(|value| value / mean);
    }
    lights
}
