use crate::observer::{Observer, Progress, Stage};
use crate::{LightArchitecture, LightNetwork, LightView, ModelError};
use burn::tensor::{Device, Tensor, TensorData, activation};
use normalight_core::{Decoding, ImageStack, Light, Mask};
use std::ops::ControlFlow;

/// Images that go through the network together: bounds the memory, whatever the size of the stack.
const BATCH: usize = 16;

/// Estimates the light of every image: one pass for the maximum of the features over the images,
/// one to classify each image against it.
///
/// Intensities come back relative to their mean.
///
/// # Errors
/// [`ModelError::Cancelled`] or [`ModelError::Device`].
pub async fn estimate_lights(
    architecture: &LightArchitecture,
    network: &LightNetwork,
    stack: &ImageStack,
    mask: &Mask,
    decoding: Decoding,
    device: &Device,
    observer: &mut impl Observer,
) -> Result<Vec<Light>, ModelError> {
    let view = LightView::new(stack, mask, architecture.input_size);
    let count = stack.len();
    let mut done = 0;
    let mut fused: Option<Tensor<4>> = None;
    for first in (0..count).step_by(BATCH) {
        let images = first..count.min(first + BATCH);
        report(observer, done as f32 / (2 * count) as f32).await?;
        done += images.len();
        let most = network
            .features(view_batch(&view, stack, images, device))
            .max_dim(0);
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
        report(observer, done as f32 / (2 * count) as f32).await?;
        done += images.len();
        let own = network.features(view_batch(&view, stack, images, device));
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
    report(observer, 1.0).await?;
    Ok(relative(lights))
}

async fn report(observer: &mut impl Observer, fraction: f32) -> Result<(), ModelError> {
    let progress = Progress {
        stage: Stage::Lights,
        fraction,
    };
    match observer.report(progress).await {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(ModelError::Cancelled),
    }
}

/// # Shapes
/// `[images, size, size, 4]`
fn view_batch(
    view: &LightView,
    stack: &ImageStack,
    images: std::ops::Range<usize>,
    device: &Device,
) -> Tensor<4> {
    let area = view.size() * view.size();
    let mut planes = vec![0.0; 4 * area];
    let mut values = vec![0.0; images.len() * 4 * area];
    let shape = [images.len(), view.size(), view.size(), 4];
    for (out, image) in values.chunks_exact_mut(4 * area).zip(images) {
        view.image(stack, image, &mut planes);
        for (channel, plane) in planes.chunks_exact(area).enumerate() {
            for (pixel, value) in out.chunks_exact_mut(4).zip(plane) {
                pixel[channel] = *value;
            }
        }
    }
    Tensor::from_data(TensorData::new(values, shape), device)
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
