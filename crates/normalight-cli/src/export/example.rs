//! An input of a network and what it makes of it: a rendered object, as the pipeline shows it to the network.
use anyhow::{Context, Result};
use burn::tensor::{Device, Tensor, TensorData};
use normalight_core::{Light, Rect};
use normalight_io::npy;
use normalight_kernels::channels_first;
use normalight_model::{
    LightInput, LightOptions, LightView, LoadedLightNetwork, LoadedNormalNetwork, NoopObserver,
    NormalInput,
};
use normalight_synth::{Framing, Renderer, Sample, SceneRecipe};

/// Photographs.
const IMAGES: usize = 6;

/// Their side in pixels.
const SIZE: usize = 56;

/// The part that the normal network sees: not square, so that rows and columns cannot change places unseen.
const PART: Rect = Rect {
    x: 4,
    y: 8,
    width: 48,
    height: 40,
};

/// Number of the object.
const SEED: u64 = 31;

/// Arrays by the names of their files.
type Files = Vec<(String, Vec<u8>)>;

/// For the light network.
pub(crate) fn light(loaded: &LoadedLightNetwork) -> Result<Files> {
    let sample = sample()?;
    let (stack, mask) = (sample.to_stack()?, sample.to_mask());
    let size = loaded.architecture.input_size;
    let view = LightView::new(&stack, &mask, size);
    let shape = [IMAGES, size, size, LightInput::CHANNELS];
    let input = input(shape, &loaded.device, |image, out| {
        view.image(&stack, image, false, out);
    });
    let own = loaded.network.features(input.clone());
    let fused = own.clone().max_dim(0).expand(own.dims());
    let scores = loaded.network.classify(own, fused);
    let mut observer = NoopObserver;
    let estimate = loaded.estimate(&stack, &mask, LightOptions::FAST, &mut observer);
    let lights = pollster::block_on(estimate)?;
    let directions = lights.iter().flat_map(|light| light.direction.to_array());
    let intensities = lights.iter().map(Light::mean_intensity);
    Ok(vec![
        file("images", channels_first(input))?,
        array("directions", &[IMAGES, 3], directions)?,
        array("intensities", &[IMAGES], intensities)?,
        file("scores", scores)?,
    ])
}

/// For the normal network, under true lights.
pub(crate) fn normal(loaded: &LoadedNormalNetwork) -> Result<Files> {
    let sample = sample()?;
    let (stack, mask) = (sample.to_stack()?, sample.to_mask());
    let inside = (0..PART.area()).map(|index| {
        let (x, y) = (PART.x + index % PART.width, PART.y + index / PART.width);
        mask.inside()[y * SIZE + x]
    });
    let mask_channel = loaded.architecture.mask_channel;
    let read = |image: usize, planes: &mut [f32]| stack.linear_tile(image, PART, planes);
    let encoder = NormalInput::new(mask_channel, inside.collect(), &sample.lights, read);
    let shape = [IMAGES, PART.height, PART.width, encoder.channel_count()];
    let mut planes = vec![0.0; 3 * PART.area()];
    let input = input(shape, &loaded.device, |image, out| {
        stack.linear_tile(image, PART, &mut planes);
        encoder.encode(&planes, &sample.lights[image], |pixel| pixel, out);
    });
    let fused = loaded.network.fuse(input.clone(), 1);
    let normals = loaded.network.regress(fused);
    Ok(vec![
        file("images", channels_first(input))?,
        file("normals", channels_first(normals))?,
    ])
}

fn sample() -> Result<Sample> {
    let renderer = Renderer::new(SceneRecipe::default())?;
    Ok(renderer.sample(SEED, IMAGES, SIZE, Framing::WholeObject))
}

/// What `write` makes of each image.
///
/// # Shapes
/// - shape: `[images, height, width, channels]`
fn input(
    shape: [usize; 4],
    device: &Device,
    mut write: impl FnMut(usize, &mut [f32]),
) -> Tensor<4> {
    let mut values = vec![0.0; shape.iter().product()];
    let outs = values.chunks_exact_mut(shape[1..].iter().product());
    for (image, out) in outs.enumerate() {
        write(image, out);
    }
    Tensor::from_data(TensorData::new(values, shape), device)
}

fn file<const D: usize>(name: &'static str, tensor: Tensor<D>) -> Result<(String, Vec<u8>)> {
    let shape = tensor.dims();
    let values = tensor.into_data().try_to_vec::<f32>();
    let values = values.ok().context("the processor gave no numbers")?;
    array(name, &shape, values.into_iter())
}

fn array(
    name: &'static str,
    shape: &[usize],
    values: impl Iterator<Item = f32>,
) -> Result<(String, Vec<u8>)> {
    let shape: Vec<u64> = shape.iter().map(|&side| side as u64).collect();
    Ok((format!("{name}.npy"), npy(name, &shape, values)?))
}
