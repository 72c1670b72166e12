use super::{channels_first, channels_last};
use crate::settings::Convolution;
use burn::tensor::module::{conv2d, interpolate};
use burn::tensor::ops::{ConvOptions, InterpolateMode, InterpolateOptions};
use burn::tensor::{Tensor, activation};

/// A square convolution of odd size with "same" padding, a bias and a leaky ReLU.
///
/// # Shapes
/// - input: `[batch, height, width, channels_in]`
/// - weight: `[channels_out, channels_in, size, size]`, `size` odd
/// - bias: `[channels_out]`
/// - output: `[batch, ceil(upsampling * height / stride), ceil(upsampling * width / stride), channels_out]`
///
/// # Panics
/// If the shapes do not fit, like Burn's own operations.
pub fn convolution(
    input: Tensor<4>,
    weight: Tensor<4>,
    bias: Tensor<1>,
    how: Convolution,
) -> Tensor<4> {
    let ([_, _, _, channels], [outputs, inputs, size, size_2]) = (input.dims(), weight.dims());
    assert!(
        channels == inputs
            && size == size_2
            && size % 2 == 1
            && bias.dims() == [outputs]
            && how.stride > 0
            && (1..=2).contains(&how.upsampling),
        "a convolution of {:?} with {:?} and {how:?}",
        input.dims(),
        weight.dims()
    );
    #[cfg(feature = "flex")]
    if super::on_flex(&input) {
        use burn::backend::Dispatch;
        return Tensor::from_dispatch(<Dispatch as crate::backend::KernelBackend>::convolution(
            input.into_dispatch(),
            weight.into_dispatch(),
            bias.into_dispatch(),
            how,
        ));
    }
    composed(input, weight, bias, how)
}

fn composed(input: Tensor<4>, weight: Tensor<4>, bias: Tensor<1>, how: Convolution) -> Tensor<4> {
    let mut input = channels_first(input);
    if how.upsampling > 1 {
        let [_, _, height, width] = input.dims();
        let size = [how.upsampling * height, how.upsampling * width];
        let nearest = InterpolateOptions::new(InterpolateMode::Nearest).with_output_size(size);
        input = interpolate(input, nearest);
    }
    let [_, _, height, width] = input.dims();
    let (out_height, out_width) = (height.div_ceil(how.stride), width.div_ceil(how.stride));
    let padding = weight.dims()[2] / 2;
    if how.shift > 0 {
        // Zeros at the far sides stand in for what lies beyond.
        let [batch, channels, ..] = input.dims();
        input = input.pad((0, how.shift, 0, how.shift), 0.0f32).slice([
            0..batch,
            0..channels,
            how.shift..height + how.shift,
            how.shift..width + how.shift,
        ]);
    }
    let options = ConvOptions::new([how.stride; 2], [padding; 2], [1; 2], 1);
    let output = conv2d(input, weight, Some(bias), options);
    debug_assert_eq!(output.dims()[2..], [out_height, out_width]);
    let output = if how.slope == 1.0 {
        output
    } else {
        activation::leaky_relu(output, f64::from(how.slope))
    };
    channels_last(output)
}
