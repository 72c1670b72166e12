use crate::{
    BenchmarkObject, EvaluateError, Figures, Method, NormalFigures, ObjectFigures, Reliability,
};
use normalight_core::{
    Light, NormalError, NormalMap, intensity_error, least_squares_normals, mean_light_error,
    normal_error, robust_normals, uncalibrated_factorisation,
};
use normalight_model::{EstimateInput, EstimateSettings, Estimator, Observer};
use std::time::Instant;

/// What a method found, and how far it is from the truth.
#[derive(Debug, Clone)]
pub struct Measured {
    /// The errors.
    pub figures: ObjectFigures,
    /// The normals that were found.
    pub normals: NormalMap,
    /// The lights that were found; `None` when the true ones were given.
    pub lights: Option<Vec<Light>>,
}

/// Runs a method on an object, the networks exactly as users run them, and compares with what is known of the truth.
///
/// # Errors
/// [`EvaluateError::NoLights`] for a method that needs the true lights where they are not known;
/// [`EvaluateError::Model`] (cancelled by the observer, say) or [`EvaluateError::Core`] for a truth that
/// does not fit the photographs, or where a classical method has too few of them.
pub fn evaluate_object(
    estimator: &Estimator,
    object: &BenchmarkObject,
    method: Method,
    settings: EstimateSettings,
    observer: &mut impl Observer,
) -> Result<Measured, EvaluateError> {
    let BenchmarkObject {
        stack,
        mask,
        lights,
        ..
    } = object;
    let mut estimate = |given: Option<&[Light]>| {
        let input = EstimateInput {
            stack,
            mask,
            lights: given,
        };
        pollster::block_on(estimator.estimate(input, settings, observer))
    };
    let known = || lights.as_deref().ok_or(EvaluateError::NoLights);
    let mut expected = None;
    let start = Instant::now();
    let (normals, found) = match method {
        Method::Uncalibrated => {
            let estimate = estimate(None)?;
            expected = estimate.normal_errors;
            (estimate.normals, Some(estimate.lights))
        }
        Method::EstimatedLeastSquares => {
            let found = estimate(None)?.lights;
            (least_squares_normals(stack, mask, &found)?.0, Some(found))
        }
        Method::Calibrated => {
            let estimate = estimate(Some(known()?))?;
            expected = estimate.normal_errors;
            (estimate.normals, None)
        }
        Method::LeastSquares => (least_squares_normals(stack, mask, known()?)?.0, None),
        Method::Robust => (robust_normals(stack, mask, known()?)?.0, None),
        Method::Factorisation => {
            let found = uncalibrated_factorisation(stack, mask)?;
            (found.normals, Some(found.lights))
        }
    };
    let seconds = start.elapsed().as_secs_f64();
    let mut measured = Measured::new(object, normals, found, seconds)?;
    let ObjectFigures {
        figures,
        reliability,
        ..
    } = &mut measured.figures;
    if let [_, true] = method.networks() {
        let input = EstimateInput {
            stack,
            mask,
            lights: lights.as_deref().filter(|_| method.knows_lights()),
        };
        figures.multiply_adds = Some(estimator.multiply_adds(input, settings) as f64);
    }
    if let (Some(expected), Some(truth)) = (expected, &object.normals) {
        *reliability = Reliability::classes(&expected, &measured.normals, truth, mask);
    }
    Ok(measured)
}

impl Measured {
    /// Compares with the truth.
    fn new(
        object: &BenchmarkObject,
        normals: NormalMap,
        lights: Option<Vec<Light>>,
        seconds: f64,
    ) -> Result<Self, EvaluateError> {
        let degrees = |radians: f32| f64::from(radians).to_degrees();
        let truth = object.normals.as_ref();
        let error = truth
            .map(|truth| normal_error(&normals, truth, &object.mask))
            .transpose()?;
        let (light_degrees, intensity_error) = match (&lights, &object.lights) {
            (Some(found), Some(lights)) => (
                Some(degrees(mean_light_error(found, lights)?)),
                Some(f64::from(intensity_error(found, lights)?)),
            ),
            _ => (None, None),
        };
        let of_normals = |error: &NormalError| {
            let [under_11_25, under_22_5, under_30] = error.shares.map(f64::from);
            NormalFigures {
                normal_degrees: degrees(error.mean),
                normal_median_degrees: degrees(error.median),
                under_11_25,
                under_22_5,
                under_30,
            }
        };
        let pixels = error.as_ref().map_or(0, |error| error.pixels);
        Ok(Self {
            figures: ObjectFigures {
                name: object.name.clone(),
                images: object.stack.len(),
                pixels,
                without_truth: object.mask.count() - pixels,
                figures: Figures {
                    normals: error.as_ref().map(of_normals),
                    light_degrees,
                    intensity_error,
                    seconds,
                    multiply_adds: None,
                    peak_memory: None,
                },
                reliability: Vec::new(),
            },
            normals,
            lights,
        })
    }

    /// With the most memory that the process held meanwhile, in bytes.
    #[must_use]
    pub fn with_peak_memory(mut self, bytes: Option<u64>) -> Self {
        self.figures.figures.peak_memory = bytes.map(|bytes| bytes as f64);
        self
    }

    /// The same lights with normals by least squares: what [`Method::EstimatedLeastSquares`] finds, of what
    /// [`Method::Uncalibrated`] found of the same object; nearly no work of its own, and the seconds of both.
    ///
    /// # Errors
    /// Those of [`evaluate_object`]; `None` of lights, which other methods leave, are the true ones.
    pub fn with_least_squares(&self, object: &BenchmarkObject) -> Result<Self, EvaluateError> {
        let start = Instant::now();
        let lights = self.lights.as_ref().or(object.lights.as_ref());
        let lights = lights.ok_or(EvaluateError::NoLights)?;
        let (normals, _) = least_squares_normals(&object.stack, &object.mask, lights)?;
        let before = self.figures.figures;
        let seconds = before.seconds + start.elapsed().as_secs_f64();
        let mut found = Self::new(object, normals, self.lights.clone(), seconds)?;
        found.figures.figures.multiply_adds = before.multiply_adds;
        found.figures.figures.peak_memory = before.peak_memory;
        Ok(found)
    }
}
