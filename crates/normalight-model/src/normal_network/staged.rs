//! The network of stages.
use super::fused::FusedFeatures;
use super::pixel_branch::{PixelBranch, output};
use crate::layers::{Form, convolution, convolve_leaky};
use crate::stage_layers::{Resize, StageLayers, folded_stages, forward_stages, stage_row};
use crate::{Meeting, Stage, StagedNormal};
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
    pixels: Option<PixelBranch>,
    output: Conv2d,
}

impl StagedBody {
    pub(super) fn new(staged: &StagedNormal, channels: usize, form: Form, device: &Device) -> Self {
        let row = |width: usize, stages: &[Stage], how: ([Resize; 2], bool)| {
            stage_row(width, stages, how, form, device)
        };
        let down = row(
            channels,
            &staged.down,
            ([Resize::Keep, Resize::Halve], true),
        );
        let last = staged.down.last().map_or(0, |stage| stage.width);
        let up = row(last, &staged.up, ([Resize::Double; 2], false));
        let meeting = staged.meeting_width();
        let kept = meeting * staged.meeting.widths();
        let fused = row(kept, &staged.fused, ([Resize::Keep, Resize::Double], false));
        let head = staged.fused.last().map_or(0, |stage| stage.width);
        let joined = head + staged.pixels.map_or(0, |pixels| 2 * pixels.width);
        let pixels = staged.pixels.map(|pixels| {
            let layers = (pixels.width, pixels.layers);
            PixelBranch::new(channels, layers, head, device)
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
        let pixels = self.pixels.as_ref().filter(|_| is_last);
        let pixels = pixels.map(|branch| branch.fuse(input.clone(), stacks));
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
        forward_stages(self.down.iter().chain(&self.up), input)
    }

    /// Normals before they get unit length.
    pub(super) fn regress(&self, fused: FusedFeatures) -> Tensor<4> {
        let features = match self.keeps_mean {
            true => Tensor::cat(vec![fused.features.clone(), fused.mean()], 3),
            false => fused.features.clone(),
        };
        let head = forward_stages(&self.fused, features);
        output(self.pixels.as_ref(), &self.output, head, fused)
    }

    pub(super) fn folded(&self) -> Self {
        Self {
            down: folded_stages(&self.down),
            up: folded_stages(&self.up),
            fused: folded_stages(&self.fused),
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
