use crate::{EvaluateError, Figures, ObjectFigures};
use normalight_core::{
    ImageStack, Light, Mask, NormalMap, intensity_error, mean_light_error, normal_error,
};
use normalight_model::{EstimateInput, EstimateSettings, Estimator, Observer};
use std::time::Instant;

/// An object with the truth about it.
#[derive(Debug, Clone)]
pub struct BenchmarkObject {
    /// Its name.
    pub name: String,
    /// The photographs.
    pub stack: ImageStack,
    /// Its pixels.
    pub mask: Mask,
    /// The true light of each photograph.
    pub lights: Vec<Light>,
    /// The true normals; pixels with zero are left out.
    pub normals: NormalMap,
}

/// Which lights the normals are estimated with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightsFrom {
    /// Estimated from the photographs, as users do it.
    Photographs,
    /// The true ones (calibrated photometric stereo): what is left is the normal network's error.
    Truth,
}

/// Runs the pipeline on an object, exactly as users run it, and compares with the truth.
///
/// # Errors
/// [`EvaluateError::Model`] (cancelled by the observer, say) or [`EvaluateError::Core`] for a truth that
/// does not fit the photographs.
pub fn evaluate_object(
    estimator: &Estimator,
    object: &BenchmarkObject,
    lights: LightsFrom,
    settings: EstimateSettings,
    observer: &mut impl Observer,
) -> Result<ObjectFigures, EvaluateError> {
    let given = match lights {
        LightsFrom::Photographs => None,
        LightsFrom::Truth => Some(object.lights.as_slice()),
    };
    let start = Instant::now();
    let estimate = pollster::block_on(estimator.estimate(
        EstimateInput {
            stack: &object.stack,
            mask: &object.mask,
            lights: given,
        },
        settings,
        observer,
    ))?;
    let seconds = start.elapsed().as_secs_f64();
    let normals = normal_error(&estimate.normals, &object.normals, &object.mask)?;
    let (light_degrees, intensity) = match lights {
        LightsFrom::Truth => (None, None),
        LightsFrom::Photographs => {
            let angle = mean_light_error(&estimate.lights, &object.lights)?;
            let intensity = intensity_error(&estimate.lights, &object.lights)?;
            (Some(f64::from(angle).to_degrees()), Some(intensity.into()))
        }
    };
    let [under_11_25, under_22_5, under_30] = normals.shares.map(f64::from);
    Ok(ObjectFigures {
        name: object.name.clone(),
        images: object.stack.len(),
        pixels: normals.pixels,
        figures: Figures {
            normal_degrees: f64::from(normals.mean).to_degrees(),
            under_11_25,
            under_22_5,
            under_30,
            light_degrees,
            intensity_error: intensity,
            seconds,
        },
    })
}
