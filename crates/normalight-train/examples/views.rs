//! Which views are worth their time, and what the confidence of a light is worth: errors on rendered
//! objects that no training has shown, by the shipped weights or others. The figures behind `Quality`.
//!
//!     cargo run --release -p normalight-train --example views -- SCENES.toml OBJECTS IMAGES [LIGHT NORMAL]

use burn::tensor::Device;
use normalight_core::{
    CalibratedStack, Decoding, Light, NormalMap, RefitSettings, Symmetry, Vec3, angle_between,
    intensity_error, mean_light_error, normal_error, refit_lights,
};
use normalight_model::{
    EstimateInput, EstimateSettings, Estimator, LightOptions, NoopObserver, PipelineStage, Quality,
    Weights, default_weights,
};
use normalight_synth::{Framing, Renderer, SceneRecipe};
use std::error::Error;
use std::path::Path;

/// Far from the numbers of training and of its validation.
const FIRST: u64 = 1 << 41;
const SIDE: usize = 128;

/// Sets of views, as positions in [`Symmetry::ALL`].
const SETS: [(&str, &[usize]); 9] = [
    ("one", &[0]),
    ("left-right", &[0, 1]),
    ("up-down", &[0, 2]),
    ("half turn", &[0, 3]),
    ("transposed", &[0, 4]),
    ("four mirrorings", &[0, 1, 2, 3]),
    ("four turns", &[0, 3, 5, 6]),
    ("turned and mirrored", &[0, 3, 4, 7]),
    ("all eight", &[0, 1, 2, 3, 4, 5, 6, 7]),
];
/// The whole of them.
const EIGHT: usize = SETS.len() - 1;

/// With which lights normals are estimated.
const LIGHTS: [&str; 5] = [
    "true",
    "one view",
    "mirrored",
    "refit to one",
    "refit to eight",
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scenes, objects, images, weights @ ..] = &arguments[..] else {
        return Err("usage: views SCENES.toml OBJECTS IMAGES [LIGHT NORMAL]".into());
    };
    let recipe = SceneRecipe::from_toml(Path::new(scenes), &std::fs::read_to_string(scenes)?)?;
    let renderer = Renderer::new(recipe)?;
    let (objects, images): (u64, usize) = (objects.parse()?, images.parse()?);
    let read = |name: &String| -> Result<Weights, Box<dyn Error>> {
        Ok(Weights::from_bytes(name, &std::fs::read(name)?)?)
    };
    let [light, normal] = match weights {
        [] => default_weights()?,
        [light, normal] => [read(light)?, read(normal)?],
        _ => return Err("weights of both networks or of none".into()),
    };
    let device = Device::flex();
    let object = |number| renderer.sample(number, images, SIDE, Framing::WholeObject);
    let estimator = Estimator::new(&light, &normal, device.clone())?;
    println!("{objects} objects, {images} images\n\nquality  normals, degrees  lights, degrees");
    for quality in Quality::ALL {
        let settings = EstimateSettings {
            quality,
            ..EstimateSettings::default()
        };
        let mut degrees = [0.0; 2];
        for number in FIRST..FIRST + objects {
            let sample = object(number);
            let (stack, mask, mut quiet) = (sample.to_stack()?, sample.to_mask(), NoopObserver);
            let input = EstimateInput {
                stack: &stack,
                mask: &mask,
                lights: None,
            };
            let estimate = estimator.estimate(input, settings, &mut quiet);
            let found = pollster::block_on(estimate)?;
            let normals = normal_error(&found.normals, &sample.to_normal_map(), &mask)?;
            degrees[0] += normals.mean.to_degrees() / objects as f32;
            let lights = mean_light_error(&found.lights, &sample.lights)?;
            degrees[1] += lights.to_degrees() / objects as f32;
        }
        println!("{:8}{:17.3}{:17.3}", quality.name(), degrees[0], degrees[1]);
    }

    let light = light.light_network(&device)?;
    let normal = normal.normal_network(&device)?;

    let mut normal_degrees = [[0.0; LIGHTS.len()]; SETS.len()];
    let mut light_errors = [[0.0; 2]; LIGHTS.len()];
    let mut confidences = [Vec::new(), Vec::new()];
    for number in FIRST..FIRST + objects {
        let sample = object(number);
        let (stack, mask, truth) = (sample.to_stack()?, sample.to_mask(), sample.to_normal_map());
        let find_lights = |quality| {
            let options = LightOptions {
                decoding: Decoding::SoftArgmax,
                quality,
            };
            pollster::block_on(light.estimate(&stack, &mask, options, &mut NoopObserver))
        };
        let find_normals = |lights: &[Light], view: Symmetry| {
            let calibrated = CalibratedStack::new(&stack, &mask, lights)?;
            let stage = PipelineStage::Normals;
            let (views, mut quiet) = ([view], NoopObserver);
            let found = normal.estimate(calibrated, &views, stage, &mut quiet);
            pollster::block_on(found).map(|averaged| averaged.normals)
        };
        let mut first: Option<[NormalMap; 2]> = None;
        let mut all_lights = vec![
            sample.lights.clone(),
            find_lights(Quality::Fast)?,
            find_lights(Quality::Best)?,
        ];
        for column in 0..LIGHTS.len() {
            if let Some([one, eight]) = &first
                && column >= 3
            {
                let to = if column == 3 { one } else { eight };
                let settings = RefitSettings::default();
                let refitted = refit_lights(&stack, &mask, to, &all_lights[2], settings)?;
                all_lights.push(refitted);
            }
            let lights = &all_lights[column];
            let views = Symmetry::ALL.map(|view| find_normals(lights, view));
            let views = views.into_iter().collect::<Result<Vec<_>, _>>()?;
            for ((_, set), degrees) in SETS.iter().zip(&mut normal_degrees) {
                let error = normal_error(&mean(&views, set), &truth, &mask)?;
                degrees[column] += error.mean.to_degrees() / objects as f32;
            }
            let [angle, intensity] = &mut light_errors[column];
            *angle += mean_light_error(lights, &sample.lights)?.to_degrees() / objects as f32;
            *intensity += intensity_error(lights, &sample.lights)? / objects as f32;
            if column == 2 {
                first = Some([SETS[0].1, SETS[EIGHT].1].map(|set| mean(&views, set)));
            }
        }
        for (pairs, lights) in confidences.iter_mut().zip(&all_lights[1..3]) {
            pairs.extend(lights.iter().zip(&sample.lights).map(|(light, truth)| {
                let error = angle_between(light.direction, truth.direction).to_degrees();
                (light.confidence, error)
            }));
        }
    }

    println!("\nnormals, degrees, by the lights");
    println!(
        "{:20}{}",
        "views",
        LIGHTS.map(|name| format!("{name:>16}")).concat()
    );
    for ((name, _), degrees) in SETS.iter().zip(normal_degrees) {
        println!(
            "{name:20}{}",
            degrees.map(|value| format!("{value:16.3}")).concat()
        );
    }
    for (k, name) in ["lights, degrees", "intensities"].iter().enumerate() {
        println!(
            "{name:20}{}",
            light_errors.map(|e| format!("{:16.3}", e[k])).concat()
        );
    }
    for (name, mut pairs) in ["one view", "mirrored"].into_iter().zip(confidences) {
        println!("\nlights by confidence, {name}: confidence, error that its spread means, error");
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for part in pairs.chunks(pairs.len().div_ceil(8)) {
            let count = part.len() as f32;
            let confidence = part.iter().map(|pair| pair.0).sum::<f32>() / count;
            let error = part.iter().map(|pair| pair.1).sum::<f32>() / count;
            println!("{confidence:8.3}{:8.2}{error:8.2}", stated(confidence));
        }
    }
    Ok(())
}

/// Mean of the normals of some views.
fn mean(views: &[NormalMap], set: &[usize]) -> NormalMap {
    let (width, height) = (views[0].width(), views[0].height());
    let sum = |pixel: usize| -> Vec3 { set.iter().map(|&view| views[view].normals()[pixel]).sum() };
    let normals = (0..width * height).map(|pixel| sum(pixel).normalize_or_zero());
    NormalMap::new(width, height, normals.collect())
}

/// Mean error in degrees of a light whose angles spread by `1 - confidence` of a uniform distribution's
/// deviation (180 degrees over the root of 12): the mean distance from the middle of a normal
/// distribution in two dimensions.
fn stated(confidence: f32) -> f32 {
    let deviation = (1.0 - confidence) * 180.0 / 12.0f32.sqrt();
    deviation * std::f32::consts::FRAC_PI_2.sqrt()
}
