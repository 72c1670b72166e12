//! From arguments to an estimator and its settings.
use crate::args::EstimationArgs;
use crate::choices::word;
use crate::device::{self, OpenDevice};
use anyhow::Result;
use normalight_core::RefitSettings;
use normalight_io::read_named;
use normalight_model::{EstimateSettings, Estimator, Weights, default_weights};
use std::path::Path;

/// Both networks on a device, and how to use them.
pub(crate) struct Estimation {
    pub(crate) estimator: Estimator,
    pub(crate) settings: EstimateSettings,
    pub(crate) device: String,
}

impl Estimation {
    /// Loads the weights and opens the device.
    pub(crate) fn open(args: &EstimationArgs) -> Result<Self> {
        let [light, normal] = default_weights()?;
        let light = other_weights(args.light_weights.as_deref())?.unwrap_or(light);
        let normal = other_weights(args.normal_weights.as_deref())?.unwrap_or(normal);
        let OpenDevice { device, name } = device::open(args.device)?;
        Ok(Self {
            estimator: Estimator::new(&light, &normal, device)?,
            settings: EstimateSettings {
                decoding: args.decoding.into(),
                refit: (!args.no_refit).then(RefitSettings::default),
                quality: args.quality.0,
            },
            device: name,
        })
    }
}

/// The settings as the command line names them, for reports.
pub(crate) fn describe(
    args: &EstimationArgs,
    settings: &EstimateSettings,
    lights_given: bool,
) -> serde_json::Map<String, serde_json::Value> {
    let refit = settings.refit_of(lights_given).is_some();
    [
        ("device".to_owned(), word(args.device).into()),
        ("quality".to_owned(), word(args.quality).into()),
        ("decoding".to_owned(), word(args.decoding).into()),
        ("refit".to_owned(), refit.into()),
    ]
    .into_iter()
    .collect()
}

fn other_weights(path: Option<&Path>) -> Result<Option<Weights>> {
    let Some(path) = path else { return Ok(None) };
    let file = read_named(path)?;
    let name = path.display().to_string();
    Ok(Some(Weights::from_bytes(&name, &file.bytes)?))
}
