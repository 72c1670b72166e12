use crate::{
    CellChoice, LightGenotype, ModelError, NormalGenotype, NormalInput, NormalNetwork, StagedLight,
    StagedNormal,
};
use normalight_core::LightBins;
use serde::{Deserialize, Serialize};

/// Pixels that a tile of a larger picture sees beyond the part that is kept: more than the about 30 pixels that plain
/// networks and cells see, so that tiles leave no seam.
const OVERLAP: usize = 32;

/// Everything that decides the shape of one network; stored in its weights file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "network", rename_all = "snake_case")]
pub enum Architecture {
    /// A light calibration network.
    Light(LightArchitecture),
    /// A normal estimation network.
    Normal(NormalArchitecture),
}

/// Light calibration: images and mask in, class scores of every light out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightArchitecture {
    /// Side of the square view of the object, in pixels.
    pub input_size: usize,
    /// The classes it speaks in.
    pub bins: LightBins,
    /// Its layers.
    pub body: LightBody,
}

/// Layers of a light calibration network.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum LightBody {
    /// Plain 3x3 convolutions.
    Plain(PlainLight),
    /// The paper's backbone with searched cells.
    Cells(CellLight),
    /// Stages, of the search of whole networks.
    Staged(StagedLight),
}

/// Five 3x3 convolutions (three of stride 2) per image, max over images, three more (two of stride
/// 2) on own and fused features, two fully connected layers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlainLight {
    /// Channels after the first, second and third stride.
    pub widths: [usize; 3],
    /// Units of the hidden fully connected layer.
    pub hidden: usize,
}

/// The paper's light backbone: two convolutions, cells N R N R N (N R N with one reduction), max
/// over images, two convolutions, cells N R, two convolutions, two fully connected layers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellLight {
    /// Base width C: channels of each node in the first cells.
    pub width: usize,
    /// Strides of the two stem convolutions.
    pub stem_strides: [usize; 2],
    /// Reduction cells among those of the features, each followed by a normal cell; 2 as published.
    #[serde(default = "two")]
    pub reductions: usize,
    /// Units of the hidden fully connected layer.
    pub hidden: usize,
    /// The cells.
    #[serde(default, skip_serializing_if = "CellChoice::is_open")]
    pub genotype: CellChoice<LightGenotype>,
}

/// Normal estimation: images and light directions in, unit normals out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NormalArchitecture {
    /// Whether the mask is a seventh input channel.
    pub mask_channel: bool,
    /// Its layers.
    pub body: NormalBody,
}

/// Layers of a normal estimation network.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum NormalBody {
    /// Plain 3x3 convolutions.
    Plain(PlainNormal),
    /// The paper's backbone with searched cells.
    Cells(CellNormal),
    /// Stages, of the search of whole networks.
    Staged(StagedNormal),
}

/// Seven 3x3 convolutions per image down to a quarter and up to half the size, max over images,
/// four more up to full size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlainNormal {
    /// Channels at full, half and quarter size.
    pub widths: [usize; 3],
    /// Channels of the last layer but one.
    pub head: usize,
    /// More 3x3 convolutions at a quarter of the size, each added to what it was given.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub residuals: usize,
    /// Channels of the branch of single pixels: two 1x1 convolutions on every image at full size, whose maximum and mean
    /// over the images join the last layers; 0 is no branch.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub pixel_branch: usize,
}

impl PlainNormal {
    /// Without residual layers and branch.
    pub fn new(widths: [usize; 3], head: usize) -> Self {
        Self {
            widths,
            head,
            residuals: 0,
            pixel_branch: 0,
        }
    }
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// How feature maps grow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Upsampling {
    /// Transposed 4x4 convolution of stride 2, as the paper draws it.
    Transposed,
    /// Nearest neighbour, then a 3x3 convolution: no checkerboard, cheaper gradients.
    Nearest,
}

/// The paper's normal backbone: two convolutions, cells N R N R N (N R N with one reduction), up,
/// convolution, max over images, one or two convolutions, cells N N N, up, convolution, unit length.
///
/// Features leave at half of the input's size: the first layer after the cells doubles the size if
/// they leave a quarter or less, the next doubles it again if they leave an eighth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellNormal {
    /// Base width C: channels of each node in the first cells.
    pub width: usize,
    /// Strides of the two stem convolutions: `[1, 1]` as published, `[1, 2]` for speed.
    pub stem_strides: [usize; 2],
    /// Reduction cells among those of the features, each followed by a normal cell; 2 as published.
    #[serde(default = "two")]
    pub reductions: usize,
    /// How feature maps grow.
    pub upsampling: Upsampling,
    /// Convolutions between the max over images and the regressor cells: 2 as published, or 1.
    pub fused_convolutions: usize,
    /// The cells.
    #[serde(default, skip_serializing_if = "CellChoice::is_open")]
    pub genotype: CellChoice<NormalGenotype>,
}

fn two() -> usize {
    2
}

impl CellNormal {
    /// How often the size must double between the feature cells and the maximum over the images: 0 to 2.
    pub fn doublings(&self) -> usize {
        let halvings = self.reductions + usize::from(self.stem_strides[1] == 2);
        halvings.saturating_sub(1)
    }
}

impl LightBody {
    /// Whether it has normalisation layers, which weights files do not hold: they are folded away.
    pub fn is_normalised(&self) -> bool {
        match self {
            Self::Plain(_) => false,
            Self::Cells(_) => true,
            Self::Staged(staged) => staged.is_normalised(),
        }
    }
}

impl NormalBody {
    /// Whether it has normalisation layers, which weights files do not hold: they are folded away.
    pub fn is_normalised(&self) -> bool {
        match self {
            Self::Plain(_) => false,
            Self::Cells(_) => true,
            Self::Staged(staged) => staged.is_normalised(),
        }
    }
}

impl LightArchitecture {
    /// The plain baseline: 262,316 parameters, views of 64x64.
    pub fn plain() -> Self {
        Self {
            input_size: 64,
            bins: LightBins::relative(),
            body: LightBody::Plain(PlainLight {
                widths: [16, 32, 64],
                hidden: 128,
            }),
        }
    }

    /// Checks ranges, and cells where they are chosen.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn validate(&self) -> Result<(), ModelError> {
        within("input_size", self.input_size, 32, 512)?;
        if !self.input_size.is_multiple_of(32) {
            return Err(ModelError::Architecture {
                what: "input_size".into(),
                found: self.input_size.to_string(),
                expected: "a multiple of 32".into(),
            });
        }
        within("azimuth classes", self.bins.azimuth, 2, 1024)?;
        within("elevation classes", self.bins.elevation, 2, 1024)?;
        let intensity = self.bins.intensity;
        within("intensity classes", intensity.count, 2, 1024)?;
        if !(intensity.low > 0.0 && intensity.high > intensity.low && intensity.high.is_finite()) {
            return Err(ModelError::Architecture {
                what: "intensity range".into(),
                found: format!("{} to {}", intensity.low, intensity.high),
                expected: "0 < low < high".into(),
            });
        }
        match &self.body {
            LightBody::Plain(plain) => {
                for width in plain.widths {
                    within("width", width, 1, 1024)?;
                }
                within("hidden", plain.hidden, 1, 4096)
            }
            LightBody::Staged(staged) => staged.validate(self.input_size),
            LightBody::Cells(cells) => {
                within("width", cells.width, 1, 256)?;
                within("hidden", cells.hidden, 1, 4096)?;
                for stride in cells.stem_strides {
                    within("stem stride", stride, 1, 2)?;
                }
                within("reductions", cells.reductions, 0, 2)?;
                cells
                    .genotype
                    .chosen()
                    .map_or(Ok(()), LightGenotype::validate)
            }
        }
    }
}

impl NormalArchitecture {
    /// The plain baseline: 126,515 parameters.
    pub fn plain() -> Self {
        Self {
            mask_channel: false,
            body: NormalBody::Plain(PlainNormal::new([16, 32, 64], 32)),
        }
    }

    /// How many pixels of a larger picture a tile of it needs around itself: what its network sees.
    pub(crate) fn overlap(&self) -> usize {
        match &self.body {
            NormalBody::Plain(_) | NormalBody::Cells(_) => OVERLAP,
            NormalBody::Staged(staged) => staged
                .reach()
                .next_multiple_of(NormalNetwork::ALIGNMENT)
                .max(OVERLAP),
        }
    }

    /// Number of input channels: image, light direction, perhaps the mask.
    pub fn input_channels(&self) -> usize {
        NormalInput::channels(self.mask_channel)
    }

    /// Checks ranges, and cells where they are chosen.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn validate(&self) -> Result<(), ModelError> {
        match &self.body {
            NormalBody::Plain(plain) => {
                for width in plain.widths {
                    within("width", width, 1, 1024)?;
                }
                // Tiles of large pictures overlap by what networks see, see `normal_stage`.
                within("residuals", plain.residuals, 0, 2)?;
                within("pixel_branch", plain.pixel_branch, 0, 1024)?;
                within("head", plain.head, 1, 1024)
            }
            NormalBody::Staged(staged) => staged.validate(),
            NormalBody::Cells(cells) => {
                within("width", cells.width, 1, 256)?;
                within("fused_convolutions", cells.fused_convolutions, 1, 2)?;
                within("first stem stride", cells.stem_strides[0], 1, 1)?;
                within("second stem stride", cells.stem_strides[1], 1, 2)?;
                // Features leave at half of the input's size.
                let fewest = 2 - cells.stem_strides[1];
                within("reductions", cells.reductions, fewest, 2)?;
                cells
                    .genotype
                    .chosen()
                    .map_or(Ok(()), NormalGenotype::validate)
            }
        }
    }
}

pub(crate) fn within(what: &str, found: usize, low: usize, high: usize) -> Result<(), ModelError> {
    if (low..=high).contains(&found) {
        return Ok(());
    }
    Err(ModelError::Architecture {
        what: what.to_owned(),
        found: found.to_string(),
        expected: format!("{low} to {high}"),
    })
}
