//! Does what the program says of its own doubt predict its errors? Rendered objects that no training has shown, whole
//! pipeline, the shipped weights: the figures behind [`normalight_core::expected_normal_error`].
//!
//!     cargo run --release -p normalight-train --example reliability -- SCENES.toml OBJECTS IMAGES...

use burn::tensor::Device;
use normalight_core::{EstimateSettings, Quality, angle_between, expected_light_error};
use normalight_model::{EstimateInput, Estimator, NoopObserver, default_weights};
use normalight_synth::{Framing, Renderer, SceneRecipe};
use std::error::Error;
use std::path::Path;

/// Far from the numbers of training, of its validation and of `views`.
const FIRST: u64 = 1 << 42;
const SIDE: usize = 128;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scenes, objects, images @ ..] = &arguments[..] else {
        return Err("usage: reliability SCENES.toml OBJECTS IMAGES...".into());
    };
    let recipe = SceneRecipe::from_toml(Path::new(scenes), &std::fs::read_to_string(scenes)?)?;
    let renderer = Renderer::new(recipe)?;
    let objects: u64 = objects.parse()?;
    let [light, normal] = default_weights()?;
    let estimator = Estimator::new(&light, &normal, Device::flex())?;
    for images in images {
        let images: usize = images.parse()?;
        for quality in [Quality::Default, Quality::Best] {
            let settings = EstimateSettings {
                quality,
                ..EstimateSettings::default()
            };
            let (mut pixels, mut lights) = (Vec::new(), Vec::new());
            for number in FIRST..FIRST + objects {
                let sample = renderer.sample(number, images, SIDE, Framing::WholeObject);
                let (stack, mask) = (sample.to_stack()?, sample.to_mask());
                let input = EstimateInput {
                    stack: &stack,
                    mask: &mask,
                    lights: None,
                };
                let found =
                    pollster::block_on(estimator.estimate(input, settings, &mut NoopObserver))?;
                let expected = found.normal_errors.as_deref().ok_or("one view only")?;
                let truth = sample.to_normal_map();
                let (found_normals, truth) = (found.normals.normals(), truth.normals());
                pixels.extend(mask.pixels().into_iter().map(|pixel| {
                    let error = angle_between(found_normals[pixel], truth[pixel]);
                    (expected[pixel], error.to_degrees())
                }));
                lights.extend(
                    found
                        .lights
                        .iter()
                        .zip(&sample.lights)
                        .map(|(light, truth)| {
                            let error = angle_between(light.direction, truth.direction);
                            (expected_light_error(light.confidence), error.to_degrees())
                        }),
                );
            }
            println!("\n{objects} objects, {images} images, {}", quality.name());
            table("normals: expected, error", pixels);
            table("lights: expected, error", lights);
        }
    }
    Ok(())
}

/// Mean error by tenths of what was said, and how well the order agrees.
fn table(title: &str, mut pairs: Vec<(f32, f32)>) {
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    println!("{title}; rank correlation {:.3}", rank_correlation(&pairs));
    for part in pairs.chunks(pairs.len().div_ceil(10)) {
        let mean =
            |value: fn(&(f32, f32)) -> f32| part.iter().map(value).sum::<f32>() / part.len() as f32;
        println!("{:8.3}{:8.2}", mean(|pair| pair.0), mean(|pair| pair.1));
    }
}

/// Spearman's, of pairs sorted by the first.
fn rank_correlation(pairs: &[(f32, f32)]) -> f64 {
    let mut order: Vec<usize> = (0..pairs.len()).collect();
    order.sort_by(|&a, &b| pairs[a].1.total_cmp(&pairs[b].1));
    let count = pairs.len() as f64;
    let squares: f64 = order
        .iter()
        .enumerate()
        .map(|(rank, &place)| (rank as f64 - place as f64).powi(2))
        .sum();
    1.0 - 6.0 * squares / (count * (count * count - 1.0))
}
