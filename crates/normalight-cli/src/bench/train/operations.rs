//! Every operation of ours against the same made of Burn's.
use crate::bench::median_seconds;
use burn::tensor::{Device, Distribution, Tensor};
use normalight_kernels::{
    BatchMoments, Convolution, batch_norm, convolution, depthwise_relu, generic, max_over_images,
    transposed_convolution,
};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Times of one operation, forward and backward.
#[derive(Debug, Serialize)]
pub(super) struct OperationCase {
    pub(super) name: String,
    pub(super) threads: usize,
    pub(super) own_ms: f64,
    pub(super) generic_ms: f64,
}

/// Input, weight and bias to an output.
type Run = fn(Tensor<4>, Tensor<4>, Tensor<1>) -> Tensor<4>;

pub(super) struct Operation {
    name: &'static str,
    input: [usize; 4],
    weight: [usize; 4],
    bias: usize,
    run: Run,
}

const IMAGES: usize = 160;

/// Sizes as the networks have them in a step of 16 samples of ten crops.
pub(super) fn all() -> Vec<Operation> {
    let plain: Run = |x, w, b| convolution(x, w, b, how(1, 1));
    let strided: Run = |x, w, b| convolution(x, w, b, how(2, 1));
    let enlarged: Run = |x, w, b| convolution(x, w, b, how(1, 2));
    let transposed: Run = |x, w, b| transposed_convolution(x, w, b, 0.1);
    let depthwise: Run = |x, w, _| depthwise_relu(x, w, 1);
    let depthwise_strided: Run = |x, w, _| depthwise_relu(x, w, 2);
    let normalised: Run = |x, w, b| {
        let moments = BatchMoments::new(&x);
        batch_norm(x, &moments, w.flatten(0, 3), b, 1e-5)
    };
    let most: Run = |x, _, _| max_over_images(x, 16);
    let map = |side, channels| [IMAGES, side, side, channels];
    let case = |name, input, weight, bias, run| Operation {
        name,
        input,
        weight,
        bias,
        run,
    };
    vec![
        case(
            "convolution 3x3 6->16, 32x32",
            map(32, 6),
            [16, 6, 3, 3],
            16,
            plain,
        ),
        case(
            "convolution 3x3 32->32, 16x16",
            map(16, 32),
            [32, 32, 3, 3],
            32,
            plain,
        ),
        case(
            "convolution 3x3 128->128, 8x8",
            map(8, 128),
            [128, 128, 3, 3],
            128,
            plain,
        ),
        case(
            "convolution 3x3 32->64 stride 2, 16x16",
            map(16, 32),
            [64, 32, 3, 3],
            64,
            strided,
        ),
        case(
            "upsampling, convolution 3x3 64->32, 8x8",
            map(8, 64),
            [32, 64, 3, 3],
            32,
            enlarged,
        ),
        case(
            "transposed convolution 64->32, 8x8",
            map(8, 64),
            [64, 32, 4, 4],
            32,
            transposed,
        ),
        case(
            "convolution 1x1 32->32, 16x16",
            map(16, 32),
            [32, 32, 1, 1],
            32,
            plain,
        ),
        case(
            "depthwise 3x3 16, 16x16",
            map(16, 16),
            [16, 1, 3, 3],
            1,
            depthwise,
        ),
        case(
            "depthwise 5x5 16, 16x16",
            map(16, 16),
            [16, 1, 5, 5],
            1,
            depthwise,
        ),
        case(
            "depthwise 5x5 16 stride 2, 16x16",
            map(16, 16),
            [16, 1, 5, 5],
            1,
            depthwise_strided,
        ),
        case(
            "batch norm 32, 16x16",
            map(16, 32),
            [32, 1, 1, 1],
            32,
            normalised,
        ),
        case(
            "max over images 32, 16x16",
            map(16, 32),
            [1, 1, 1, 1],
            1,
            most,
        ),
    ]
}

fn how(stride: usize, upsampling: usize) -> Convolution {
    Convolution {
        stride,
        upsampling,
        slope: 0.1,
        ..Convolution::default()
    }
}

impl Operation {
    pub(super) fn measure(
        &self,
        device: &Device,
        threads: usize,
        least: Duration,
    ) -> OperationCase {
        let device = device.clone().autodiff();
        let random = |shape| Tensor::<4>::random(shape, Distribution::Default, &device);
        let (input, weight) = (random(self.input), random(self.weight));
        let bias = Tensor::<1>::zeros([self.bias], &device).require_grad();
        let once = || {
            let start = Instant::now();
            let tracked = input.clone().detach().require_grad();
            let weight = weight.clone().detach().require_grad();
            let output = (self.run)(tracked, weight, bias.clone());
            std::hint::black_box(output.sum().backward());
            [start.elapsed()]
        };
        let [own] = median_seconds(least, once);
        let [composed] = generic(|| median_seconds(least, once));
        OperationCase {
            name: self.name.to_owned(),
            threads,
            own_ms: 1e3 * own,
            generic_ms: 1e3 * composed,
        }
    }
}
