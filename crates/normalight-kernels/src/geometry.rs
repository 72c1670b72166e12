/// Floats of an unfolded block: a quarter of a megabyte, so that it stays in the second-level cache
/// beside the matrix product's own buffers.
const BLOCK: usize = 1 << 16;

/// The sizes of one convolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Geometry {
    pub(crate) batch: usize,
    pub(crate) channels_in: usize,
    pub(crate) channels_out: usize,
    pub(crate) height: usize,
    pub(crate) width: usize,
    /// Side of the kernel, odd.
    pub(crate) size: usize,
    pub(crate) stride: usize,
}

impl Geometry {
    /// From `[batch, channels_in, height, width]` and `[channels_out, channels_in, size, size]`.
    pub(crate) fn new(input: [usize; 4], weight: [usize; 4], stride: usize) -> Self {
        let [batch, channels_in, height, width] = input;
        let [channels_out, weight_in, size, size_2] = weight;
        assert!(
            weight_in == channels_in && size == size_2 && size % 2 == 1 && stride > 0,
            "a convolution of {input:?} with {weight:?} and stride {stride}"
        );
        Self {
            batch,
            channels_in,
            channels_out,
            height,
            width,
            size,
            stride,
        }
    }

    pub(crate) fn out_height(&self) -> usize {
        self.height.div_ceil(self.stride)
    }

    pub(crate) fn out_width(&self) -> usize {
        self.width.div_ceil(self.stride)
    }

    /// Pixels of an output plane.
    pub(crate) fn out_area(&self) -> usize {
        self.out_height() * self.out_width()
    }

    /// Floats of one image.
    pub(crate) fn image_in(&self) -> usize {
        self.channels_in * self.height * self.width
    }

    /// Floats of one output.
    pub(crate) fn image_out(&self) -> usize {
        self.channels_out * self.out_area()
    }

    /// Inputs that one output pixel sees: rows of an unfolded block.
    pub(crate) fn taps(&self) -> usize {
        self.channels_in * self.size * self.size
    }

    /// Ranges of output rows whose unfolded input fits the cache.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = std::ops::Range<usize>> + use<> {
        let rows = (BLOCK / (self.taps() * self.out_width()).max(1)).max(1);
        let height = self.out_height();
        (0..height)
            .step_by(rows)
            .map(move |first| first..height.min(first + rows))
    }

    /// Output columns whose input column `x * stride + shift` lies inside the image.
    pub(crate) fn columns(&self, shift: isize) -> std::ops::Range<usize> {
        let stride = self.stride as isize;
        let first = (-shift).max(0).div_euclid(stride)
            + isize::from((-shift).max(0).rem_euclid(stride) != 0);
        let end = (self.width as isize - shift + stride - 1).div_euclid(stride);
        let end = end.clamp(0, self.out_width() as isize);
        first.min(end) as usize..end as usize
    }
}
