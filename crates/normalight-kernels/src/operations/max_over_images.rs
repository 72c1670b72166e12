use burn::tensor::Tensor;

/// The maximum over the images of every sample; its gradient goes to the image that has it.
///
/// # Shapes
/// - input: `[samples * images, height, width, channels]`
/// - output: `[samples, height, width, channels]`
///
/// # Panics
/// If the batch is not a multiple of `samples`.
pub fn max_over_images(input: Tensor<4>, samples: usize) -> Tensor<4> {
    let [rows, height, width, channels] = input.dims();
    assert!(
        samples > 0 && rows > 0 && rows.is_multiple_of(samples),
        "{rows} images cannot be divided evenly among {samples} samples"
    );
    #[cfg(feature = "flex")]
    if super::on_flex(&input) {
        use burn::backend::Dispatch;
        return Tensor::from_dispatch(
            <Dispatch as crate::backend::KernelBackend>::max_over_images(
                input.into_dispatch(),
                samples,
            ),
        );
    }
    input
        .reshape([samples, rows / samples, height * width * channels])
        .max_dim(1)
        .reshape([samples, height, width, channels])
}
