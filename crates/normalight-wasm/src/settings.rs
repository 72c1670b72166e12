//! Settings as JavaScript words.
use crate::error::Failure;
use normalight_io::{ColorMode, MaskChoice, NamedBytes, NormalFormat, ReadOptions};
use normalight_model::EstimateSettings;
use serde::{Deserialize, Serialize};
use wasm_bindgen::JsValue;

/// How to estimate; everything may be left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub(crate) struct Settings {
    pub(crate) color: Color,
    pub(crate) mask: Mask,
    pub(crate) images: Option<usize>,
    pub(crate) normal_format: Format,
    pub(crate) refit: bool,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Color {
    #[default]
    Auto,
    Linear,
    Srgb,
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

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Format {
    #[default]
    OpenGl,
    DirectX,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            color: Color::default(),
            mask: Mask::default(),
            images: None,
            normal_format: Format::default(),
            refit: true,
        }
    }
}

impl Settings {
    pub(crate) fn from_js(value: JsValue) -> Result<Self, Failure> {
        Ok(serde_wasm_bindgen::from_value(value)?)
    }

    pub(crate) fn reading(&self, mask: Option<NamedBytes>) -> ReadOptions {
        ReadOptions {
            color: self.color.into(),
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
            second_pass: self.refit,
            ..EstimateSettings::default()
        }
    }
}

impl From<Color> for ColorMode {
    fn from(color: Color) -> Self {
        match color {
            Color::Auto => Self::Auto,
            Color::Linear => Self::Linear,
            Color::Srgb => Self::Srgb,
        }
    }
}

impl From<Format> for NormalFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::OpenGl => Self::OpenGl,
            Format::DirectX => Self::DirectX,
        }
    }
}
