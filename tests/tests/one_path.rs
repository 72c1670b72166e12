//! The golden stack through every native backend: the same lights and normals within 0.1 degree.
//! The page's tests take the same stack through the browser.

use burn::tensor::Device;
use normalight_core::{ImageStack, mean_light_error, normal_error};
use normalight_model::{
    Estimate, EstimateInput, EstimateSettings, Estimator, NoopObserver, Quality, default_weights,
};
use normalight_tests::golden_sample;

/// Mean difference that two paths may have, in degrees.
const TOLERANCE: f32 = 0.1;

fn estimate(device: Device, quality: Quality, photographs: usize) -> Estimate {
    let sample = golden_sample();
    let stack = sample.to_stack().expect("the golden stack is a stack");
    let mut images = stack.into_images();
    images.truncate(photographs);
    let stack = ImageStack::new(images).expect("a part of a stack is a stack");
    let [light, normal] = default_weights().expect("the shipped weights are readable");
    let estimator = Estimator::new(&light, &normal, device).expect("the shipped weights fit");
    pollster::block_on(estimator.estimate(
        EstimateInput {
            stack: &stack,
            mask: &sample.to_mask(),
            lights: None,
        },
        EstimateSettings {
            quality,
            ..EstimateSettings::default()
        },
        &mut NoopObserver,
    ))
    .expect("the golden stack can be estimated")
}

#[test]
#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
fn flex_and_ndarray_agree_on_the_golden_stack() {
    // The reference adds products one by one: one view of a few photographs.
    let of_few = |device| estimate(device, Quality::Fast, 4);
    let fast = of_few(Device::flex());
    let reference = of_few(Device::ndarray());
    let mask = golden_sample().to_mask();
    let normals = normal_error(&fast.normals, &reference.normals, &mask).unwrap();
    let normals = normals.mean.to_degrees();
    let lights = mean_light_error(&fast.lights, &reference.lights).unwrap();
    assert!(normals < TOLERANCE, "normals differ by {normals} degrees");
    assert!(
        lights.to_degrees() < TOLERANCE,
        "lights differ by {} degrees",
        lights.to_degrees()
    );
}

#[test]
fn the_golden_stack_is_understood() {
    let sample = golden_sample();
    let found = estimate(Device::flex(), Quality::default(), sample.lights.len());
    let normals = normal_error(&found.normals, &sample.to_normal_map(), &sample.to_mask());
    let lights = mean_light_error(&found.lights, &sample.lights).unwrap();
    // Far better than chance (a flat normal map is off by some 40 degrees), with room for other
    // weights.
    assert!(normals.unwrap().mean.to_degrees() < 20.0);
    assert!(lights.to_degrees() < 15.0);
}
