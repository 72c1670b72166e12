//! How samples relate to light: what was asked, what a file says, what is usual.
mod code_points;
pub(crate) mod decision;
mod encoding;
mod evidence;
mod exif;
mod png_chunks;
mod profile;
mod tables;

pub(crate) use encoding::{Curves, Encoding, Primaries, to_srgb};
pub(crate) use exif::{ExifColor, of_exif};
pub(crate) use png_chunks::of_png;
pub(crate) use profile::of_profile;

use normalight_core::{Samples, Transfer};
use serde::{Deserialize, Serialize};
use std::fmt;
use tables::Tables;

/// How the samples of photographs are taken to relate to light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum ColorMode {
    /// As the file says: its profile, its chunks, its format. Where it says nothing, 8 bits are
    /// sRGB and 16 bits linear; in a stack the layout of benchmarks and the shading are asked first.
    #[default]
    Auto,
    /// All samples are linear.
    Linear,
    /// All integer samples are sRGB; floating-point ones stay linear.
    Srgb,
}

impl fmt::Display for ColorMode {
    /// The word of the command line and of `report.json`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ColorMode::Auto => "auto",
            ColorMode::Linear => "linear",
            ColorMode::Srgb => "srgb",
        })
    }
}

/// What a file says about its samples.
#[derive(Debug, Clone, Default)]
pub(crate) enum Statement {
    /// Nothing.
    #[default]
    Nothing,
    /// Proportional to light.
    Linear,
    /// The sRGB curve.
    Srgb,
    /// Curves and primaries.
    Encoded(Encoding),
    /// Tables of a profile.
    Tables(Tables),
    /// Something that is not understood.
    Unknown {
        /// Why.
        reason: String,
        /// What is believed instead.
        instead: Box<Statement>,
    },
}

impl Statement {
    /// What cannot be understood is taken as what else is said, or as sRGB: who says something of
    /// colours has made them for viewing.
    pub(crate) fn unknown(reason: String, instead: Self) -> Self {
        let instead = match instead {
            Self::Nothing => Self::Srgb,
            said => said,
        };
        Self::Unknown {
            reason,
            instead: Box::new(instead),
        }
    }

    /// This, unless it says nothing.
    pub(crate) fn or(self, other: impl FnOnce() -> Self) -> Self {
        match self {
            Self::Nothing => other(),
            said => said,
        }
    }

    /// In words.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Nothing => "nothing".to_owned(),
            Self::Linear => "linear".to_owned(),
            Self::Srgb => "sRGB".to_owned(),
            Self::Encoded(encoding) => encoding.name.clone(),
            Self::Tables(tables) => tables.name.clone(),
            Self::Unknown { instead, .. } => instead.words(),
        }
    }

    /// Samples and transfer as this statement has them; `channels` colours, no alpha.
    pub(crate) fn apply(&self, samples: Samples, channels: usize) -> (Samples, Transfer) {
        match self {
            Self::Nothing | Self::Linear => (samples, Transfer::Linear),
            Self::Srgb => (samples, Transfer::Srgb),
            Self::Encoded(encoding) => (encoding.linear(&samples, channels), Transfer::Linear),
            Self::Tables(tables) => (tables.linear(&samples, channels), Transfer::Linear),
            Self::Unknown { instead, .. } => instead.apply(samples, channels),
        }
    }
}

/// Samples as numbers, full scale 1, through a curve.
pub(crate) fn mapped(samples: &Samples, curve: impl Fn(f32) -> f32) -> Vec<f32> {
    // Curves are slow, codes few.
    let table = |codes: usize| -> Vec<f32> {
        let full = (codes - 1) as f32;
        (0..codes).map(|code| curve(code as f32 / full)).collect()
    };
    match samples {
        Samples::U8(codes) => {
            let table = table(256);
            codes.iter().map(|&code| table[usize::from(code)]).collect()
        }
        Samples::U16(codes) => {
            let table = table(65_536);
            codes.iter().map(|&code| table[usize::from(code)]).collect()
        }
        Samples::F32(values) => values.iter().map(|&value| curve(value)).collect(),
    }
}

/// Number of samples, all channels together.
pub(crate) fn samples_len(samples: &Samples) -> usize {
    match samples {
        Samples::U8(codes) => codes.len(),
        Samples::U16(codes) => codes.len(),
        Samples::F32(values) => values.len(),
    }
}
