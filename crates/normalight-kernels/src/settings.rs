//! How the operations are done, beside their tensors.

/// How a [`convolution`](crate::convolution) is done, beside its weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convolution {
    /// Distance of the output pixels in the input, at least 1.
    pub stride: usize,
    /// Pixels that the kernel is moved right and down from its centred place: 0, or 1 to see the pixels that a 1x1
    /// kernel of stride 2 would leave out.
    pub shift: usize,
    /// The input is first enlarged by this factor with its nearest pixels: 1 or 2.
    pub upsampling: usize,
    /// Slope of the leaky ReLU below zero, above 0 and at most 1; 1 means no activation.
    pub slope: f32,
}

impl Default for Convolution {
    /// Stride 1, nothing else.
    fn default() -> Self {
        Self {
            stride: 1,
            shift: 0,
            upsampling: 1,
            slope: 1.0,
        }
    }
}
