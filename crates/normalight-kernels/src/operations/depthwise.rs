use super::{channels_first, channels_last};
use burn::tensor::module::conv2d;
use burn::tensor::ops::ConvOptions;
use burn::tensor::{Tensor, activation};

/// ReLU, then a depthwise convolution of odd size with "same" padding and without bias.
///
/// # Shapes
/// - input: `[batch, height, width, channels]`
/// - weight: `[channels, 1, size, size]`, `size` odd
/// - output: `[batch, ceil(height / stride), ceil(width / stride), channels]`
///
/// # Panics
/// If the shapes do not fit, like Burn's own operations.
pub fn depthwise_relu(input: Tensor<4>, weight: Tensor<4>, stride: usize) -> Tensor<4> {
    let ([_, _, _, channels], [groups, one, size, size_2]) = (input.dims(), weight.dims());
    assert!(
        channels == groups && one == 1 && size == size_2 && size % 2 == 1 && stride > 0,
        "a depthwise convolution of {:?} with {:?} and stride {stride}",
        input.dims(),
        weight.dims()
    );
    #[cfg(feature = "flex")]
    if super::on_flex(&input) && crate::cpu::depthwise::Depthwise::SIZES.contains(&size) {
        use burn::backend::Dispatch;
        return Tensor::from_dispatch(<Dispatch as crate::backend::KernelBackend>::depthwise_relu(
            input.into_dispatch(),
            weight.into_dispatch(),
            stride,
        ));
    }
    let input = activation::relu(channels_first(input));
    let options = ConvOptions::new([stride; 2], [size / 2; 2], [1; 2], channels);
    channels_last(conv2d(input, weight, None, options))
}
