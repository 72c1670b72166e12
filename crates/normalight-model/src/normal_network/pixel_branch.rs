//! Layers on colour and light of every pixel by itself, which keep the detail that strides lose.
use super::fused::{FusedFeatures, FusedPixels};
use crate::layers::{convolution, convolve, convolve_leaky, convolve_row};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::tensor::{Device, Tensor};

#[derive(Module, Debug)]
pub(super) struct PixelBranch {
    /// 1x1, on every image.
    layers: Vec<Conv2d>,
    /// On the head beside maximum and mean over the images.
    join: Conv2d,
}

impl PixelBranch {
    /// So many layers of a width, for a head of so many channels.
    pub(super) fn new(
        channels: usize,
        (width, layers): (usize, usize),
        head: usize,
        device: &Device,
    ) -> Self {
        let layer = |place: usize| {
            let from = if place == 0 { channels } else { width };
            convolution([from, width], 1, 1, device)
        };
        Self {
            layers: (0..layers).map(layer).collect(),
            join: convolution([head + 2 * width, head], 3, 1, device),
        }
    }

    pub(super) fn fuse(&self, input: Tensor<4>, stacks: usize) -> FusedPixels {
        FusedPixels::of(convolve_row(&self.layers, input), stacks)
    }
}

/// What the last layer makes of the head, and of single pixels in networks that have a branch for them.
pub(super) fn output(
    branch: Option<&PixelBranch>,
    output: &Conv2d,
    head: Tensor<4>,
    fused: FusedFeatures,
) -> Tensor<4> {
    let (Some(branch), Some(pixels)) = (branch, fused.pixels) else {
        return convolve(output, head);
    };
    let beside = pixels.beside(fused.images);
    let joined = convolve_leaky(&branch.join, beside(head));
    convolve(output, beside(joined))
}
