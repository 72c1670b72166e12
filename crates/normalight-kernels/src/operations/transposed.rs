use super::{channels_first, channels_last};
use burn::tensor::module::conv_transpose2d;
use burn::tensor::ops::ConvTransposeOptions;
use burn::tensor::{Tensor, activation};

/// A transposed convolution of size 4 and stride 2 that doubles the sides, with a bias and a leaky ReLU.
///
/// `slope` is the leaky ReLU's slope below zero, above 0 and at most 1; 1 means no activation.
///
/// # Shapes
/// - input: `[batch, height, width, channels_in]`
/// - weight: `[channels_in, channels_out, 4, 4]`
/// - bias: `[channels_out]`
/// - output: `[batch, 2 height, 2 width, channels_out]`
///
/// # Panics
/// If the shapes do not fit, like Burn's own operations.
pub fn transposed_convolution(
    input: Tensor<4>,
    weight: Tensor<4>,
    bias: Tensor<1>,
    slope: f32,
) -> Tensor<4> {
    let ([_, _, _, channels], [inputs, outputs, size, size_2]) = (input.dims(), weight.dims());
    assert!(
        channels == inputs && [size, size_2] == [4, 4] && bias.dims() == [outputs],
        "a transposed convolution of {:?} with {:?}",
        input.dims(),
        weight.dims()
    );
    #[cfg(feature = "flex")]
    if super::on_flex(&input) {
        use burn::backend::Dispatch;
        return Tensor::from_dispatch(
            <Dispatch as crate::backend::KernelBackend>::transposed_convolution(
                input.into_dispatch(),
                weight.into_dispatch(),
                bias.into_dispatch(),
                slope,
            ),
        );
    }
    let options = ConvTransposeOptions::new([2; 2], [1; 2], [0; 2], [1; 2], 1);
    let output = conv_transpose2d(channels_first(input), weight, Some(bias), options);
    let output = if slope == 1.0 {
        output
    } else {
        activation::leaky_relu(output, f64::from(slope))
    };
    channels_last(output)
}
