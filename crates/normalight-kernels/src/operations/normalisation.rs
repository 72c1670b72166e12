use burn::tensor::Tensor;

/// Mean and variance of every channel over a batch, without gradients; the variance is divided by the number of values.
#[derive(Debug, Clone)]
pub struct BatchMoments {
    /// `[channels]`.
    pub mean: Tensor<1>,
    /// `[channels]`.
    pub variance: Tensor<1>,
}

impl BatchMoments {
    /// # Shapes
    /// - input: `[batch, height, width, channels]`
    pub fn new(input: &Tensor<4>) -> Self {
        let input = input.clone().detach();
        let [batch, height, width, channels] = input.dims();
        #[cfg(feature = "flex")]
        if super::on_flex(&input) {
            use burn::backend::Dispatch;
            let both =
                <Dispatch as crate::backend::KernelBackend>::channel_moments(input.into_dispatch());
            let both = Tensor::<2>::from_dispatch(both);
            let row = |k: usize| {
                both.clone()
                    .slice([k..k + 1, 0..channels])
                    .reshape([channels])
            };
            return Self {
                mean: row(0),
                variance: row(1),
            };
        }
        let rows = input.reshape([batch * height * width, channels]);
        let mean = rows.clone().mean_dim(0);
        let variance = (rows - mean.clone()).square().mean_dim(0);
        Self {
            mean: mean.reshape([channels]),
            variance: variance.reshape([channels]),
        }
    }
}

/// Batch normalisation by the statistics of this very batch (Ioffe & Szegedy 2015), whose dependence on the input is
/// part of the gradient: `(input - mean) / sqrt(variance + epsilon) * gamma + beta`.
///
/// # Shapes
/// - input, output: `[batch, height, width, channels]`
/// - moments: [`BatchMoments::new`] of the same input
/// - gamma, beta: `[channels]`
#[cfg_attr(
    not(feature = "flex"),
    expect(
        unused_variables,
        reason = "Burn's operations need the moments' gradients"
    )
)]
pub fn batch_norm(
    input: Tensor<4>,
    moments: &BatchMoments,
    gamma: Tensor<1>,
    beta: Tensor<1>,
    epsilon: f32,
) -> Tensor<4> {
    let [batch, height, width, channels] = input.dims();
    #[cfg(feature = "flex")]
    if super::on_flex(&input) {
        use burn::backend::Dispatch;
        let both = Tensor::stack::<2>(vec![moments.mean.clone(), moments.variance.clone()], 0);
        return Tensor::from_dispatch(<Dispatch as crate::backend::KernelBackend>::batch_norm(
            input.into_dispatch(),
            both.into_dispatch(),
            gamma.into_dispatch(),
            beta.into_dispatch(),
            epsilon,
        ));
    }
    let rows = input.reshape([batch * height * width, channels]);
    // Computed again, so that gradients flow through them.
    let centred = rows.clone() - rows.mean_dim(0);
    let variance = centred.clone().square().mean_dim(0);
    let normalised = centred / (variance + epsilon).sqrt();
    let output = normalised * gamma.unsqueeze_dim(0) + beta.unsqueeze_dim(0);
    output.reshape([batch, height, width, channels])
}

/// `input * scale + shift`, channel by channel: a normalisation by known statistics.
///
/// # Shapes
/// - input, output: `[batch, height, width, channels]`
/// - scale, shift: `[channels]`
pub fn scale_channels(input: Tensor<4>, scale: Tensor<1>, shift: Tensor<1>) -> Tensor<4> {
    let [_, _, _, channels] = input.dims();
    let row = |values: Tensor<1>| values.reshape([1, 1, 1, channels]);
    input * row(scale) + row(shift)
}
