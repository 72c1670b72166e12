use crate::{Decoding, Light, NormalMap, Quality, RefitSettings};

/// How to estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EstimateSettings {
    /// How light classes become numbers.
    pub decoding: Decoding,
    /// Refit the lights to the first normals and estimate the normals again; lights that were
    /// given are never touched.
    pub refit: Option<RefitSettings>,
    /// Over how many views of the photographs lights and normals are averaged.
    pub quality: Quality,
}

impl EstimateSettings {
    /// How lights are refitted, if they are: those that were given never.
    pub fn refit_of(&self, lights_given: bool) -> Option<RefitSettings> {
        self.refit.filter(|_| !lights_given)
    }
}

impl Default for EstimateSettings {
    fn default() -> Self {
        Self {
            decoding: Decoding::SoftArgmax,
            refit: Some(RefitSettings::default()),
            quality: Quality::default(),
        }
    }
}

/// What an estimation gives.
#[derive(Debug, Clone)]
pub struct Estimate {
    /// One light per image; intensities relative to their mean unless they were given.
    pub lights: Vec<Light>,
    /// Unit normals, zero outside the mask.
    pub normals: NormalMap,
    /// Expected error of each normal in degrees, see [`expected_normal_error`](crate::expected_normal_error): rows from the
    /// top, zero outside the mask. `None` where that tells nothing: one view of few images, or lights in
    /// a plane.
    pub normal_errors: Option<Vec<f32>>,
    /// Linear RGB planes `[3, height, width]`, up to one scale; zero outside the mask.
    pub albedo: Vec<f32>,
}
