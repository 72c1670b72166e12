use crate::observer::{Observer, PipelineStage, report};
use crate::{
    Architecture, AveragedNormals, Helpers, LightOptions, LoadedLightNetwork, LoadedNormalNetwork,
    ModelError, NoHelpers, Weights, light_cost, normal_cost,
};
use burn::tensor::Device;
use normalight_core::{
    CalibratedStack, Estimate, EstimateSettings, ImageStack, Light, LightCoverage, Mask, Symmetry,
    albedo_map, expected_normal_error, refit_lights,
};

/// What an estimate starts from.
#[derive(Debug, Clone, Copy)]
pub struct EstimateInput<'a> {
    /// The photographs.
    pub stack: &'a ImageStack,
    /// The object's pixels, of the photographs' size.
    pub mask: &'a Mask,
    /// Known lights, one for each photograph; they replace the light network.
    pub lights: Option<&'a [Light]>,
}

/// Both networks on a device, ready to go from photographs to lights and normals.
#[derive(Debug)]
pub struct Estimator {
    light: LoadedLightNetwork,
    normal: LoadedNormalNetwork,
    hashes: [String; 2],
}

impl Estimator {
    /// Loads two weights files onto a device.
    ///
    /// # Errors
    /// [`ModelError::WrongNetwork`] or [`ModelError::Tensor`].
    pub fn new(light: &Weights, normal: &Weights, device: Device) -> Result<Self, ModelError> {
        Ok(Self {
            light: light.light_network(&device)?,
            normal: normal.normal_network(&device)?,
            hashes: [light.hash().to_owned(), normal.hash().to_owned()],
        })
    }

    /// Number of trainable parameters of the light and of the normal network.
    pub fn parameters(&self) -> [usize; 2] {
        [
            light_cost(&self.light.architecture).parameters,
            normal_cost(&self.normal.architecture, 0).parameters,
        ]
    }

    /// What both networks are.
    pub fn architectures(&self) -> [Architecture; 2] {
        [
            Architecture::Light(self.light.architecture.clone()),
            Architecture::Normal(self.normal.architecture.clone()),
        ]
    }

    /// Multiply-adds of both networks' convolutions and fully connected layers in an estimate; the light network is
    /// counted whole in both of its passes.
    pub fn multiply_adds(&self, input: EstimateInput<'_>, settings: EstimateSettings) -> u64 {
        let EstimateInput {
            stack,
            mask,
            lights,
        } = input;
        let quality = settings.quality;
        let normals =
            |views: &[Symmetry]| self.normal.multiply_adds(stack.len(), mask, views.len());
        let lights_found = match lights {
            Some(_) => 0,
            None => self.light.multiply_adds(stack.len(), quality),
        };
        let refit = settings.refit_of(lights.is_some());
        let before = refit.map_or(0, |_| normals(quality.refit_views()));
        lights_found + before + normals(quality.views())
    }

    /// SHA-256 of the light and the normal weights, in hexadecimal.
    pub fn weight_hashes(&self) -> [&str; 2] {
        [&self.hashes[0], &self.hashes[1]]
    }

    /// From photographs to lights and normals.
    ///
    /// # Errors
    /// [`ModelError::Core`] for a mask or lights that do not fit, [`ModelError::Cancelled`],
    /// [`ModelError::Device`].
    pub async fn estimate(
        &self,
        input: EstimateInput<'_>,
        settings: EstimateSettings,
        observer: &mut impl Observer,
    ) -> Result<Estimate, ModelError> {
        self.estimate_with(&NoHelpers, input, settings, observer)
            .await
    }

    /// The same with others' help, who do a part of the normal network's work.
    ///
    /// # Errors
    /// As [`Estimator::estimate`].
    pub async fn estimate_with(
        &self,
        helpers: &impl Helpers,
        input: EstimateInput<'_>,
        settings: EstimateSettings,
        observer: &mut impl Observer,
    ) -> Result<Estimate, ModelError> {
        let EstimateInput {
            stack,
            mask,
            lights: given,
        } = input;
        stack.check_mask(mask, "mask")?;
        let mut lights = match given {
            Some(lights) => lights.to_vec(),
            None => {
                let options = LightOptions {
                    decoding: settings.decoding,
                    quality: settings.quality,
                };
                self.light.estimate(stack, mask, options, observer).await?
            }
        };
        let mut stage = PipelineStage::Normals;
        if let Some(refit) = settings.refit_of(given.is_some()) {
            let views = settings.quality.refit_views();
            let calibrated = CalibratedStack::new(stack, mask, &lights)?;
            let averaged = self
                .normal
                .helped_by(helpers)
                .estimate(calibrated, views, stage, observer)
                .await?;
            report(observer, PipelineStage::Refit, 0.0).await?;
            lights = refit_lights(stack, mask, &averaged.normals, &lights, refit)?;
            stage = PipelineStage::FinalNormals;
        }
        let views = settings.quality.views();
        let calibrated = CalibratedStack::new(stack, mask, &lights)?;
        let AveragedNormals { normals, spread } = self
            .normal
            .helped_by(helpers)
            .estimate(calibrated, views, stage, observer)
            .await?;
        report(observer, PipelineStage::Albedo, 0.0).await?;
        // All views are led astray alike then, and what they say of each other means nothing.
        let is_flat = LightCoverage::of(&lights).is_some_and(|coverage| coverage.is_flat());
        let albedo = albedo_map(stack, mask, &normals, &lights)?;
        Ok(Estimate {
            lights,
            normals,
            normal_errors: spread
                .filter(|_| !is_flat)
                .map(|spread| errors(&spread, mask)),
            albedo,
        })
    }
}

/// Expected errors in degrees inside the mask, zero outside.
fn errors(spread: &[f32], mask: &Mask) -> Vec<f32> {
    let pixels = spread.iter().zip(mask.inside());
    let error = |(&spread, &inside): (&f32, &bool)| match inside {
        true => expected_normal_error(spread),
        false => 0.0,
    };
    pixels.map(error).collect()
}
