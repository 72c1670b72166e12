//! From photographs in memory to lights and normals. They are rendered here, so the truth is known:
//!
//!     cargo run --release -p normalight-model --example estimate_memory
use burn::tensor::Device;
use normalight_core::{mean_light_error, normal_error};
use normalight_model::{EstimateInput, EstimateSettings, Estimator, NoopObserver, default_weights};
use normalight_synth::{Framing, Preset, Renderer};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // Any program can make an `ImageStack`: of 8 or 16 bits or floating point, linear or sRGB.
    let renderer = Renderer::new(Preset::World.recipe())?;
    let truth = renderer.sample(1, 12, 64, Framing::WholeObject);
    let (stack, mask) = (truth.to_stack()?, truth.to_mask());

    let [light, normal] = default_weights()?;
    let estimator = Estimator::new(&light, &normal, Device::flex())?;
    let settings = EstimateSettings::default();
    let estimate = pollster::block_on(estimator.estimate(
        EstimateInput {
            stack: &stack,
            mask: &mask,
            lights: None,
        },
        settings,
        &mut NoopObserver,
    ))?;

    let lights = mean_light_error(&estimate.lights, &truth.lights)?;
    let normals = normal_error(&estimate.normals, &truth.to_normal_map(), &mask)?;
    println!("lights: mean error {:.1} degrees", lights.to_degrees());
    println!(
        "normals: mean error {:.1} degrees",
        normals.mean.to_degrees()
    );
    Ok(())
}
