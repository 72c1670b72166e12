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
    /// `[samples * images, size, size, channels]`.
    pub(crate) input: Vec<f32>,
    /// What the task compares with; see the tasks.
    pub(crate) target: Vec<f32>,
}

impl Batch {
    /// # Shapes
    /// `[samples * images, size, size, channels]`
    pub(crate) fn input(&self, device: &Device) -> Tensor<4> {
        let shape = [
            self.samples * self.images,
            self.size,
            self.size,
            self.channels,
        ];
        Tensor::from_data(TensorData::new(self.input.clone(), shape), device)
    }
}
