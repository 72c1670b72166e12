use crate::observer::{Observer, Progress, Stage};
use crate::{Guidance, Known, LightArchitecture, LightNetwork, LightView, ModelError};
use burn::tensor::{Device, Tensor, TensorData, activation};
use normalight_core::{CoreError, Decoding, ImageStack, Light, Mask};
use std::ops::{ControlFlow, Range};

/// Images that go through the network together: bounds the memory, whatever the size of the stack.
const BATCH: usize = 16;

/// Estimates the light of every image: one pass for the maximum of the features over the images,
/// one to classify each image against it.
///
/// `known`: normals and lights estimated before, for one more look of a guided network.
///
/// Intensities come back relative to their mean.
///
/// # Errors
/// [`ModelError::Cancelled`] or [`ModelError::Device`]; [`ModelError::Architecture`] when something is known and
/// the network is not guided, [`ModelError::Core`] when it does not fit the stack.
#[expect(
    clippy::too_many_arguments,
    reason = "one call site per stage, all needed"
)]
pub async fn estimate_lights(
    architecture: &LightArchitecture,
    network: &LightNetwork,
    stack: &ImageStack,
    mask: &Mask,
    known: Option<Known<'_>>,
    decoding: Decoding,
    device: &Device,
    observer: &mut impl Observer,
) -> Result<Vec<Light>, ModelError> {
    let mut look = Look {
        view: LightView::new(stack, mask, architecture.input_size),
        stack,
        channels: architecture.input_channels(),
        guidance: None,
        device,
    };
    let mut stage = Stage::Lights;
    if let Some(known) = known {
        check_known(architecture, stack, known)?;
        look.guidance = Some(look.view.guidance(known));
        stage = Stage::FinalLights;
    }
    let count = stack.len();
    let mut done = 0;
    let mut fused: Option<Tensor<4>> = None;
    for first in (0..count).step_by(BATCH) {
        let images = first..count.min(first + BATCH);
        report(observer, stage, done as f32 / (2 * count) as f32).await?;
        done += images.len();
        let most = network.features(look.batch(images)).max_dim(0);
        fused = Some(match fused {
            Some(before) => before.max_pair(most),
            None => most,
        });
    }
    let Some(fused) = fused else {
        return Ok(Vec::new());
    };
    let bins = &architecture.bins;
    let (azimuths, elevations) = (bins.azimuth, bins.elevation);
    let mut lights = Vec::with_capacity(count);
    for first in (0..count).step_by(BATCH) {
        let images = first..count.min(first + BATCH);
        report(observer, stage, done as f32 / (2 * count) as f32).await?;
        done += images.len();
        let own = network.features(look.batch(images));
        let together = fused.clone().expand(own.dims());
        let scores = network.classify(own, together);
        let [rows, classes] = scores.dims();
        let softmax = |from: usize, to: usize| {
            activation::softmax(scores.clone().slice([0..rows, from..to]), 1)
        };
        let probabilities = Tensor::cat(
            vec![
                softmax(0, azimuths),
                softmax(azimuths, azimuths + elevations),
                softmax(azimuths + elevations, classes),
            ],
            1,
        );
        let values = read_back(probabilities).await?;
        lights.extend(values.chunks_exact(classes).map(|row| {
            let (azimuth, rest) = row.split_at(azimuths);
            let (elevation, intensity) = rest.split_at(elevations);
            bins.decode(azimuth, elevation, intensity, decoding)
        }));
    }
    report(observer, stage, 1.0).await?;
    Ok(relative(lights))
}

async fn report(
    observer: &mut impl Observer,
    stage: Stage,
    fraction: f32,
) -> Result<(), ModelError> {
    let progress = Progress { stage, fraction };
    match observer.report(progress).await {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(ModelError::Cancelled),
    }
}

/// Whether what is known fits network and stack.
fn check_known(
    architecture: &LightArchitecture,
    stack: &ImageStack,
    known: Known<'_>,
) -> Result<(), ModelError> {
    if !architecture.guided {
        return Err(ModelError::Architecture {
            what: "guided".into(),
            found: "false".into(),
            expected: "true, for another look at lights".into(),
        });
    }
    if known.lights.len() != stack.len() {
        return Err(ModelError::Core(CoreError::LightCount {
            found: known.lights.len(),
            expected: stack.len(),
        }));
    }
    let found = (known.normals.width(), known.normals.height());
    if found != (stack.width(), stack.height()) {
        return Err(ModelError::Core(CoreError::MapSize {
            found_width: found.0,
            found_height: found.1,
            expected_width: stack.width(),
            expected_height: stack.height(),
        }));
    }
    Ok(())
}

/// One look of the network at all photographs.
struct Look<'a> {
    view: LightView,
    stack: &'a ImageStack,
    /// Input channels of the network.
    channels: usize,
    guidance: Option<Guidance>,
    device: &'a Device,
}

impl Look<'_> {
    /// What the network sees of some images.
    ///
    /// # Shapes
    /// `[images, size, size, channels]`
    fn batch(&self, images: Range<usize>) -> Tensor<4> {
        let area = self.view.size() * self.view.size();
        let mut planes = vec![0.0; 4 * area];
        let mut values = vec![0.0; images.len() * self.channels * area];
        let shape = [
            images.len(),
            self.view.size(),
            self.view.size(),
            self.channels,
        ];
        for (out, image) in values.chunks_exact_mut(self.channels * area).zip(images) {
            self.view.image(self.stack, image, &mut planes);
            for (pixel, out) in out.chunks_exact_mut(self.channels).enumerate() {
                let (photograph, rest) = out.split_at_mut(4);
                for (channel, value) in photograph.iter_mut().enumerate() {
                    *value = planes[channel * area + pixel];
                }
                // Nothing is known at the first look.
                if let Some(guidance) = &self.guidance {
                    rest.copy_from_slice(&guidance.channels(image, pixel));
                }
            }
        }
        Tensor::from_data(TensorData::new(values, shape), self.device)
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
