//! Evaluation: the pipeline as users run it, compared with the truth.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use burn::tensor::Device;
use normalight_core::{
    ImageStack, Light, Mask, NormalMap, Samples, StackImage, Transfer, Vec3, intensity_error,
    mean_light_error, normal_error,
};
use normalight_evaluate::{BenchmarkObject, EvaluateError, Method, evaluate_object};
use normalight_model::{
    EstimateInput, EstimateSettings, Estimator, LightArchitecture, LightNetwork, ModelError,
    NoopObserver, NormalArchitecture, NormalNetwork, Observer, Progress, Weights, light_cost,
    normal_cost,
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
        lights: Some(sample.lights.clone()),
        normals: Some(sample.to_normal_map()),
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
    let method = Method::Uncalibrated;
    let measured =
        evaluate_object(&estimator, &object, method, settings, &mut NoopObserver).unwrap();
    assert_eq!(measured.normals, estimate.normals);
    assert_eq!(measured.lights.as_ref(), Some(&estimate.lights));
    let found = measured.figures;
    assert_eq!((found.name.as_str(), found.images), ("egg", 4));
    assert_eq!(found.pixels, object.mask.count());
    let figures = found.figures;
    let truth = object.normals.as_ref().unwrap();
    let normals = normal_error(&estimate.normals, truth, &object.mask).unwrap();
    let radians = figures.normal_degrees().unwrap().to_radians() as f32;
    assert!((radians - normals.mean).abs() < 1e-5);
    assert_eq!(figures.normals.unwrap().under_30 as f32, normals.shares[2]);
    let lights = object.lights.as_ref().unwrap();
    let angle = mean_light_error(&estimate.lights, lights).unwrap();
    let radians = figures.light_degrees.unwrap().to_radians() as f32;
    assert!((radians - angle).abs() < 1e-5);
    let intensity = intensity_error(&estimate.lights, lights).unwrap();
    assert_eq!(figures.intensity_error.unwrap() as f32, intensity);
    assert!(figures.seconds > 0.0);
    // Two passes of the light network over two views; the normal network before the refit, and over four views after it.
    let lights = 2 * 2 * light_cost(&LightArchitecture::plain()).multiply_adds(4);
    let normals = 5 * normal_cost(&NormalArchitecture::plain(), 32 * 32).multiply_adds(4);
    assert_eq!(figures.multiply_adds, Some((lights + normals) as f64));
}

#[test]
fn true_lights_are_given_and_not_judged() {
    let (estimator, object) = (estimator(), object());
    let settings = EstimateSettings::default();
    let given = object.lights.as_deref();
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
    let method = Method::Calibrated;
    let measured =
        evaluate_object(&estimator, &object, method, settings, &mut NoopObserver).unwrap();
    assert_eq!(measured.lights, None);
    let found = measured.figures;
    let truth = object.normals.as_ref().unwrap();
    let normals = normal_error(&estimate.normals, truth, &object.mask).unwrap();
    let radians = found.figures.normal_degrees().unwrap().to_radians() as f32;
    assert!((radians - normals.mean).abs() < 1e-5);
    // Every pixel is in one class of expected errors.
    let shares = found.reliability.iter().map(|class| class.share);
    assert!((shares.sum::<f64>() - 1.0).abs() < 1e-9);
    let means = found.reliability.iter();
    let mean: f64 = means.map(|class| class.share * class.found_degrees).sum();
    assert!((mean - found.figures.normal_degrees().unwrap()).abs() < 1e-3);
    assert_eq!(found.figures.light_degrees, None);
    assert_eq!(found.figures.intensity_error, None);
}

#[test]
fn stopping_and_truth_that_does_not_fit() {
    let (estimator, mut object) = (estimator(), object());
    let settings = EstimateSettings::default();
    let method = Method::Uncalibrated;
    let stopped = evaluate_object(&estimator, &object, method, settings, &mut Impatient);
    assert!(matches!(
        stopped,
        Err(EvaluateError::Model(ModelError::Cancelled))
    ));
    object.lights.as_mut().unwrap().pop();
    let misfit = evaluate_object(&estimator, &object, method, settings, &mut NoopObserver);
    assert!(matches!(misfit, Err(EvaluateError::Core(_))));
}

/// Benchmarks keep truth back, and near lamps have no one direction: what there is, is compared.
#[test]
fn what_is_known_is_compared() {
    let ball = matte_ball();
    let measure = |object: &BenchmarkObject, method| {
        let settings = EstimateSettings::default();
        evaluate_object(&estimator(), object, method, settings, &mut NoopObserver)
    };
    let whole = measure(&ball, Method::Factorisation).unwrap();
    let withheld = BenchmarkObject {
        normals: None,
        ..ball.reduced_to(40).unwrap()
    };
    let found = measure(&withheld, Method::Factorisation).unwrap().figures;
    assert_eq!(found.figures.normals, None);
    assert!(found.figures.light_degrees.unwrap() < 3.0);
    assert_eq!(
        (found.pixels, found.without_truth),
        (0, withheld.mask.count())
    );
    assert!(withheld.reduced_to(20).unwrap().normals.is_none());
    let near = BenchmarkObject {
        lights: None,
        ..ball
    };
    let found = measure(&near, Method::Factorisation)
        .unwrap()
        .figures
        .figures;
    assert_eq!(found.normals, whole.figures.figures.normals);
    assert_eq!((found.light_degrees, found.intensity_error), (None, None));
    assert!(near.with_photographs(&[0, 1, 2]).unwrap().lights.is_none());
    for method in [Method::Calibrated, Method::LeastSquares, Method::Robust] {
        let refused = measure(&near, method);
        assert!(
            matches!(refused, Err(EvaluateError::NoLights)),
            "{method:?}"
        );
    }
}

/// Errors of a method in degrees: normals, and lights where it finds them.
fn degrees(object: &BenchmarkObject, method: Method) -> (f64, Option<f64>) {
    let settings = EstimateSettings::default();
    let measured =
        evaluate_object(&estimator(), object, method, settings, &mut NoopObserver).unwrap();
    let figures = measured.figures.figures;
    (figures.normal_degrees().unwrap(), figures.light_degrees)
}

/// A ball of one matte colour under lamps all around, without shadows of its own making: Lambert's law alone.
fn matte_ball() -> BenchmarkObject {
    let side = 48;
    let normal = |pixel: usize| {
        let place = |at: usize| (at as f32 + 0.5) * 2.0 / side as f32 - 1.0;
        let (x, y) = (place(pixel % side) * 1.1, -place(pixel / side) * 1.1);
        let z = 1.0 - x * x - y * y;
        (z > 0.0).then(|| Vec3::new(x, y, z.sqrt()))
    };
    let normals: Vec<Option<Vec3>> = (0..side * side).map(normal).collect();
    let lights: Vec<Light> = (0..96)
        .map(|k| {
            let (turn, steep) = (k as f32 * 2.399_963, (k as f32 + 0.5) / 96.0 * 0.7);
            let direction = Vec3::new(turn.cos() * steep, turn.sin() * steep, 1.0).normalize();
            Light::new(direction, 0.6 + 0.01 * k as f32)
        })
        .collect();
    let image = |(index, light): (usize, &Light)| {
        let value = |normal: &Option<Vec3>| {
            let shade = normal.map_or(0.0, |normal| normal.dot(light.direction).max(0.0));
            0.5 * shade * light.intensity[0]
        };
        StackImage {
            name: format!("{index}.png"),
            width: side,
            height: side,
            channels: 1,
            samples: Samples::F32(normals.iter().map(value).collect()),
            transfer: Transfer::Linear,
        }
    };
    BenchmarkObject {
        name: "ball".to_owned(),
        stack: ImageStack::new(lights.iter().enumerate().map(image).collect()).unwrap(),
        mask: Mask::new(side, side, normals.iter().map(Option::is_some).collect()),
        normals: Some(NormalMap::new(
            side,
            side,
            normals
                .iter()
                .map(|normal| normal.unwrap_or_default())
                .collect(),
        )),
        lights: Some(lights),
    }
}

#[test]
fn classical_methods_solve_a_matte_ball() {
    let ball = matte_ball();
    let (normals, lights) = degrees(&ball, Method::Factorisation);
    assert!(
        normals < 3.0 && lights.unwrap() < 3.0,
        "{normals} {lights:?}"
    );
    for method in [Method::LeastSquares, Method::Robust] {
        let (normals, lights) = degrees(&ball, method);
        // Least squares is wrong where an attached shadow cuts a cosine off.
        assert!(normals < 2.0 && lights.is_none(), "{method:?}: {normals}");
    }
    // An untrained network finds other lights than the true ones: that must show, and be the same by what it found before.
    let estimator = estimator();
    let measure = |method| {
        let settings = EstimateSettings::default();
        evaluate_object(&estimator, &ball, method, settings, &mut NoopObserver).unwrap()
    };
    let guessed = measure(Method::EstimatedLeastSquares).figures.figures;
    assert!(guessed.normal_degrees().unwrap() > 2.0 && guessed.light_degrees.unwrap() > 2.0);
    let again = measure(Method::Uncalibrated)
        .with_least_squares(&ball)
        .unwrap();
    assert_eq!(again.figures.figures.normals, guessed.normals);
    assert_eq!(again.figures.figures.light_degrees, guessed.light_degrees);
}

#[test]
fn fewer_photographs_and_fewer_pixels() {
    let ball = matte_ball();
    let some = ball.with_photographs(&[3, 50, 7]).unwrap();
    assert_eq!(some.stack.images()[1].name, "50.png");
    let lights = ball.lights.as_ref().unwrap();
    assert_eq!(some.lights.unwrap(), [lights[3], lights[50], lights[7]]);
    assert!(matches!(
        ball.with_photographs(&[1]),
        Err(EvaluateError::Core(_))
    ));
    let small = ball.reduced_to(16).unwrap();
    assert_eq!(small.stack.width().max(small.stack.height()), 16);
    assert!(degrees(&small, Method::LeastSquares).0 < 2.0);
    let same = ball.reduced_to(64).unwrap();
    assert_eq!(same.stack.width(), ball.stack.width());
}
