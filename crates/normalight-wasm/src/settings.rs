//! Settings as JavaScript words.
use crate::error::Failure;
use normalight_core::RefitSettings;
use normalight_io::{
    AmbientChoice, ColorMode, LightAxes, LightAxesError, MaskChoice, NamedBytes, NormalFormat,
    ReadOptions,
};
use normalight_model::{EstimateSettings, Quality};
use serde::{Deserialize, Serialize};
use tsify::Tsify;

/// How to estimate; everything may be left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Tsify)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Settings {
    /// How samples relate to light.
    pub(crate) color: ColorMode,
    /// Which pixels belong to the object, where no file says so.
    pub(crate) mask: MaskSetting,
    /// Use only this many images, spread over the series.
    pub(crate) images: Option<usize>,
    /// Which way the axes of a light file point: `x-right,y-up,z-out` (ours), `x-right,y-down,z-in`, ...
    pub(crate) light_axes: String,
    /// Lay photographs that a moved camera took over the others.
    pub(crate) align: bool,
    /// What becomes of a picture without lamp.
    pub(crate) ambient: AmbientSetting,
    /// Which way green points in `normals.png` and the preview.
    pub(crate) normal_format: NormalFormat,
    /// Refit the lights to the normals, and the normals to them.
    pub(crate) refit: bool,
    /// Over how many views of the photographs lights and normals are averaged.
    pub(crate) quality: Quality,
}

/// Which pixels belong to the object, where no file says so.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, Tsify)]
#[serde(rename_all = "lowercase")]
pub enum MaskSetting {
    /// A file that is handed in counts, else what is among the files, else a guess.
    #[default]
    Auto,
    /// The whole frame.
    None,
}

/// What becomes of a picture without lamp.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, Tsify)]
#[serde(rename_all = "lowercase")]
pub enum AmbientSetting {
    /// It is left out.
    #[default]
    None,
    /// It is subtracted from all photographs.
    Auto,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            color: ColorMode::default(),
            mask: MaskSetting::default(),
            images: None,
            light_axes: LightAxes::default().to_string(),
            align: false,
            ambient: AmbientSetting::default(),
            normal_format: NormalFormat::default(),
            refit: true,
            quality: Quality::default(),
        }
    }
}

impl Settings {
    pub(crate) fn reading(&self, mask: Option<NamedBytes>) -> ReadOptions {
        ReadOptions {
            color: self.color,
            mask: match (mask, self.mask) {
                (Some(file), _) => MaskChoice::File(file),
                (None, MaskSetting::Auto) => MaskChoice::Auto,
                (None, MaskSetting::None) => MaskChoice::WholeFrame,
            },
            images: self.images,
            align: self.align,
            ambient: match self.ambient {
                AmbientSetting::None => AmbientChoice::LeaveOut,
                AmbientSetting::Auto => AmbientChoice::Auto,
            },
            ..ReadOptions::default()
        }
    }

    /// Which way the axes of a light file point.
    ///
    /// # Errors
    /// Words that say no axes.
    pub(crate) fn light_axes(&self) -> Result<LightAxes, Failure> {
        let failed = |error| Failure::Input(format!("lightAxes: {error}"));
        self.light_axes
            .parse()
            .map_err(|error: LightAxesError| failed(error))
    }

    pub(crate) fn estimating(&self) -> EstimateSettings {
        EstimateSettings {
            refit: self.refit.then(RefitSettings::default),
            quality: self.quality,
            ..EstimateSettings::default()
        }
    }
}
