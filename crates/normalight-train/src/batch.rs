use burn::tensor::{Device, Tensor, TensorData};

/// One optimiser step's worth of samples, as plain numbers: made on the renderer's thread.
#[derive(Debug)]
pub(crate) struct Batch {
    /// Number of samples.
    pub(crate) samples: usize,
    /// Images of every sample.
    pub(crate) images: usize,
    /// Side in pixels.
    pub(crate) size: usize,
    /// Input channels.
    pub(crate) channels: usize,
    /// `[samples * images, channels, size, size]`.
    pub(crate) input: Vec<f32>,
    /// What the task compares with; see the tasks.
    pub(crate) target: Vec<f32>,
}

impl Batch {
    /// # Shapes
    /// `[samples * images, channels, size, size]`
    pub(crate) fn input(&self, device: &Device) -> Tensor<4> {
        let shape = [
            self.samples * self.images,
            self.channels,
            self.size,
            self.size,
        ];
        Tensor::from_data(TensorData::new(self.input.clone(), shape), device)
    }
}

/// The maximum over the images of every sample.
///
/// # Shapes
/// - features: `[samples * images, channels, height, width]`
/// - output: `[samples, channels, height, width]`
pub(crate) fn most_per_sample(features: Tensor<4>, samples: usize) -> Tensor<4> {
    let [rows, channels, height, width] = features.dims();
    features
        .reshape([samples, rows / samples, channels * height * width])
        .max_dim(1)
        .reshape([samples, channels, height, width])
}
