//! Networks of stages: what the search of whole networks chooses among. The plain networks are points of this space.
use crate::ModelError;
use crate::architecture::within;
use serde::{Deserialize, Serialize};

/// Halvings that [`NormalNetwork::ALIGNMENT`](crate::NormalNetwork::ALIGNMENT) allows.
const MAX_HALVINGS: usize = 3;
/// Widest stage, in channels, and most layers of one.
const MAX_WIDTH: usize = 1024;
const MAX_LAYERS: usize = 8;

/// What a layer of a stage is. A leaky ReLU follows each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LayerKind {
    /// A 3x3 convolution.
    Convolution3,
    /// ReLU, a depthwise 3x3 convolution, a 1x1 convolution.
    Separable3,
    /// ReLU, a depthwise 5x5 convolution, a 1x1 convolution.
    Separable5,
    /// A 1x1 convolution.
    Pointwise,
    /// A 4x4 transposed convolution where the size doubles, a 3x3 convolution elsewhere.
    Transposed4,
}

impl LayerKind {
    /// Those among which a search chooses.
    pub const SEARCHED: [Self; 4] = [
        Self::Convolution3,
        Self::Separable3,
        Self::Separable5,
        Self::Pointwise,
    ];

    /// Side of the depthwise convolution, of kinds that have one.
    pub fn depthwise(self) -> Option<usize> {
        match self {
            Self::Separable3 => Some(3),
            Self::Separable5 => Some(5),
            Self::Convolution3 | Self::Pointwise | Self::Transposed4 => None,
        }
    }

    /// Side of the square of pixels that one output pixel sees.
    pub fn side(self) -> usize {
        match self {
            Self::Convolution3 | Self::Transposed4 => 3,
            Self::Pointwise => 1,
            Self::Separable3 | Self::Separable5 => self.depthwise().unwrap_or(1),
        }
    }
}

/// Layers of one size and width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// Channels.
    pub width: usize,
    /// Number of layers; where the size changes, the first changes it.
    #[serde(default = "one")]
    pub layers: usize,
    /// What they are.
    #[serde(default = "convolution")]
    pub kind: LayerKind,
    /// Whether layers after the first are added to what they were given.
    #[serde(default, skip_serializing_if = "is_false")]
    pub residual: bool,
    /// Whether batch normalisation follows each convolution to its width; folded away in weights files.
    #[serde(default, skip_serializing_if = "is_false")]
    pub normalised: bool,
}

impl Stage {
    /// 3x3 convolutions, neither residual nor normalised.
    pub fn plain(width: usize, layers: usize) -> Self {
        Self {
            width,
            layers,
            kind: LayerKind::Convolution3,
            residual: false,
            normalised: false,
        }
    }

    fn validate(&self) -> Result<(), ModelError> {
        within("width of a stage", self.width, 1, MAX_WIDTH)?;
        if self.kind == LayerKind::Transposed4 && self.normalised {
            return Err(ModelError::Architecture {
                what: "a stage of transposed convolutions".into(),
                found: "normalised".into(),
                expected: "not normalised".into(),
            });
        }
        within("layers of a stage", self.layers, 1, MAX_LAYERS)
    }
}

/// What is kept of the features of all images.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Meeting {
    /// Their maximum.
    #[default]
    Max,
    /// Maximum and mean side by side.
    MaxMean,
}

impl Meeting {
    /// How many times as wide as the features what is kept is.
    pub fn widths(self) -> usize {
        match self {
            Self::Max => 1,
            Self::MaxMean => 2,
        }
    }
}

/// Layers on every pixel by itself, at full size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PixelStage {
    /// Channels.
    pub width: usize,
    /// Number of 1x1 convolutions on every image.
    pub layers: usize,
}

/// A normal estimation network of stages.
///
/// Every image by itself goes through `down`, whose first stage keeps the size and whose others halve it, and `up`, each of
/// which doubles it. There the images meet, perhaps after exchanges: each image's features beside maximum and mean of all,
/// a layer, as often as said. Then `fused`, whose first stage keeps the size and whose others double it up to the full
/// one, and a 3x3 convolution to the three numbers of a normal.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StagedNormal {
    /// From full size down.
    pub down: Vec<Stage>,
    /// Up to where the images meet.
    #[serde(default)]
    pub up: Vec<Stage>,
    /// What is kept of the images.
    #[serde(default)]
    pub meeting: Meeting,
    /// How often images exchange before; each time all of their features are computed once more.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub exchanges: usize,
    /// From where the images met up to full size.
    pub fused: Vec<Stage>,
    /// The branch of single pixels, whose maximum and mean over the images join the last stage.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixels: Option<PixelStage>,
}

impl StagedNormal {
    /// Channels of the features where images meet.
    pub fn meeting_width(&self) -> usize {
        self.up
            .last()
            .or(self.down.last())
            .map_or(0, |stage| stage.width)
    }

    /// How often the size is halved where the images meet.
    pub fn meeting_halvings(&self) -> usize {
        self.down.len().saturating_sub(1 + self.up.len())
    }

    /// Whether any stage is normalised.
    pub fn is_normalised(&self) -> bool {
        let mut stages = self.down.iter().chain(&self.up).chain(&self.fused);
        stages.any(|stage| stage.normalised)
    }

    pub(crate) fn validate(&self) -> Result<(), ModelError> {
        within("stages of down", self.down.len(), 1, 1 + MAX_HALVINGS)?;
        within("stages of up", self.up.len(), 0, self.down.len() - 1)?;
        let fused = 1 + self.meeting_halvings();
        within("stages of fused", self.fused.len(), fused, fused)?;
        within("exchanges", self.exchanges, 0, 2)?;
        for stage in self.down.iter().chain(&self.up).chain(&self.fused) {
            stage.validate()?;
        }
        if let Some(pixels) = &self.pixels {
            within("width of pixels", pixels.width, 1, MAX_WIDTH)?;
            within("layers of pixels", pixels.layers, 1, MAX_LAYERS)?;
        }
        Ok(())
    }

    /// How many pixels away what one output pixel sees may lie.
    pub fn reach(&self) -> usize {
        let mut halvings = 0;
        let mut reach = 0;
        let mut walk = |stages: &[Stage], first: &dyn Fn(usize) -> i32| {
            for (place, stage) in stages.iter().enumerate() {
                let change = first(place);
                for layer in 0..stage.layers {
                    // A layer that halves sees pixels of the size before, one that doubles those of the size after
                    // unless it is depthwise, which comes before, or itself doubles.
                    let grows = layer == 0 && change < 0;
                    let small =
                        stage.kind.depthwise().is_some() || stage.kind == LayerKind::Transposed4;
                    let seen = match grows && !small {
                        true => halvings - 1,
                        false => halvings,
                    };
                    reach += (stage.kind.side() / 2) << seen;
                    if grows {
                        halvings -= 1;
                    } else if layer == 0 && change > 0 {
                        halvings += 1;
                    }
                }
            }
        };
        walk(&self.down, &|place| i32::from(place > 0));
        walk(&self.up, &|_| -1);
        walk(&self.fused, &|place| -i32::from(place > 0));
        reach += self.exchanges << self.meeting_halvings();
        // The output layer, and the one where single pixels join.
        reach += 1 + usize::from(self.pixels.is_some());
        // Pixels of a smaller picture stand for a square of larger ones.
        reach + (1 << (self.down.len() - 1))
    }
}

/// A light calibration network of stages.
///
/// Every image by itself goes through `features`, each stage of which halves the size; beside the maximum over the images
/// it goes through `classifier`, whose first stage keeps the size and whose others halve it, and two fully connected layers.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StagedLight {
    /// On every image by itself.
    pub features: Vec<Stage>,
    /// On its features and the maximum of all.
    pub classifier: Vec<Stage>,
    /// Units of the hidden fully connected layer.
    pub hidden: usize,
}

impl StagedLight {
    /// How often the size is halved.
    pub fn halvings(&self) -> usize {
        (self.features.len() + self.classifier.len()).saturating_sub(1)
    }

    /// Whether any stage is normalised.
    pub fn is_normalised(&self) -> bool {
        let mut stages = self.features.iter().chain(&self.classifier);
        stages.any(|stage| stage.normalised)
    }

    /// Side of the last maps for views of this side, and numbers that enter the hidden layer.
    pub(crate) fn last(&self, input_size: usize) -> (usize, usize) {
        let side = input_size >> self.halvings();
        let width = self.classifier.last().map_or(0, |stage| stage.width);
        (side, width * side * side)
    }

    pub(crate) fn validate(&self, input_size: usize) -> Result<(), ModelError> {
        within("stages of features", self.features.len(), 1, 5)?;
        within("stages of classifier", self.classifier.len(), 1, 4)?;
        // Each halving leaves whole pixels, the last at least one.
        within("halvings", self.halvings(), 1, 7)?;
        within("side of the last maps", self.last(input_size).0, 1, 16)?;
        for stage in self.features.iter().chain(&self.classifier) {
            stage.validate()?;
        }
        within("hidden", self.hidden, 1, 4096)
    }
}

fn one() -> usize {
    1
}

fn convolution() -> LayerKind {
    LayerKind::Convolution3
}

fn is_false(flag: &bool) -> bool {
    !*flag
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain() -> StagedNormal {
        StagedNormal {
            down: vec![
                Stage::plain(16, 1),
                Stage::plain(32, 2),
                Stage::plain(64, 2),
            ],
            up: vec![Stage::plain(32, 2)],
            meeting: Meeting::Max,
            exchanges: 0,
            fused: vec![Stage::plain(32, 2), Stage::plain(32, 1)],
            pixels: None,
        }
    }

    #[test]
    fn the_reach_of_the_plain_network_by_hand() {
        // Full size: 1 layer; its stride: 1; half: 1, its stride 2; quarter: 4; up: 2 and 2; fused: 2 and 2; head: 1; output 1.
        let layers = 1 + 1 + 2 + 2 + 4 + 2 + 2 + 2 + 2 + 1 + 1;
        assert_eq!(plain().reach(), layers + 4);
    }

    #[test]
    fn stages_that_do_not_fit_are_named() {
        let broken = |change: &dyn Fn(&mut StagedNormal)| {
            let mut staged = plain();
            change(&mut staged);
            staged.validate().unwrap_err().to_string()
        };
        assert!(plain().validate().is_ok());
        let error = broken(&|staged| staged.fused.truncate(1));
        assert!(error.contains("stages of fused"), "{error}");
        let error = broken(&|staged| staged.up = vec![Stage::plain(8, 1); 3]);
        assert!(error.contains("stages of up"), "{error}");
        let error = broken(&|staged| staged.down.clear());
        assert!(error.contains("stages of down"), "{error}");
        let error = broken(&|staged| staged.down[1].layers = 0);
        assert!(error.contains("layers of a stage"), "{error}");
    }
}
