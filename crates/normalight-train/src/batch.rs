use burn::tensor::{Device, Tensor, TensorData};

/// One optimiser step's worth of samples, as plain numbers: made on the renderer's thread.
#[derive(Debug)]
pub struct Batch {
    /// Number of samples.
    pub samples: usize,
    /// Images of every sample.
    pub images: usize,
    /// Side in pixels.
    pub size: usize,
    /// Input channels.
    pub channels: usize,
    /// `[samples * images, size, size, channels]`.
    pub input: Vec<f32>,
    /// What the task compares with; see the tasks.
    pub target: Vec<f32>,
}

impl Batch {
    /// # Shapes
    /// `[samples * images, size, size, channels]`
    pub fn input(&self, device: &Device) -> Tensor<4> {
        let shape = [
            self.samples * self.images,
            self.size,
            self.size,
            self.channels,
        ];
        Tensor::from_data(TensorData::new(self.input.clone(), shape), device)
    }
}
