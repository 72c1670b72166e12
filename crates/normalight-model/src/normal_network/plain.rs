//! The plain network: 3x3 convolutions, perhaps with a branch that sees single pixels.
use super::fused::FusedFeatures;
use super::pixel_branch::{PixelBranch, output};
use crate::PlainNormal;
use crate::layers::{convolution, convolve_doubled, convolve_leaky, convolve_row};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::tensor::{Device, Tensor};
use normalight_kernels::max_over_images;

/// Convolutions of the plain network; upsampling happens where the forward pass says.
#[derive(Module, Debug)]
pub(super) struct PlainBody {
    down: Vec<Conv2d>,
    /// At a quarter of the size, each added to what it was given.
    residual: Vec<Conv2d>,
    up: Vec<Conv2d>,
    fused: Vec<Conv2d>,
    head: Conv2d,
    pixels: Option<PixelBranch>,
    output: Conv2d,
}

impl PlainBody {
    pub(super) fn new(plain: &PlainNormal, channels: usize, device: &Device) -> Self {
        let [a, b, c] = plain.widths;
        let conv = |channels, stride| convolution(channels, 3, stride, device);
        let joined = plain.head + 2 * plain.pixel_branch;
        Self {
            down: vec![
                conv([channels, a], 1),
                conv([a, b], 2),
                conv([b, b], 1),
                conv([b, c], 2),
                conv([c, c], 1),
            ],
            residual: (0..plain.residuals).map(|_| conv([c, c], 1)).collect(),
            up: vec![conv([c, b], 1), conv([b, b], 1)],
            fused: vec![conv([b, b], 1), conv([b, b], 1)],
            head: conv([b, plain.head], 1),
            pixels: (plain.pixel_branch > 0).then(|| {
                let layers = (plain.pixel_branch, 2);
                PixelBranch::new(channels, layers, plain.head, device)
            }),
            output: conv([joined, 3], 1),
        }
    }

    /// Features of every image by itself, at half of the size.
    fn features(&self, input: Tensor<4>) -> Tensor<4> {
        let small = convolve_row(&self.down, input);
        let small = self.residual.iter().fold(small, |small, layer| {
            small.clone() + convolve_leaky(layer, small)
        });
        let large = convolve_doubled(&self.up[0], small);
        convolve_row(&self.up[1..], large)
    }

    pub(super) fn fuse(&self, input: Tensor<4>, stacks: usize) -> FusedFeatures {
        let images = input.dims()[0] / stacks;
        let pixels = self.pixels.as_ref();
        let pixels = pixels.map(|branch| branch.fuse(input.clone(), stacks));
        FusedFeatures {
            sum: None,
            features: max_over_images(self.features(input), stacks),
            pixels,
            images,
        }
    }

    /// Normals before they get unit length.
    pub(super) fn regress(&self, fused: FusedFeatures) -> Tensor<4> {
        let features = convolve_row(&self.fused, fused.features.clone());
        let head = convolve_doubled(&self.head, features);
        output(self.pixels.as_ref(), &self.output, head, fused)
    }
}
