//! Normals from photographs under lights that are known (calibrated photometric stereo), beside those of least squares:
//!
//!     cargo run --release -p normalight-model --example estimate_given_lights
use burn::tensor::Device;
use normalight_core::{least_squares_normals, normal_error};
use normalight_model::{EstimateInput, EstimateSettings, Estimator, NoopObserver, default_weights};
use normalight_synth::{Framing, Preset, Renderer};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let renderer = Renderer::new(Preset::World.recipe())?;
    let truth = renderer.sample(1, 12, 64, Framing::WholeObject);
    let (stack, mask) = (truth.to_stack()?, truth.to_mask());

    let [light, normal] = default_weights()?;
    let estimator = Estimator::new(&light, &normal, Device::flex())?;
    let settings = EstimateSettings::default();
    // Given lights replace the light network, and are never refitted.
    let estimate = pollster::block_on(estimator.estimate(
        EstimateInput {
            stack: &stack,
            mask: &mask,
            lights: Some(&truth.lights),
        },
        settings,
        &mut NoopObserver,
    ))?;
    let (by_least_squares, _) = least_squares_normals(&stack, &mask, &truth.lights)?;

    for (name, normals) in [
        ("network", &estimate.normals),
        ("least squares", &by_least_squares),
    ] {
        let error = normal_error(normals, &truth.to_normal_map(), &mask)?;
        println!("{name}: mean error {:.1} degrees", error.mean.to_degrees());
    }
    Ok(())
}
