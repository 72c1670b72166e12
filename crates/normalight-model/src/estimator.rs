use crate::observer::{Observer, Stage, report};
use crate::{
    LightArchitecture, LightNetwork, ModelError, NormalArchitecture, NormalNetwork, Quality,
    Weights, estimate_lights, estimate_normals, light_cost, normal_cost,
};
use burn::tensor::Device;
use normalight_core::{
    Decoding, ImageStack, Light, Mask, NormalMap, RefitSettings, Symmetry, albedo_map, refit_lights,
};

/// Both networks on a device, ready to go from photographs to lights and normals.
#[derive(Debug)]
pub struct Estimator {
    light_architecture: LightArchitecture,
    light: LightNetwork,
    normal_architecture: NormalArchitecture,
    normal: NormalNetwork,
    device: Device,
    hashes: [String; 2],
}

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
    /// Linear RGB planes `[3, height, width]`, up to one scale; zero outside the mask.
    pub albedo: Vec<f32>,
}

impl Estimator {
    /// Loads two weights files onto a device.
    ///
    /// # Errors
    /// [`ModelError::WrongNetwork`] or [`ModelError::Tensor`].
    pub fn new(light: &Weights, normal: &Weights, device: Device) -> Result<Self, ModelError> {
        let (light_architecture, light_network) = light.light_network(&device)?;
        let (normal_architecture, normal_network) = normal.normal_network(&device)?;
        Ok(Self {
            light_architecture,
            light: light_network,
            normal_architecture,
            normal: normal_network,
            device,
            hashes: [light.hash().to_owned(), normal.hash().to_owned()],
        })
    }

    /// Number of trainable parameters of the light and of the normal network.
    pub fn parameters(&self) -> [usize; 2] {
        [
            light_cost(&self.light_architecture).parameters,
            normal_cost(&self.normal_architecture, 0).parameters,
        ]
    }

    /// SHA-256 of the light and the normal weights, in hexadecimal.
    pub fn weight_hashes(&self) -> [&str; 2] {
        [&self.hashes[0], &self.hashes[1]]
    }

    /// From photographs to lights and normals; `given` lights replace the light network.
    ///
    /// # Errors
    /// [`ModelError::Core`] for a mask or lights that do not fit, [`ModelError::Cancelled`],
    /// [`ModelError::Device`].
    pub async fn estimate(
        &self,
        stack: &ImageStack,
        mask: &Mask,
        given: Option<&[Light]>,
        settings: EstimateSettings,
        observer: &mut impl Observer,
    ) -> Result<Estimate, ModelError> {
        stack.check_mask(mask, "mask")?;
        let mut lights = match given {
            Some(lights) => lights.to_vec(),
            None => {
                estimate_lights(
                    &self.light_architecture,
                    &self.light,
                    stack,
                    mask,
                    settings.decoding,
                    settings.quality,
                    &self.device,
                    observer,
                )
                .await?
            }
        };
        let mut stage = Stage::Normals;
        if let (Some(refit), None) = (settings.refit, given) {
            let views = settings.quality.refit_views();
            let normals = self
                .normals(stack, mask, &lights, views, stage, observer)
                .await?;
            report(observer, Stage::Refit, 0.0).await?;
            lights = refit_lights(stack, mask, &normals, &lights, refit)?;
            stage = Stage::FinalNormals;
        }
        let views = settings.quality.views();
        let normals = self
            .normals(stack, mask, &lights, views, stage, observer)
            .await?;
        report(observer, Stage::Albedo, 0.0).await?;
        let albedo = albedo_map(stack, mask, &normals, &lights)?;
        Ok(Estimate {
            lights,
            normals,
            albedo,
        })
    }

    async fn normals(
        &self,
        stack: &ImageStack,
        mask: &Mask,
        lights: &[Light],
        views: &[Symmetry],
        stage: Stage,
        observer: &mut impl Observer,
    ) -> Result<NormalMap, ModelError> {
        estimate_normals(
            &self.normal_architecture,
            &self.normal,
            stack,
            mask,
            lights,
            views,
            &self.device,
            stage,
            observer,
        )
        .await
    }
}
