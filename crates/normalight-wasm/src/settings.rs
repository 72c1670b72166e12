//! Settings as JavaScript words.
use crate::error::Failure;
use normalight_core::RefitSettings;
use normalight_io::{ColorMode, MaskChoice, NamedBytes, NormalFormat, ReadOptions};
use normalight_model::{EstimateSettings, Quality};
use serde::{Deserialize, Serialize};
use wasm_bindgen::JsValue;

/// How to estimate; everything may be left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub(crate) struct Settings {
    pub(crate) color: ColorMode,
    pub(crate) mask: Mask,
    pub(crate) images: Option<usize>,
    pub(crate) normal_format: NormalFormat,
    pub(crate) refit: bool,
    pub(crate) quality: Quality,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Mask {
    /// A file that is handed in counts, else what is among the files, else a guess.
    #[default]
    Auto,
    /// The whole frame.
    None,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            color: ColorMode::default(),
            mask: Mask::default(),
            images: None,
            normal_format: NormalFormat::default(),
            refit: true,
            quality: Quality::default(),
        }
    }
}

impl Settings {
    pub(crate) fn from_js(value: JsValue) -> Result<Self, Failure> {
        Ok(serde_wasm_bindgen::from_value(value)?)
    }

    pub(crate) fn reading(&self, mask: Option<NamedBytes>) -> ReadOptions {
        ReadOptions {
            color: self.color,
            mask: match (mask, self.mask) {
                (Some(file), _) => MaskChoice::File(file),
                (None, Mask::Auto) => MaskChoice::Auto,
                (None, Mask::None) => MaskChoice::WholeFrame,
            },
            images: self.images,
        }
    }

    pub(crate) fn estimating(&self) -> EstimateSettings {
        EstimateSettings {
            refit: self.refit.then(RefitSettings::default),
            quality: self.quality,
            ..EstimateSettings::default()
        }
    }
}
