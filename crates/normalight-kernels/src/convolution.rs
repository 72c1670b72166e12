use burn::tensor::module::conv2d;
use burn::tensor::ops::ConvOptions;
use burn::tensor::{Tensor, activation};

/// A square convolution of odd size with "same" padding, a bias and a leaky ReLU.
///
/// `slope` is the leaky ReLU's slope below zero, above 0 and at most 1; 1 means no activation.
///
/// # Shapes
/// - input: `[batch, channels_in, height, width]`
/// - weight: `[channels_out, channels_in, size, size]`, `size` odd
/// - bias: `[channels_out]`
/// - output: `[batch, channels_out, ceil(height / stride), ceil(width / stride)]`
pub fn convolution(
    input: Tensor<4>,
    weight: Tensor<4>,
    bias: Tensor<1>,
    stride: usize,
    slope: f32,
) -> Tensor<4> {
    #[cfg(feature = "flex")]
    if on_flex(&input) {
        use burn::backend::Dispatch;
        return Tensor::from_dispatch(<Dispatch as crate::flex::ConvolutionOps>::convolution(
            input.into_dispatch(),
            weight.into_dispatch(),
            bias.into_dispatch(),
            stride,
            slope,
        ));
    }
    let padding = weight.dims()[2] / 2;
    let options = ConvOptions::new([stride; 2], [padding; 2], [1; 2], 1);
    let output = conv2d(input, weight, Some(bias), options);
    if slope == 1.0 {
        output
    } else {
        activation::leaky_relu(output, f64::from(slope))
    }
}

/// Whether our own code can take this tensor: f32 on flex, with gradients only where they are
/// compiled in.
#[cfg(feature = "flex")]
fn on_flex(input: &Tensor<4>) -> bool {
    use burn::backend::DispatchDevice;
    let device = input.device();
    let differentiable = device.is_autodiff();
    let plain = device.inner();
    matches!(plain.as_dispatch(), DispatchDevice::Flex(_))
        && input.dtype() == burn::tensor::DType::F32
        && (cfg!(feature = "autodiff") || !differentiable)
}
