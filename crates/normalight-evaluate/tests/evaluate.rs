//! Evaluation: the pipeline as users run it, compared with the truth.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::tensor::Device;
use normalight_core::{intensity_error, mean_light_error, normal_error};
use normalight_evaluate::{BenchmarkObject, EvaluateError, LightsFrom, evaluate_object};
use normalight_model::{
    EstimateInput, EstimateSettings, Estimator, LightArchitecture, LightNetwork, ModelError,
    NoopObserver, NormalArchitecture, NormalNetwork, Observer, Progress, Weights,
};
use normalight_synth::{Framing, Renderer, SceneRecipe};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// Untrained networks: how good they are does not matter here.
fn estimator() -> Estimator {
    let device = Device::flex();
    device.seed(3);
    let notes = BTreeMap::new();
    let (light, normal) = (LightArchitecture::plain(), NormalArchitecture::plain());
    let network = LightNetwork::new(&light, false, &device).unwrap();
    let light = Weights::light_bytes(&light, &network, &notes).unwrap();
    let network = NormalNetwork::new(&normal, false, &device).unwrap();
    let normal = Weights::normal_bytes(&normal, &network, &notes).unwrap();
    let read = |bytes: &[u8]| Weights::from_bytes("untrained", bytes).unwrap();
    Estimator::new(&read(&light), &read(&normal), device).unwrap()
}

fn object() -> BenchmarkObject {
    let renderer = Renderer::new(SceneRecipe::default()).unwrap();
    let sample = renderer.sample(5, 4, 32, Framing::WholeObject);
    BenchmarkObject {
        name: "egg".to_owned(),
        stack: sample.to_stack().unwrap(),
        mask: sample.to_mask(),
        lights: sample.lights.clone(),
        normals: sample.to_normal_map(),
    }
}

struct Impatient;

impl Observer for Impatient {
    async fn report(&mut self, _progress: Progress) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

#[test]
fn figures_are_the_errors_of_the_pipeline() {
    let (estimator, object) = (estimator(), object());
    let settings = EstimateSettings::default();
    let mut quiet = NoopObserver;
    let estimated = estimator.estimate(
        EstimateInput {
            stack: &object.stack,
            mask: &object.mask,
            lights: None,
        },
        settings,
        &mut quiet,
    );
    let estimate = pollster::block_on(estimated).unwrap();
    let from = LightsFrom::Photographs;
    let found = evaluate_object(&estimator, &object, from, settings, &mut NoopObserver).unwrap();
    assert_eq!((found.name.as_str(), found.images), ("egg", 4));
    assert_eq!(found.pixels, object.mask.count());
    let figures = found.figures;
    let normals = normal_error(&estimate.normals, &object.normals, &object.mask).unwrap();
    let radians = figures.normal_degrees.to_radians() as f32;
    assert!((radians - normals.mean).abs() < 1e-5);
    assert_eq!(figures.under_30 as f32, normals.shares[2]);
    let angle = mean_light_error(&estimate.lights, &object.lights).unwrap();
    let radians = figures.light_degrees.unwrap().to_radians() as f32;
    assert!((radians - angle).abs() < 1e-5);
    let intensity = intensity_error(&estimate.lights, &object.lights).unwrap();
    assert_eq!(figures.intensity_error.unwrap() as f32, intensity);
    assert!(figures.seconds > 0.0);
}

#[test]
fn true_lights_are_given_and_not_judged() {
    let (estimator, object) = (estimator(), object());
    let settings = EstimateSettings::default();
    let given = Some(object.lights.as_slice());
    let mut quiet = NoopObserver;
    let estimated = estimator.estimate(
        EstimateInput {
            stack: &object.stack,
            mask: &object.mask,
            lights: given,
        },
        settings,
        &mut quiet,
    );
    let estimate = pollster::block_on(estimated).unwrap();
    let from = LightsFrom::Truth;
    let found = evaluate_object(&estimator, &object, from, settings, &mut NoopObserver).unwrap();
    let normals = normal_error(&estimate.normals, &object.normals, &object.mask).unwrap();
    let radians = found.figures.normal_degrees.to_radians() as f32;
    assert!((radians - normals.mean).abs() < 1e-5);
    assert_eq!(found.figures.light_degrees, None);
    assert_eq!(found.figures.intensity_error, None);
}

#[test]
fn stopping_and_truth_that_does_not_fit() {
    let (estimator, mut object) = (estimator(), object());
    let settings = EstimateSettings::default();
    let from = LightsFrom::Photographs;
    let stopped = evaluate_object(&estimator, &object, from, settings, &mut Impatient);
    assert!(matches!(
        stopped,
        Err(EvaluateError::Model(ModelError::Cancelled))
    ));
    object.lights.pop();
    let misfit = evaluate_object(&estimator, &object, from, settings, &mut NoopObserver);
    assert!(matches!(misfit, Err(EvaluateError::Core(_))));
}
