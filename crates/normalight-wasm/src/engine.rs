//! The pipeline, bound to a device.
use crate::callback::{ProgressCallback, ProgressObserver};
use crate::error::Failure;
use crate::file::{InputFile, decoded_by_browser, named_bytes};
use crate::helper::HelperPool;
use crate::result::{Estimated, Run};
use crate::settings::Settings;
use burn::tensor::Device;
use normalight_io::{NamedBytes, RunDescription, read_stack};
use normalight_model::{EstimateInput, Estimator, Weights, expect_default_weights};
use tsify::{Ts, Tsify};
use wasm_bindgen::prelude::*;

/// The networks on a device.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Engine {
    estimator: Estimator,
    /// The device that was asked for, in the package's word, and a name for people.
    device: [String; 2],
}

#[wasm_bindgen]
impl Engine {
    /// On the processor; `device` is its name in reports, `shipped` whether these must be the weights that ship.
    ///
    /// # Errors
    /// Weights that are damaged or others.
    #[cfg(feature = "cpu")]
    pub fn on_cpu(
        device: String,
        light: InputFile,
        normal: InputFile,
        shipped: bool,
    ) -> Result<Engine, Failure> {
        let names = ["cpu".to_owned(), device];
        Self::on(Device::flex(), names, [light, normal], shipped)
    }

    /// On the browser's GPU, which can be started once; otherwise as on the processor.
    ///
    /// # Errors
    /// WebGPU does not start, weights that are damaged or others.
    #[cfg(feature = "gpu")]
    pub async fn on_gpu(
        device: String,
        light: InputFile,
        normal: InputFile,
        shipped: bool,
    ) -> Result<Engine, Failure> {
        let gpu = Device::wgpu_options()
            .init_async()
            .await
            .map_err(|error| Failure::Device(error.to_string()))?;
        let names = ["gpu".to_owned(), device];
        Self::on(gpu, names, [light, normal], shipped)
    }

    fn on(
        device: Device,
        names: [String; 2],
        weights: [InputFile; 2],
        shipped: bool,
    ) -> Result<Engine, Failure> {
        let [light, normal] = weights.map(NamedBytes::from);
        let light = Weights::from_bytes(&light.name, &light.bytes)?;
        let normal = Weights::from_bytes(&normal.name, &normal.bytes)?;
        if shipped {
            expect_default_weights([&light, &normal])?;
        }
        Ok(Self {
            estimator: Estimator::new(&light, &normal, device)?,
            device: names,
        })
    }

    /// From files to lights and normals. A `mask` or `lights` file replaces what would be found; helpers compute on
    /// processors, and are left alone by a GPU.
    ///
    /// # Errors
    /// Files or settings that do not do, a callback that says stop, a device that fails.
    pub async fn estimate(
        &self,
        files: Vec<InputFile>,
        mask: Option<InputFile>,
        lights: Option<InputFile>,
        settings: Ts<Settings>,
        callback: ProgressCallback,
        helpers: Option<HelperPool>,
    ) -> Result<Ts<Estimated>, Failure> {
        let settings = settings.to_rust()?;
        let mut observer = ProgressObserver::start(&callback)
            .await
            .ok_or(Failure::Cancelled)?;
        let reading = settings.reading(mask.map(NamedBytes::from));
        let decoded = decoded_by_browser(&files);
        let mut input = read_stack(named_bytes(files), &reading)?;
        input.plan.say_first(decoded);
        let lights = lights.map(NamedBytes::from);
        let given = match &lights {
            Some(NamedBytes { name, bytes }) => {
                let given = input.given_lights(name, bytes, settings.light_axes()?)?;
                Some(input.accept_lights(name, given))
            }
            None => None,
        };
        observer.read(&input.plan)?;
        let estimate = self
            .estimator
            .estimate_with(
                &helpers,
                EstimateInput {
                    stack: &input.stack,
                    mask: &input.mask,
                    lights: given.as_deref(),
                },
                settings.estimating(),
                &mut observer,
            )
            .await?;
        if given.is_none() {
            input.judge_coverage(&estimate.lights);
        }
        let [asked, used] = &self.device;
        let description = RunDescription {
            reading: &reading,
            settings: settings.estimating(),
            lights_file: lights.as_ref().map(|file| file.name.as_str()),
            device: [asked, used],
            weights: self.estimator.weight_hashes(),
            normal_format: settings.normal_format,
            seconds: observer.finish(),
        };
        let run = Run {
            input: &input,
            estimate: &estimate,
            report: description.report(&input, &estimate),
        };
        Ok(Estimated::new(&run)?.into_ts()?)
    }
}
