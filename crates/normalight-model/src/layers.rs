use burn::module::Module;
use burn::nn::conv::{Conv2d, Conv2dConfig};
use burn::nn::{BatchNorm, BatchNormConfig, PaddingConfig2d};
use burn::tensor::module::interpolate;
use burn::tensor::ops::{InterpolateMode, InterpolateOptions};
use burn::tensor::{Device, Tensor, activation};

/// Slope of the leaky ReLU of all plain layers.
const LEAK: f32 = 0.1;

/// A convolution with bias, "same" padding and a stride, no activation.
pub(crate) fn convolution(
    [channels_in, channels_out]: [usize; 2],
    kernel: usize,
    stride: usize,
    device: &Device,
) -> Conv2d {
    let padding = kernel / 2;
    Conv2dConfig::new([channels_in, channels_out], [kernel, kernel])
        .with_stride([stride, stride])
        .with_padding(PaddingConfig2d::Explicit(
            padding, padding, padding, padding,
        ))
        .init(device)
}

/// A depthwise convolution without bias.
pub(crate) fn depthwise(channels: usize, kernel: usize, stride: usize, device: &Device) -> Conv2d {
    let padding = kernel / 2;
    Conv2dConfig::new([channels, channels], [kernel, kernel])
        .with_stride([stride, stride])
        .with_groups(channels)
        .with_bias(false)
        .with_padding(PaddingConfig2d::Explicit(
            padding, padding, padding, padding,
        ))
        .init(device)
}

/// Leaky ReLU of slope 0.1.
pub(crate) fn leaky<const D: usize>(input: Tensor<D>) -> Tensor<D> {
    activation::leaky_relu(input, f64::from(LEAK))
}

/// A layer of [`convolution`] and leaky ReLU.
pub(crate) fn convolve_leaky(conv: &Conv2d, input: Tensor<4>) -> Tensor<4> {
    convolve_slope(conv, input, LEAK)
}

/// A layer of [`convolution`] alone.
pub(crate) fn convolve(conv: &Conv2d, input: Tensor<4>) -> Tensor<4> {
    convolve_slope(conv, input, 1.0)
}

/// A row of layers of [`convolution`] and leaky ReLU.
pub(crate) fn convolve_row(convolutions: &[Conv2d], input: Tensor<4>) -> Tensor<4> {
    convolutions
        .iter()
        .fold(input, |input, conv| convolve_leaky(conv, input))
}

fn convolve_slope(conv: &Conv2d, input: Tensor<4>, slope: f32) -> Tensor<4> {
    let Some(bias) = &conv.bias else {
        unreachable!("`convolution` gives every layer a bias");
    };
    normalight_kernels::convolution(input, conv.weight.val(), bias.val(), conv.stride[0], slope)
}

/// Nearest-neighbour upsampling by two.
///
/// # Shapes
/// - input: `[batch, channels, height, width]`
/// - output: `[batch, channels, 2 height, 2 width]`
pub(crate) fn doubled(input: Tensor<4>) -> Tensor<4> {
    let [_, _, height, width] = input.dims();
    let nearest = InterpolateOptions::new(InterpolateMode::Nearest);
    interpolate(input, nearest.with_output_size([2 * height, 2 * width]))
}

/// A convolution without bias and its batch normalisation; folded into one convolution with bias
/// for storing and for inference.
#[derive(Module, Debug)]
pub(crate) struct NormedConv {
    conv: Conv2d,
    norm: Option<BatchNorm>,
}

impl NormedConv {
    /// A 1x1 convolution; `folded` leaves the normalisation out and gives the convolution a bias.
    pub(crate) fn pointwise(
        channels: [usize; 2],
        stride: usize,
        folded: bool,
        device: &Device,
    ) -> Self {
        Self {
            conv: Conv2dConfig::new(channels, [1, 1])
                .with_stride([stride, stride])
                .with_bias(folded)
                .init(device),
            norm: (!folded).then(|| BatchNormConfig::new(channels[1]).init(device)),
        }
    }

    /// # Shapes
    /// - input: `[batch, channels_in, height, width]`
    /// - output: `[batch, channels_out, height / stride, width / stride]`
    pub(crate) fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let output = self.conv.forward(input);
        match &self.norm {
            Some(norm) => norm.forward(output),
            None => output,
        }
    }

    /// The same function as one convolution with bias, with the running statistics.
    pub(crate) fn folded(&self) -> Self {
        let Some(norm) = &self.norm else {
            return self.clone();
        };
        let scale = norm.gamma.val() / (norm.running_var.value() + norm.epsilon).sqrt();
        let bias = norm.beta.val() - norm.running_mean.value() * scale.clone();
        let channels = scale.dims()[0];
        let mut conv = self.conv.clone();
        conv.weight = conv
            .weight
            .map(|weight| weight * scale.reshape([channels, 1, 1, 1]));
        conv.bias = Some(burn::module::Param::from_tensor(bias));
        Self { conv, norm: None }
    }
}

/// Halves the size without losing every other pixel: two 1x1 convolutions of stride 2, the second
/// on the input shifted by one pixel, side by side (DARTS).
#[derive(Module, Debug)]
pub(crate) struct FactorizedReduce {
    even: NormedConv,
    odd: NormedConv,
}

impl FactorizedReduce {
    pub(crate) fn new(channels: [usize; 2], folded: bool, device: &Device) -> Self {
        let [channels_in, channels_out] = channels;
        let even = channels_out / 2;
        Self {
            even: NormedConv::pointwise([channels_in, even], 2, folded, device),
            odd: NormedConv::pointwise([channels_in, channels_out - even], 2, folded, device),
        }
    }

    /// # Shapes
    /// - input: `[batch, channels_in, height, width]`, even sides
    /// - output: `[batch, channels_out, height / 2, width / 2]`
    pub(crate) fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let input = activation::relu(input);
        let [batch, channels, height, width] = input.dims();
        let shifted = input
            .clone()
            .slice([0..batch, 0..channels, 1..height, 1..width]);
        // Batch normalisation works per channel, so normalising the halves is the same as
        // normalising both together.
        Tensor::cat(vec![self.even.forward(input), self.odd.forward(shifted)], 1)
    }

    pub(crate) fn folded(&self) -> Self {
        Self {
            even: self.even.folded(),
            odd: self.odd.folded(),
        }
    }
}
