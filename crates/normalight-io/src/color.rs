//! How samples relate to light: what was asked, what a file says, what is usual.
pub(crate) mod evidence;
mod png_chunks;
pub(crate) mod profile;

pub(crate) use png_chunks::of_png;

use normalight_core::{Samples, Transfer};
use profile::Profile;
use serde::{Deserialize, Serialize};
use std::fmt;

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
    /// A power: light is the sample to this exponent.
    Power(f32),
    /// Curves and primaries.
    Profile(Profile),
    /// Something that is not understood, and why.
    Unknown(String),
}

impl Statement {
    /// In words.
    pub(crate) fn words(&self) -> String {
        match self {
            Self::Nothing => "nothing".to_owned(),
            Self::Linear => "linear".to_owned(),
            Self::Srgb => "sRGB".to_owned(),
            Self::Power(power) => format!("gamma {power:.2}"),
            Self::Profile(profile) => format!("the colour profile {}", profile.name),
            Self::Unknown(_) => "sRGB".to_owned(),
        }
    }

    /// Samples and transfer as this statement has them; `channels` colours, no alpha.
    pub(crate) fn apply(&self, samples: Samples, channels: usize) -> (Samples, Transfer) {
        let linear = |samples| (samples, Transfer::Linear);
        match self {
            Self::Nothing | Self::Linear => linear(samples),
            Self::Srgb | Self::Unknown(_) => (samples, Transfer::Srgb),
            Self::Power(power) => linear(Samples::F32(mapped(&samples, |v| v.powf(*power)))),
            Self::Profile(profile) => linear(Samples::F32(profile.linear(&samples, channels))),
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
