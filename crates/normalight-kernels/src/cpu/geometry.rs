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
