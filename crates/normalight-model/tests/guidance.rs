//! A guided light network: what it is shown, and that nothing else changes.

use burn::tensor::{Device, Distribution, Tensor};
use normalight_core::{
    CoreError, Decoding, ImageStack, Light, Mask, NormalMap, Samples, StackImage, Transfer, Vec3,
};
use normalight_model::{
    Architecture, EstimateSettings, Estimator, Known, LightArchitecture, LightNetwork, LightView,
    ModelError, Progress, Quiet, SecondPass, Stage, Weights, default_weights, estimate_lights,
};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

const SIDE: usize = 320;

fn guided() -> LightArchitecture {
    LightArchitecture {
        guided: true,
        ..LightArchitecture::plain()
    }
}

/// The normal of a unit sphere at a place of its picture.
fn sphere(x: f32, y: f32) -> Option<Vec3> {
    let square = 1.0 - x * x - y * y;
    (square > 0.0).then(|| Vec3::new(x, y, square.sqrt()))
}

struct Scene {
    stack: ImageStack,
    mask: Mask,
    normals: NormalMap,
    lights: Vec<Light>,
}

/// A matt sphere under lights of different brightness.
fn scene() -> Scene {
    let at = |index: usize| {
        let place = |k: usize| (k as f32 + 0.5) / (SIDE as f32 / 2.0) - 1.0;
        sphere(place(index % SIDE), -place(index / SIDE))
    };
    let lights: Vec<Light> = (0..5)
        .map(|k| {
            let turn = k as f32 * 1.3;
            let direction = Vec3::new(0.6 * turn.cos(), 0.6 * turn.sin(), 0.8);
            Light::new(direction, 0.5 + 0.2 * k as f32)
        })
        .collect();
    let image = |light: &Light| StackImage {
        name: "sphere".into(),
        width: SIDE,
        height: SIDE,
        channels: 1,
        samples: Samples::F32(
            (0..SIDE * SIDE)
                .map(|index| at(index).map_or(0.0, |n| n.dot(light.direction).max(0.0)))
                .map(|shading| shading * light.mean_intensity())
                .collect(),
        ),
        transfer: Transfer::Linear,
    };
    let inside = (0..SIDE * SIDE).map(|index| at(index).is_some()).collect();
    let normals = (0..SIDE * SIDE).map(|index| at(index).unwrap_or_default());
    Scene {
        stack: ImageStack::new(lights.iter().map(image).collect()).unwrap(),
        mask: Mask::new(SIDE, SIDE, inside),
        normals: NormalMap::new(SIDE, SIDE, normals.collect()),
        lights,
    }
}

#[test]
fn guidance_is_what_a_white_sphere_would_look_like() {
    let scene = scene();
    let size = 32;
    let view = LightView::new(&scene.stack, &scene.mask, size);
    let guidance = view.guidance(Known {
        normals: &scene.normals,
        lights: &scene.lights,
    });
    // The mean intensity of the five lights.
    let mean = 0.9;
    let (mut compared, mut outside) = (0, 0);
    for pixel in 0..size * size {
        // The view has a margin of 4 %.
        let place = |k: usize| ((k as f32 + 0.5) / size as f32 * 2.0 - 1.0) / 0.92;
        let (x, y) = (place(pixel % size), -place(pixel / size));
        let distance = x.hypot(y);
        for (image, light) in scene.lights.iter().enumerate() {
            let [nx, ny, nz, shading] = guidance.channels(image, pixel);
            if distance < 0.85 {
                let normal = sphere(x, y).unwrap();
                assert!((Vec3::new(nx, ny, nz) - normal).length() < 0.01);
                let white = normal.dot(light.direction).max(0.0) * light.mean_intensity() / mean;
                assert!((shading - white).abs() < 0.015, "{shading} {white}");
                compared += 1;
            } else if distance > 1.1 {
                assert_eq!([nx, ny, nz, shading], [0.0; 4]);
                outside += 1;
            }
        }
    }
    assert!(compared > 2000 && outside > 500, "{compared} {outside}");
}

fn scores(network: &LightNetwork, input: Tensor<4>) -> Tensor<2> {
    let own = network.features(input);
    let fused = own.clone().max_dim(0).expand(own.dims());
    network.classify(own, fused)
}

#[test]
fn a_widened_network_gives_the_same_answers() {
    let device = Device::flex();
    let [light, _] = default_weights().unwrap();
    let (_, network) = light.light_network(&device).unwrap();
    let wider = network.guided();
    let photographs = Tensor::<4>::random([3, 64, 64, 4], Distribution::Default, &device);
    let guidance = Tensor::<4>::random([3, 64, 64, 4], Distribution::Default, &device);
    let expected = scores(&network, photographs.clone());
    // Whatever is known: the new weights are zero.
    for known in [guidance.zeros_like(), guidance] {
        let input = Tensor::cat(vec![photographs.clone(), known], 3);
        let difference = (scores(&wider, input) - expected.clone()).abs().max();
        assert!(difference.into_scalar::<f32>() < 1e-4);
    }
    // And its file is one of a guided network.
    let bytes = Weights::light_bytes(&guided(), &wider, &BTreeMap::new()).unwrap();
    let read = Weights::from_bytes("guided", &bytes).unwrap();
    assert_eq!(*read.architecture(), Architecture::Light(guided()));
    read.light_network(&device).unwrap();
}

#[test]
fn architectures_without_guidance_are_written_as_before() {
    let plain = serde_json::to_string(&LightArchitecture::plain()).unwrap();
    assert!(!plain.contains("guided"), "{plain}");
    let read: LightArchitecture = serde_json::from_str(&plain).unwrap();
    assert!(!read.guided);
    let json = serde_json::to_string(&guided()).unwrap();
    assert_eq!(
        serde_json::from_str::<LightArchitecture>(&json).unwrap(),
        guided()
    );
}

#[test]
fn what_does_not_fit_is_refused() {
    let device = Device::flex();
    let scene = scene();
    let look = |architecture: &LightArchitecture, normals: &NormalMap, lights: &[Light]| {
        let network = LightNetwork::new(architecture, true, &device).unwrap();
        pollster::block_on(estimate_lights(
            architecture,
            &network,
            &scene.stack,
            &scene.mask,
            Some(Known { normals, lights }),
            Decoding::SoftArgmax,
            &device,
            &mut Quiet,
        ))
        .unwrap_err()
    };
    let other = NormalMap::new(SIDE, 2, vec![Vec3::Z; SIDE * 2]);
    let error = look(&guided(), &other, &scene.lights);
    assert!(
        matches!(
            error,
            ModelError::Core(CoreError::MapSize {
                found_height: 2,
                expected_height: SIDE,
                ..
            })
        ),
        "{error}"
    );
    let error = look(&guided(), &scene.normals, &scene.lights[1..]);
    assert!(
        matches!(
            error,
            ModelError::Core(CoreError::LightCount {
                found: 4,
                expected: 5
            })
        ),
        "{error}"
    );
    let plain = LightArchitecture::plain();
    let error = look(&plain, &scene.normals, &scene.lights);
    assert!(matches!(error, ModelError::Architecture { .. }), "{error}");
}

/// Notes the stages of a run.
#[derive(Default)]
struct Stages(Vec<Stage>);

impl normalight_model::Observer for Stages {
    async fn report(&mut self, progress: Progress) -> ControlFlow<()> {
        if self.0.last() != Some(&progress.stage) {
            self.0.push(progress.stage);
        }
        ControlFlow::Continue(())
    }
}

#[test]
fn a_guided_network_looks_again_and_another_is_refitted() {
    let device = Device::flex();
    let scene = scene();
    let [light, normal] = default_weights().unwrap();
    let network = LightNetwork::new(&guided(), true, &device).unwrap();
    let bytes = Weights::light_bytes(&guided(), &network, &BTreeMap::new()).unwrap();
    let looks_again = Weights::from_bytes("guided", &bytes).unwrap();
    let run = |light: &Weights, second_pass: bool, given: Option<&[Light]>| {
        let estimator = Estimator::new(light, &normal, device.clone()).unwrap();
        let settings = EstimateSettings {
            second_pass,
            ..EstimateSettings::default()
        };
        let mut stages = Stages::default();
        let estimate = estimator.estimate(&scene.stack, &scene.mask, given, settings, &mut stages);
        let lights = pollster::block_on(estimate).unwrap().lights;
        let pass = estimator.second_pass(&settings, given.is_some());
        (pass, stages.0, lights)
    };
    use Stage::*;
    let (pass, stages, lights) = run(&looks_again, true, None);
    assert_eq!(pass, Some(SecondPass::Guided));
    assert_eq!(stages, [Lights, Normals, FinalLights, FinalNormals, Albedo]);
    let (pass, stages, first) = run(&looks_again, false, None);
    assert_eq!(pass, None);
    assert_eq!(stages, [Lights, Normals, Albedo]);
    assert_ne!(lights, first);
    let (pass, stages, _) = run(&light, true, None);
    assert_eq!(pass, Some(SecondPass::Refit));
    assert_eq!(stages, [Lights, Normals, Refit, FinalNormals, Albedo]);
    let (pass, stages, _) = run(&looks_again, true, Some(&scene.lights));
    assert_eq!(pass, None);
    assert_eq!(stages, [Normals, Albedo]);
}
