//! Words of the command line and what they stand for.
use clap::ValueEnum;
use clap::builder::PossibleValue;
use normalight_core::Decoding;
use normalight_evaluate::Method;
use normalight_io::{ColorMode, MeshFileFormat, NormalFormat, Outside};
use normalight_model::Quality;
use normalight_search::Equal;
use normalight_synth::BitDepth;
use normalight_train::Network;
use std::fmt;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

/// Where to compute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DeviceChoice {
    /// The GPU if there is a real one, else the CPU.
    Auto,
    /// The processor.
    Cpu,
    /// A real GPU of any maker (Vulkan, Metal or DirectX 12), or an error.
    #[value(alias = "gpu")]
    Wgpu,
    /// An NVIDIA GPU by CUDA, in programs built with `--features cuda`.
    Cuda,
    /// A GPU that the processor imitates: slow, for tests of the GPU's code.
    #[value(hide = true)]
    SoftwareGpu,
    /// An independent implementation on the processor: slow, for comparisons.
    #[value(hide = true)]
    Reference,
}

/// How the numbers in the photographs relate to light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorChoice {
    /// As the files say (profile, gamma, format); where they say nothing, as their layout, their
    /// shading or, last, what is usual.
    Auto,
    /// Twice the number is twice the light.
    Linear,
    /// As most cameras store pictures for viewing.
    Srgb,
}

/// Bits of a stored value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum BitsChoice {
    /// As the published sets.
    #[value(name = "8")]
    Eight,
    /// For recipes with cameras of more than 8 bits.
    #[value(name = "16")]
    Sixteen,
}

/// Which way green points in normals.png.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FormatChoice {
    /// Green is up.
    Opengl,
    /// Green is down.
    Directx,
}

/// The format of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MeshChoice {
    /// Binary glTF, with the albedo as its texture.
    Glb,
    /// Wavefront OBJ, with material and texture beside it.
    Obj,
    /// Binary PLY, with colours of its vertices.
    Ply,
}

/// What maps show outside the object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum OutsideChoice {
    /// A surface that faces the camera.
    Flat,
    /// What the nearest pixel of the object has.
    Dilated,
}

/// How the light network's classes become numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum DecodingChoice {
    /// The mean over all classes, weighted by their probability.
    SoftArgmax,
    /// The centre of the most probable class, as in the paper.
    Argmax,
}

/// Over how many views an estimate is averaged; the words are those of the quality itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct QualityChoice(pub(crate) Quality);

impl ValueEnum for QualityChoice {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [QualityChoice; Quality::ALL.len()] = {
            let [first, second, third] = Quality::ALL;
            [
                QualityChoice(first),
                QualityChoice(second),
                QualityChoice(third),
            ]
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.0.name()).help(self.0.words()))
    }
}

/// One of the two networks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum NetworkChoice {
    /// Photographs to lights.
    Light,
    /// Photographs and lights to normals.
    Normal,
}

/// What is the same for all networks that are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EqualChoice {
    /// Work of the network, and steps of its training.
    MultiplyAdds,
    /// Work of the network, and time of its training: where a step takes longer there are fewer.
    TrainingTime,
}

impl From<ColorChoice> for ColorMode {
    fn from(choice: ColorChoice) -> Self {
        match choice {
            ColorChoice::Auto => ColorMode::Auto,
            ColorChoice::Linear => ColorMode::Linear,
            ColorChoice::Srgb => ColorMode::Srgb,
        }
    }
}

impl From<FormatChoice> for NormalFormat {
    fn from(choice: FormatChoice) -> Self {
        match choice {
            FormatChoice::Opengl => NormalFormat::OpenGl,
            FormatChoice::Directx => NormalFormat::DirectX,
        }
    }
}

impl From<MeshChoice> for MeshFileFormat {
    fn from(choice: MeshChoice) -> Self {
        match choice {
            MeshChoice::Glb => MeshFileFormat::Glb,
            MeshChoice::Obj => MeshFileFormat::Obj,
            MeshChoice::Ply => MeshFileFormat::Ply,
        }
    }
}

impl From<OutsideChoice> for Outside {
    fn from(choice: OutsideChoice) -> Self {
        match choice {
            OutsideChoice::Flat => Outside::Flat,
            OutsideChoice::Dilated => Outside::Dilated,
        }
    }
}

impl From<DecodingChoice> for Decoding {
    fn from(choice: DecodingChoice) -> Self {
        match choice {
            DecodingChoice::SoftArgmax => Decoding::SoftArgmax,
            DecodingChoice::Argmax => Decoding::Argmax,
        }
    }
}

impl From<NetworkChoice> for Network {
    fn from(choice: NetworkChoice) -> Self {
        match choice {
            NetworkChoice::Light => Network::Light,
            NetworkChoice::Normal => Network::Normal,
        }
    }
}

impl From<EqualChoice> for Equal {
    fn from(choice: EqualChoice) -> Self {
        match choice {
            EqualChoice::MultiplyAdds => Equal::MultiplyAdds,
            EqualChoice::TrainingTime => Equal::TrainingTime,
        }
    }
}

/// The word that stands for a choice.
pub(crate) fn word(choice: impl ValueEnum) -> String {
    choice
        .to_possible_value()
        .map(|value| value.get_name().to_owned())
        .unwrap_or_default()
}

impl From<BitsChoice> for BitDepth {
    fn from(choice: BitsChoice) -> Self {
        match choice {
            BitsChoice::Eight => Self::Eight,
            BitsChoice::Sixteen => Self::Sixteen,
        }
    }
}

/// A method of `evaluate`, or all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MethodChoice(pub(crate) Option<Method>);

impl ValueEnum for MethodChoice {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [MethodChoice; Method::ALL.len() + 1] = {
            let mut all = [MethodChoice(None); Method::ALL.len() + 1];
            let mut index = 0;
            while index < Method::ALL.len() {
                all[index] = MethodChoice(Some(Method::ALL[index]));
                index += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self.0 {
            Some(method) => PossibleValue::new(method.name()).help(method.title()),
            None => PossibleValue::new("all"),
        })
    }
}

/// Photographs of an object that are left out: `bear:1-20`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LeaveOut {
    pub(crate) object: String,
    /// Counted from 1.
    pub(crate) photographs: RangeInclusive<usize>,
}

impl FromStr for LeaveOut {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = || {
            let (object, range) = text.rsplit_once(':')?;
            let (first, last) = range.split_once('-').unwrap_or((range, range));
            let photographs = first.parse().ok()?..=last.parse().ok()?;
            let fits = !object.is_empty() && !photographs.is_empty() && *photographs.start() > 0;
            fits.then(|| Self {
                object: object.to_owned(),
                photographs,
            })
        };
        parse().ok_or_else(|| "an object and its photographs are expected: bear:1-20".to_owned())
    }
}

impl fmt::Display for LeaveOut {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (first, last) = (self.photographs.start(), self.photographs.end());
        write!(formatter, "{}:{first}-{last}", self.object)
    }
}

/// A training and how it is called: `paper=runs/paper-normal`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NamedRun {
    pub(crate) name: String,
    pub(crate) folder: PathBuf,
}

impl FromStr for NamedRun {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((name, folder)) if !name.is_empty() && !folder.is_empty() => Ok(Self {
                name: name.to_owned(),
                folder: folder.into(),
            }),
            _ => Err(
                "a name and a training's folder are expected: paper=runs/paper-normal".to_owned(),
            ),
        }
    }
}
