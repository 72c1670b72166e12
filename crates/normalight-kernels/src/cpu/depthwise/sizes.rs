use crate::cpu::vectors::period;

/// The sizes of one depthwise convolution with "same" padding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Depthwise {
    pub(crate) batch: usize,
    pub(crate) height: usize,
    pub(crate) width: usize,
    pub(crate) channels: usize,
    /// Side of the kernel: 1, 3 or 5.
    pub(crate) size: usize,
    pub(crate) stride: usize,
}

impl Depthwise {
    /// Kernel sizes that are supported.
    pub(crate) const SIZES: [usize; 3] = [1, 3, 5];

    pub(crate) fn out_height(&self) -> usize {
        self.height.div_ceil(self.stride)
    }

    pub(crate) fn out_width(&self) -> usize {
        self.width.div_ceil(self.stride)
    }

    pub(crate) fn image_in(&self) -> usize {
        self.height * self.width * self.channels
    }

    pub(crate) fn image_out(&self) -> usize {
        self.out_height() * self.out_width() * self.channels
    }

    pub(super) fn taps(&self) -> usize {
        self.size * self.size
    }

    pub(super) fn period(&self) -> usize {
        period(self.channels)
    }

    /// Columns of one parity in a copied row.
    pub(super) fn columns(&self) -> usize {
        self.out_width() + (self.size - 1) / self.stride
    }

    /// Floats of a copied row: all parities.
    pub(super) fn line(&self) -> usize {
        self.stride * self.columns() * self.channels
    }

    /// Copied rows of an image.
    pub(super) fn rows(&self) -> usize {
        (self.out_height() - 1) * self.stride + self.size
    }

    /// Where column `x` of a copied row begins in it.
    pub(super) fn column(&self, x: usize) -> usize {
        (x % self.stride * self.columns() + x / self.stride) * self.channels
    }
}
