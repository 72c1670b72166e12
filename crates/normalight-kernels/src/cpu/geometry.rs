//! What a convolution is computed from: its sizes, its weights, and parts of a batch.

/// The sizes of one convolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Geometry {
    pub(crate) batch: usize,
    pub(crate) channels_in: usize,
    pub(crate) channels_out: usize,
    /// Height of the stored input, before `zoom`.
    pub(crate) stored_height: usize,
    /// Width of the stored input, before `zoom`.
    pub(crate) stored_width: usize,
    /// Every stored pixel stands for `zoom x zoom`: 1, or 2 for nearest-neighbour upsampling.
    pub(crate) zoom: usize,
    /// Side of the kernel.
    pub(crate) size: usize,
    pub(crate) stride: usize,
    /// Input row and column that the first tap of the first output pixel sees: minus the padding.
    pub(crate) origin: isize,
}

impl Geometry {
    /// Height of the input that the kernel sees.
    pub(crate) fn height(&self) -> usize {
        self.stored_height * self.zoom
    }

    pub(crate) fn width(&self) -> usize {
        self.stored_width * self.zoom
    }

    pub(crate) fn out_height(&self) -> usize {
        self.height().div_ceil(self.stride)
    }

    pub(crate) fn out_width(&self) -> usize {
        self.width().div_ceil(self.stride)
    }

    /// Pixels of an output plane.
    pub(crate) fn out_area(&self) -> usize {
        self.out_height() * self.out_width()
    }

    /// Floats of one stored image.
    pub(crate) fn image_in(&self) -> usize {
        self.stored_height * self.stored_width * self.channels_in
    }

    /// Floats of one output.
    pub(crate) fn image_out(&self) -> usize {
        self.out_area() * self.channels_out
    }

    /// Numbers that one output value is a weighted sum of.
    pub(crate) fn taps(&self) -> usize {
        self.size * self.size * self.channels_in
    }

    /// Whether every output pixel sees just the input pixel at its own place.
    pub(crate) fn pointwise(&self) -> bool {
        self.size == 1 && self.stride == 1 && self.zoom == 1 && self.origin == 0
    }

    /// The same convolution with the images of a pointwise one joined to at least `fewest` tall ones: what is done once
    /// for each image is done less often.
    pub(crate) fn joined(self, fewest: usize) -> Self {
        if !self.pointwise() {
            return self;
        }
        let together = (1..=self.batch / fewest.max(1))
            .rev()
            .find(|together| self.batch.is_multiple_of(*together))
            .unwrap_or(1);
        Self {
            batch: self.batch / together,
            stored_height: self.stored_height * together,
            ..self
        }
    }

    /// Input columns that a row of output pixels sees.
    pub(crate) fn seen_width(&self) -> usize {
        (self.out_width() - 1) * self.stride + self.size
    }
}

/// Weights, bias and activation of a convolution.
#[derive(Clone, Copy)]
pub(crate) struct Filter<'a> {
    /// In the order that the algorithm needs.
    pub(crate) weight: &'a [f32],
    /// `[channels_out]`.
    pub(crate) bias: &'a [f32],
    /// Slope of the leaky ReLU below zero; 1 means no activation.
    pub(crate) slope: f32,
}

/// Some images of a batch, and what their gradients are computed from.
pub(crate) struct Part<'a> {
    pub(crate) geometry: &'a Geometry,
    /// `[images, stored height, stored width, channels_in]`.
    pub(crate) input: &'a [f32],
    /// `[channels_out, size, size, channels_in]`; for Winograd transformed, `[36, channels_out, channels_in]`.
    pub(crate) transposed: &'a [f32],
    /// `[images, out_height, out_width, channels_out]`.
    pub(crate) output: &'a [f32],
    /// Gradient of the output, of its shape.
    pub(crate) gradient: &'a [f32],
    pub(crate) slope: f32,
    pub(crate) wants_bias: bool,
}

/// Where the gradients of a [`Part`] go. Those of weights and bias are added to what is there, those of the input are
/// written; what is empty is not wanted.
pub(crate) struct PartGradients<'a> {
    /// `[size, size, channels_in, channels_out]`; for Winograd transformed, `[36, channels_in, channels_out]`.
    pub(crate) weight: &'a mut [f32],
    /// `[channels_out]`.
    pub(crate) bias: &'a mut [f32],
    /// As the part's input.
    pub(crate) input: &'a mut [f32],
}
