use crate::observer::{Observer, Progress, Stage};
use crate::{
    Known, LightArchitecture, LightNetwork, ModelError, NormalArchitecture, NormalNetwork,
    SecondPass, Weights, estimate_lights, estimate_normals, light_cost, normal_cost,
};
use burn::tensor::Device;
use normalight_core::{
    Decoding, ImageStack, Light, Mask, NormalMap, RefitSettings, albedo_map, refit_lights,
};
use std::ops::ControlFlow;

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
    /// Make the lights better with the first normals and estimate the normals again; lights that were
    /// given are never touched. See [`Estimator::second_pass`].
    pub second_pass: bool,
    /// How lights are refitted where they are.
    pub refit: RefitSettings,
}

impl Default for EstimateSettings {
    fn default() -> Self {
        Self {
            decoding: Decoding::SoftArgmax,
            second_pass: true,
            refit: RefitSettings::default(),
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

    /// What follows the first normals: a guided light network looks again, the lights of another one are
    /// refitted; nothing where the settings say so or lights were given.
    pub fn second_pass(
        &self,
        settings: &EstimateSettings,
        lights_given: bool,
    ) -> Option<SecondPass> {
        let better = if self.light_architecture.guided {
            SecondPass::Guided
        } else {
            SecondPass::Refit
        };
        (settings.second_pass && !lights_given).then_some(better)
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
            None => self.lights(stack, mask, None, settings, observer).await?,
        };
        let mut normals = self
            .normals(stack, mask, &lights, Stage::Normals, observer)
            .await?;
        if let Some(pass) = self.second_pass(&settings, given.is_some()) {
            lights = match pass {
                SecondPass::Guided => {
                    let known = Known {
                        normals: &normals,
                        lights: &lights,
                    };
                    self.lights(stack, mask, Some(known), settings, observer)
                        .await?
                }
                SecondPass::Refit => {
                    report(observer, Stage::Refit).await?;
                    refit_lights(stack, mask, &normals, &lights, settings.refit)?
                }
            };
            normals = self
                .normals(stack, mask, &lights, Stage::FinalNormals, observer)
                .await?;
        }
        report(observer, Stage::Albedo).await?;
        let albedo = albedo_map(stack, mask, &normals, &lights)?;
        Ok(Estimate {
            lights,
            normals,
            albedo,
        })
    }

    async fn lights(
        &self,
        stack: &ImageStack,
        mask: &Mask,
        known: Option<Known<'_>>,
        settings: EstimateSettings,
        observer: &mut impl Observer,
    ) -> Result<Vec<Light>, ModelError> {
        estimate_lights(
            &self.light_architecture,
            &self.light,
            stack,
            mask,
            known,
            settings.decoding,
            &self.device,
            observer,
        )
        .await
    }

    async fn normals(
        &self,
        stack: &ImageStack,
        mask: &Mask,
        lights: &[Light],
        stage: Stage,
        observer: &mut impl Observer,
    ) -> Result<NormalMap, ModelError> {
        estimate_normals(
            &self.normal_architecture,
            &self.normal,
            stack,
            mask,
            lights,
            &self.device,
            stage,
            observer,
        )
        .await
    }
}

async fn report(observer: &mut impl Observer, stage: Stage) -> Result<(), ModelError> {
    let progress = Progress {
        stage,
        fraction: 0.0,
    };
    match observer.report(progress).await {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(ModelError::Cancelled),
    }
}
