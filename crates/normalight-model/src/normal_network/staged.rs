//! The network of stages.
use super::fused::{FusedFeatures, FusedPixels};
use crate::layers::{Form, convolution, convolve, convolve_leaky, convolve_row};
use crate::stage_layers::{Resize, StageLayers};
use crate::{Meeting, StagedNormal};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::tensor::{Device, Tensor};
use normalight_kernels::max_over_images;

#[derive(Module, Debug)]
pub(super) struct StagedBody {
    down: Vec<StageLayers>,
    up: Vec<StageLayers>,
    /// On each image's features beside maximum and mean of all.
    exchanges: Vec<Conv2d>,
    keeps_mean: bool,
    fused: Vec<StageLayers>,
    pixels: Option<PixelLayers>,
    output: Conv2d,
}

#[derive(Module, Debug)]
struct PixelLayers {
    /// 1x1, on every image.
    layers: Vec<Conv2d>,
    /// On the last stage beside maximum and mean over the images.
    join: Conv2d,
}

impl StagedBody {
    pub(super) fn new(staged: &StagedNormal, channels: usize, form: Form, device: &Device) -> Self {
        let mut width = channels;
        let mut build = |stages: &[crate::Stage], resize: [Resize; 2], is_input: bool| {
            let layers = stages.iter().enumerate().map(|(place, stage)| {
                let is_first = is_input && place == 0;
                let resize = resize[usize::from(place > 0)];
                let from = std::mem::replace(&mut width, stage.width);
                StageLayers::new(from, stage, (resize, is_first), form, device)
            });
            layers.collect::<Vec<_>>()
        };
        let down = build(&staged.down, [Resize::Keep, Resize::Halve], true);
        let up = build(&staged.up, [Resize::Double; 2], false);
        let meeting = staged.meeting_width();
        width = meeting * staged.meeting.widths();
        let mut build = |stages: &[crate::Stage]| {
            let layers = stages.iter().enumerate().map(|(place, stage)| {
                let resize = if place == 0 {
                    Resize::Keep
                } else {
                    Resize::Double
                };
                let from = std::mem::replace(&mut width, stage.width);
                StageLayers::new(from, stage, (resize, false), form, device)
            });
            layers.collect::<Vec<_>>()
        };
        let fused = build(&staged.fused);
        let head = staged.fused.last().map_or(0, |stage| stage.width);
        let joined = head + staged.pixels.map_or(0, |pixels| 2 * pixels.width);
        let pixels = staged.pixels.map(|pixels| {
            let layer = |place: usize| {
                let from = if place == 0 { channels } else { pixels.width };
                convolution([from, pixels.width], 1, 1, device)
            };
            PixelLayers {
                layers: (0..pixels.layers).map(layer).collect(),
                join: convolution([joined, head], 3, 1, device),
            }
        });
        Self {
            down,
            up,
            exchanges: (0..staged.exchanges)
                .map(|_| convolution([3 * meeting, meeting], 3, 1, device))
                .collect(),
            keeps_mean: staged.meeting == Meeting::MaxMean,
            fused,
            pixels,
            output: convolution([joined, 3], 3, 1, device),
        }
    }

    /// How often the features of all images are computed.
    pub(super) fn passes(&self) -> usize {
        1 + self.exchanges.len()
    }

    /// What is kept of images after as many exchanges as there are passes before.
    pub(super) fn fuse(
        &self,
        input: Tensor<4>,
        stacks: usize,
        before: &[FusedFeatures],
    ) -> FusedFeatures {
        let images = input.dims()[0] / stacks;
        let is_last = before.len() == self.exchanges.len();
        let pixels = self
            .pixels
            .as_ref()
            .filter(|_| is_last)
            .map(|branch| FusedPixels::of(convolve_row(&branch.layers, input.clone()), stacks));
        let features = self.features(input);
        let features = self.exchanges.iter().zip(before).fold(features, exchanged);
        let keeps_mean = self.keeps_mean || !is_last;
        FusedFeatures {
            sum: keeps_mean.then(|| sum_over_images(features.clone(), stacks)),
            features: max_over_images(features, stacks),
            pixels,
            images,
        }
    }

    fn features(&self, input: Tensor<4>) -> Tensor<4> {
        let stages = self.down.iter().chain(&self.up);
        stages.fold(input, |input, stage| stage.forward(input))
    }

    /// Normals before they get unit length.
    pub(super) fn regress(&self, fused: FusedFeatures) -> Tensor<4> {
        let features = match self.keeps_mean {
            true => Tensor::cat(vec![fused.features.clone(), fused.mean()], 3),
            false => fused.features.clone(),
        };
        let stages = self.fused.iter();
        let head = stages.fold(features, |input, stage| stage.forward(input));
        let (Some(branch), Some(pixels)) = (&self.pixels, fused.pixels) else {
            return convolve(&self.output, head);
        };
        let beside = pixels.beside(fused.images);
        let joined = convolve_leaky(&branch.join, beside(head));
        convolve(&self.output, beside(joined))
    }

    pub(super) fn folded(&self) -> Self {
        let fold = |stages: &[StageLayers]| stages.iter().map(StageLayers::folded).collect();
        Self {
            down: fold(&self.down),
            up: fold(&self.up),
            fused: fold(&self.fused),
            ..self.clone()
        }
    }
}

/// Each image's features after it has seen what all have.
fn exchanged(features: Tensor<4>, (layer, all): (&Conv2d, &FusedFeatures)) -> Tensor<4> {
    let [rows, height, width, channels] = features.dims();
    let stacks = all.features.dims()[0];
    let for_each = |map: Tensor<4>| {
        map.reshape([stacks, 1, height, width, channels])
            .repeat_dim(1, rows / stacks)
            .reshape([rows, height, width, channels])
    };
    let beside = vec![
        features,
        for_each(all.features.clone()),
        for_each(all.mean()),
    ];
    convolve_leaky(layer, Tensor::cat(beside, 3))
}

/// `[stacks, height, width, channels]` of `[stacks * images, height, width, channels]`.
pub(super) fn sum_over_images(map: Tensor<4>, stacks: usize) -> Tensor<4> {
    let [rows, height, width, channels] = map.dims();
    map.reshape([stacks, rows / stacks, height * width * channels])
        .sum_dim(1)
        .reshape([stacks, height, width, channels])
}
