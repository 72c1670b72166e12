//! Layers; feature maps are channels last, `[batch, height, width, channels]`.

use burn::module::Module;
use burn::nn::conv::{Conv2d, Conv2dConfig, ConvTranspose2d, ConvTranspose2dConfig};
use burn::nn::{BatchNorm, BatchNormConfig, PaddingConfig2d};
use burn::tensor::{Device, Tensor, activation};
use normalight_kernels::{
    BatchMoments, Convolution, batch_norm, scale_channels, transposed_convolution,
};

/// Slope of the leaky ReLU of all plain layers.
pub const LEAK: f32 = 0.1;

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

/// A transposed convolution with bias that doubles the size.
pub(crate) fn transposed_doubling(channels: [usize; 2], device: &Device) -> ConvTranspose2d {
    ConvTranspose2dConfig::new(channels, [4, 4])
        .with_stride([2, 2])
        .with_padding([1, 1])
        .init(device)
}

/// The same on a map, then a leaky ReLU.
pub(crate) fn doubled_by(conv: &ConvTranspose2d, input: Tensor<4>) -> Tensor<4> {
    let Some(bias) = &conv.bias else {
        unreachable!("`transposed_doubling` gives a bias");
    };
    transposed_convolution(input, conv.weight.val(), bias.val(), LEAK)
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
///
/// # Shapes
/// - input: `[batch, height, width, channels_in]`
/// - output: `[batch, height / stride, width / stride, channels_out]`
pub(crate) fn convolve_leaky(conv: &Conv2d, input: Tensor<4>) -> Tensor<4> {
    convolve_as(conv, input, 1, LEAK)
}

/// A layer of [`convolution`] and leaky ReLU on the input enlarged by two.
///
/// # Shapes
/// - input: `[batch, height, width, channels_in]`
/// - output: `[batch, 2 height, 2 width, channels_out]`
pub(crate) fn convolve_doubled(conv: &Conv2d, input: Tensor<4>) -> Tensor<4> {
    convolve_as(conv, input, 2, LEAK)
}

/// A layer of [`convolution`] alone.
pub(crate) fn convolve(conv: &Conv2d, input: Tensor<4>) -> Tensor<4> {
    convolve_as(conv, input, 1, 1.0)
}

/// A row of layers of [`convolution`] and leaky ReLU.
pub(crate) fn convolve_row(convolutions: &[Conv2d], input: Tensor<4>) -> Tensor<4> {
    convolutions
        .iter()
        .fold(input, |input, conv| convolve_leaky(conv, input))
}

pub(crate) fn convolve_as(
    conv: &Conv2d,
    input: Tensor<4>,
    upsampling: usize,
    slope: f32,
) -> Tensor<4> {
    let how = Convolution {
        stride: conv.stride[0],
        upsampling,
        slope,
        ..Convolution::default()
    };
    normalight_kernels::convolution(input, conv.weight.val(), bias(conv), how)
}

/// Vectors along the channels at unit length.
pub(crate) fn unit_length(raw: Tensor<4>) -> Tensor<4> {
    // The small term keeps the gradient finite where a network says nothing.
    let length = (raw.clone().square().sum_dim(3) + 1e-8).sqrt();
    raw / length
}

/// A layer's bias; zeros where it has none.
fn bias(conv: &Conv2d) -> Tensor<1> {
    match &conv.bias {
        Some(bias) => bias.val(),
        None => {
            let weight = conv.weight.val();
            Tensor::zeros([weight.dims()[0]], &weight.device())
        }
    }
}

/// Batch normalisation: by the batch's own statistics on a device with gradients, which also moves the running ones;
/// by the running ones elsewhere. The result is multiplied by `weight`, `[1]`.
fn normalise(norm: &BatchNorm, input: Tensor<4>, weight: Option<&Tensor<1>>) -> Tensor<4> {
    let epsilon = norm.epsilon as f32;
    let weighted = |factors: Tensor<1>| match weight {
        Some(weight) => factors * weight.clone(),
        None => factors,
    };
    if !input.device().is_autodiff() {
        let (scale, shift) = running_factors(norm);
        return scale_channels(input, weighted(scale), weighted(shift));
    }
    let moments = BatchMoments::new(&input);
    let moved = |running: Tensor<1>, now: &Tensor<1>| {
        running.detach() * (1.0 - norm.momentum) + now.clone() * norm.momentum
    };
    let mean = moved(norm.running_mean.value_sync(), &moments.mean);
    norm.running_mean.update(mean);
    let variance = moved(norm.running_var.value_sync(), &moments.variance);
    norm.running_var.update(variance);
    let (gamma, beta) = (weighted(norm.gamma.val()), weighted(norm.beta.val()));
    batch_norm(input, &moments, gamma, beta, epsilon)
}

/// Scale and shift that normalise by the running statistics.
fn running_factors(norm: &BatchNorm) -> (Tensor<1>, Tensor<1>) {
    let scale = norm.gamma.val() / (norm.running_var.value_sync() + norm.epsilon).sqrt();
    let shift = norm.beta.val() - norm.running_mean.value_sync() * scale.clone();
    (scale, shift)
}

/// What normalisation layers are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// Batch normalisation with scale and shift of its own: for training.
    Affine,
    /// Without them, so that the operations of a mixed edge stay comparable: for the search.
    Relaxed,
    /// Folded into the convolution, which then has a bias: for storing and for inference.
    Folded,
}

/// A convolution without bias and its batch normalisation, or both folded into one convolution.
#[derive(Module, Debug)]
pub(crate) struct NormedConv {
    conv: Conv2d,
    norm: Option<BatchNorm>,
}

impl NormedConv {
    /// A convolution with "same" padding.
    pub(crate) fn new(
        channels: [usize; 2],
        kernel: usize,
        stride: usize,
        form: Form,
        device: &Device,
    ) -> Self {
        let padding = kernel / 2;
        let norm = match form {
            Form::Folded => None,
            Form::Affine => Some(BatchNormConfig::new(channels[1]).init(device)),
            Form::Relaxed => {
                let mut norm = BatchNormConfig::new(channels[1]).init(device);
                norm.gamma = norm.gamma.set_require_grad(false);
                norm.beta = norm.beta.set_require_grad(false);
                Some(norm)
            }
        };
        Self {
            conv: Conv2dConfig::new(channels, [kernel, kernel])
                .with_stride([stride, stride])
                .with_bias(norm.is_none())
                .with_padding(PaddingConfig2d::Explicit(
                    padding, padding, padding, padding,
                ))
                .init(device),
            norm,
        }
    }

    /// A 1x1 convolution.
    pub(crate) fn pointwise(
        channels: [usize; 2],
        stride: usize,
        form: Form,
        device: &Device,
    ) -> Self {
        Self::new(channels, 1, stride, form, device)
    }

    /// # Shapes
    /// - input: `[batch, height, width, channels_in]`
    /// - output: `[batch, height / stride, width / stride, channels_out]`
    pub(crate) fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        self.forward_as(input, (1, 0), None)
    }

    /// [`Self::forward`] on the input enlarged by 1 or 2.
    pub(crate) fn forward_enlarged(&self, input: Tensor<4>, upsampling: usize) -> Tensor<4> {
        self.forward_as(input, (upsampling, 0), None)
    }

    /// [`Self::forward`] times a number, `[1]`, which normalisation takes in as its scale.
    pub(crate) fn forward_weighted(&self, input: Tensor<4>, weight: &Tensor<1>) -> Tensor<4> {
        self.forward_as(input, (1, 0), Some(weight))
    }

    /// [`Self::forward_weighted`] on the input enlarged and then moved left and up by `shift` pixels.
    fn forward_as(
        &self,
        input: Tensor<4>,
        (upsampling, shift): (usize, usize),
        weight: Option<&Tensor<1>>,
    ) -> Tensor<4> {
        let how = Convolution {
            stride: self.conv.stride[0],
            upsampling,
            shift,
            ..Convolution::default()
        };
        let output =
            normalight_kernels::convolution(input, self.conv.weight.val(), bias(&self.conv), how);
        match (&self.norm, weight) {
            (Some(norm), _) => normalise(norm, output, weight),
            (None, Some(weight)) => output * weight.clone().reshape([1, 1, 1, 1]),
            (None, None) => output,
        }
    }

    /// The same function as one convolution with bias, with the running statistics.
    pub(crate) fn folded(&self) -> Self {
        let Some(norm) = &self.norm else {
            return self.clone();
        };
        let (scale, bias) = running_factors(norm);
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
    pub(crate) fn new(channels: [usize; 2], form: Form, device: &Device) -> Self {
        let [channels_in, channels_out] = channels;
        let even = channels_out / 2;
        Self {
            even: NormedConv::pointwise([channels_in, even], 2, form, device),
            odd: NormedConv::pointwise([channels_in, channels_out - even], 2, form, device),
        }
    }

    /// # Shapes
    /// - input: `[batch, height, width, channels_in]`, even sides
    /// - output: `[batch, height / 2, width / 2, channels_out]`
    pub(crate) fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        self.forward_as(input, None)
    }

    /// [`Self::forward`] times a number, `[1]`.
    pub(crate) fn forward_weighted(&self, input: Tensor<4>, weight: &Tensor<1>) -> Tensor<4> {
        self.forward_as(input, Some(weight))
    }

    fn forward_as(&self, input: Tensor<4>, weight: Option<&Tensor<1>>) -> Tensor<4> {
        let input = activation::relu(input);
        // Batch normalisation works per channel, so normalising the halves is the same as
        // normalising both together.
        let even = self.even.forward_as(input.clone(), (1, 0), weight);
        Tensor::cat(vec![even, self.odd.forward_as(input, (1, 1), weight)], 3)
    }

    pub(crate) fn folded(&self) -> Self {
        Self {
            even: self.even.folded(),
            odd: self.odd.folded(),
        }
    }
}
