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
    /// `[samples * images, channels, size, size]` while samples are added, then `[samples * images, size, size, channels]`.
    pub(crate) input: Vec<f32>,
    /// What the task compares with; see the tasks.
    pub(crate) target: Vec<f32>,
}

impl Batch {
    /// Turns the finished input to channels last, as the networks want it.
    pub(crate) fn finish(&mut self) {
        let area = self.size * self.size;
        let mut turned = vec![0.0; self.input.len()];
        let images = turned.chunks_exact_mut(self.channels * area);
        for (out, planes) in images.zip(self.input.chunks_exact(self.channels * area)) {
            for (channel, plane) in planes.chunks_exact(area).enumerate() {
                for (pixel, value) in out.chunks_exact_mut(self.channels).zip(plane) {
                    pixel[channel] = *value;
                }
            }
        }
        self.input = turned;
    }

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
