//! ReLU and depthwise convolution in one operation.
//!
//! Rows are flat, `[columns, channels]`, and the weights are repeated along them, so that vectors are full however few
//! channels there are. For stride 2 the columns of the copied rows are sorted by parity first; then neighbouring outputs
//! see neighbouring inputs again.
use crate::cpu::buffer::Buffer;
use crate::cpu::convolution::PARTS;
use crate::cpu::vectors::{Lanes, WIDEST, period, run};
use pulp::{Simd, WithSimd};
use rayon::prelude::*;

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

    fn taps(&self) -> usize {
        self.size * self.size
    }

    fn period(&self) -> usize {
        period(self.channels)
    }

    /// Columns of one parity in a copied row.
    fn columns(&self) -> usize {
        self.out_width() + (self.size - 1) / self.stride
    }

    /// Floats of a copied row: all parities.
    fn line(&self) -> usize {
        self.stride * self.columns() * self.channels
    }

    /// Copied rows of an image.
    fn rows(&self) -> usize {
        (self.out_height() - 1) * self.stride + self.size
    }

    /// Where column `x` of a copied row begins in it.
    fn column(&self, x: usize) -> usize {
        (x % self.stride * self.columns() + x / self.stride) * self.channels
    }

    /// Weights along a row: `[taps, period]`.
    ///
    /// # Shapes
    /// - weight: `[channels, size, size]`
    fn repeated(&self, weight: &[f32]) -> Buffer {
        let period = self.period();
        let mut repeated = Buffer::recycled(self.taps() * period);
        for (tap, row) in repeated.chunks_exact_mut(period).enumerate() {
            for (place, value) in row.iter_mut().enumerate() {
                *value = weight[place % self.channels * self.taps() + tap];
            }
        }
        repeated
    }

    /// An image after ReLU with zeros around it: `[rows, stride, columns, channels]`.
    fn copy(&self, image: &[f32], out: &mut [f32]) {
        let (channels, padding) = (self.channels, self.size / 2);
        out.fill(0.0);
        pulp::Arch::new().dispatch(|| {
            let lines = out.chunks_exact_mut(self.line()).skip(padding);
            for (line, row) in lines.zip(image.chunks_exact(self.width * channels)) {
                for (x, pixel) in row.chunks_exact(channels).enumerate() {
                    // Beyond the last tap of the last output there may be a column that nobody sees.
                    let to = self.column(x + padding);
                    if (x + padding) / self.stride >= self.columns() {
                        continue;
                    }
                    for (value, input) in line[to..to + channels].iter_mut().zip(pixel) {
                        // NaN stays.
                        *value = if *input < 0.0 { 0.0 } else { *input };
                    }
                }
            }
        });
    }

    /// # Shapes
    /// - input: `[batch, height, width, channels]`
    /// - weight: `[channels, size, size]`
    /// - output: `[batch, out_height, out_width, channels]`
    pub(crate) fn forward(&self, input: &[f32], weight: &[f32]) -> Buffer {
        let weight = self.repeated(weight);
        let mut output = Buffer::recycled(self.batch * self.image_out());
        output
            .par_chunks_exact_mut(self.image_out())
            .zip(input.par_chunks_exact(self.image_in()))
            .for_each(|(output, image)| {
                let mut patch = Buffer::recycled(self.rows() * self.line());
                self.copy(image, &mut patch);
                let outputs = output.chunks_exact_mut(self.out_width() * self.channels);
                for (y, output) in outputs.enumerate() {
                    let taps = (0..self.taps()).map(|tap| {
                        let (row, column) = (tap / self.size, tap % self.size);
                        let from = (y * self.stride + row) * self.line() + self.column(column);
                        (from, tap * self.period())
                    });
                    Row::new(&patch, &weight, self.period(), output, taps).compute();
                }
            });
        output
    }

    /// Gradients of input and weight (`[channels, size, size]`; zeros where it is not wanted).
    pub(crate) fn backward(
        &self,
        input: &[f32],
        weight: &[f32],
        gradient: &[f32],
        wants_weight: bool,
    ) -> (Buffer, Buffer) {
        let repeated = self.repeated(weight);
        let part = self.batch.div_ceil(PARTS).max(1);
        let mut grad_input = Buffer::recycled(self.batch * self.image_in());
        let sums: Vec<Buffer> = grad_input
            .par_chunks_mut(part * self.image_in())
            .zip(input.par_chunks(part * self.image_in()))
            .zip(gradient.par_chunks(part * self.image_out()))
            .map(|((grad_input, input), gradient)| {
                let mut sums = Buffer::zeros(self.taps() * self.period());
                let mut patch = Buffer::recycled(self.rows() * self.line());
                let images = grad_input
                    .chunks_exact_mut(self.image_in())
                    .zip(input.chunks_exact(self.image_in()))
                    .zip(gradient.chunks_exact(self.image_out()));
                for ((grad_image, image), gradient) in images {
                    if wants_weight {
                        self.copy(image, &mut patch);
                        WeightSums {
                            depthwise: self,
                            patch: &patch,
                            gradient,
                            sums: &mut sums,
                        }
                        .compute();
                    }
                    self.image_gradient(image, gradient, &repeated, grad_image);
                }
                sums
            })
            .collect();
        let mut grad_weight = Buffer::zeros(weight.len());
        for sums in sums {
            for (tap, row) in sums.chunks_exact(self.period()).enumerate() {
                for (place, value) in row.iter().enumerate() {
                    grad_weight[place % self.channels * self.taps() + tap] += value;
                }
            }
        }
        (grad_input, grad_weight)
    }

    fn image_gradient(
        &self,
        image: &[f32],
        gradient: &[f32],
        weight: &[f32],
        grad_image: &mut [f32],
    ) {
        let (channels, padding) = (self.channels, self.size / 2);
        // Zeros left and right of the gradient's rows, so that every tap finds something.
        let beside = (self.size - 1) / self.stride * channels;
        let width = self.out_width() * channels;
        let padded = width + 2 * beside;
        let mut gradients = Buffer::zeros(self.out_height() * padded);
        for (padded, row) in gradients
            .chunks_exact_mut(padded)
            .zip(gradient.chunks_exact(width))
        {
            padded[beside..beside + width].copy_from_slice(row);
        }
        let columns = self.columns() * channels;
        let mut line = Buffer::recycled(self.line());
        let rows = grad_image
            .chunks_exact_mut(self.width * channels)
            .zip(image.chunks_exact(self.width * channels));
        for (y, (grad_row, row)) in rows.enumerate() {
            let patch = y + padding;
            for (parity, line) in line.chunks_exact_mut(columns).enumerate() {
                let taps = (0..self.taps()).filter_map(|tap| {
                    let (row, column) = (tap / self.size, tap % self.size);
                    let above = patch.checked_sub(row)?;
                    let fits = above % self.stride == 0
                        && above / self.stride < self.out_height()
                        && column % self.stride == parity;
                    let from = above / self.stride * padded + beside;
                    fits.then(|| {
                        let from = from - column / self.stride * channels;
                        (from, tap * self.period())
                    })
                });
                Row::new(&gradients, weight, self.period(), line, taps).compute();
            }
            pulp::Arch::new().dispatch(|| {
                let pixels = grad_row
                    .chunks_exact_mut(channels)
                    .zip(row.chunks_exact(channels));
                for (x, (grad_pixel, pixel)) in pixels.enumerate() {
                    if (x + padding) / self.stride >= self.columns() {
                        grad_pixel.fill(0.0);
                        continue;
                    }
                    let from = self.column(x + padding);
                    let line = &line[from..from + channels];
                    for ((value, found), input) in grad_pixel.iter_mut().zip(line).zip(pixel) {
                        *value = if *input > 0.0 { *found } else { 0.0 };
                    }
                }
            });
        }
    }
}

/// One row as a sum over taps of shifted rows times repeated weights.
struct Row<'a> {
    values: &'a [f32],
    weight: &'a [f32],
    period: usize,
    out: &'a mut [f32],
    /// Starts in `values` and in `weight`.
    taps: [(usize, usize); 25],
    count: usize,
}

impl<'a> Row<'a> {
    fn new(
        values: &'a [f32],
        weight: &'a [f32],
        period: usize,
        out: &'a mut [f32],
        starts: impl Iterator<Item = (usize, usize)>,
    ) -> Self {
        let mut taps = [(0, 0); 25];
        let mut count = 0;
        for (to, from) in taps.iter_mut().zip(starts) {
            *to = from;
            count += 1;
        }
        Self {
            values,
            weight,
            period,
            out,
            taps,
            count,
        }
    }

    fn compute(self) {
        run(self);
    }

    fn check(&self) {
        for (value, weight) in &self.taps[..self.count] {
            assert!(
                value + self.out.len() <= self.values.len()
                    && weight + self.period <= self.weight.len()
                    && self.period.is_multiple_of(WIDEST),
                "a row reaches beyond its image"
            );
        }
    }
}

impl WithSimd for Row<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.check();
        let (lanes, length) = (S::F32_LANES, self.out.len());
        let mut from = 0;
        while from + TOGETHER * lanes <= length {
            if self.period == lanes {
                self.vectors::<S, TOGETHER, true>(Lanes::all(simd), from);
            } else {
                self.vectors::<S, TOGETHER, false>(Lanes::all(simd), from);
            }
            from += TOGETHER * lanes;
        }
        while from < length {
            self.vectors::<S, 1, false>(Lanes::new(simd, length - from), from);
            from += lanes;
        }
    }
}

/// Vectors of a row that are summed together.
const TOGETHER: usize = 4;

impl Row<'_> {
    /// `N` vectors from `from` on; all see the same weights if those repeat with every vector (`SAME`).
    #[expect(unsafe_code, reason = "vectors are read and written through pointers")]
    #[inline(always)]
    fn vectors<S: Simd, const N: usize, const SAME: bool>(&mut self, lanes: Lanes<S>, from: usize) {
        let simd = lanes.simd;
        let places: [usize; N] = std::array::from_fn(|n| (from + n * S::F32_LANES) % self.period);
        let mut sums = [simd.splat_f32s(0.0); N];
        for (value, weight) in &self.taps[..self.count] {
            // SAFETY: `check` has seen that the row lies inside `values` for every tap, and that a period, which
            // is made of whole vectors, lies inside `weight`.
            unsafe {
                let weight = self.weight.as_ptr().add(*weight);
                let at = |place: usize| weight.add(place).cast::<S::f32s>().read_unaligned();
                let same = at(places[0]);
                for (n, sum) in sums.iter_mut().enumerate() {
                    let value = value + from + n * S::F32_LANES;
                    let value = lanes.load(self.values.as_ptr().add(value));
                    let weight = if SAME { same } else { at(places[n]) };
                    *sum = simd.mul_add_e_f32s(value, weight, *sum);
                }
            }
        }
        for (n, sum) in sums.into_iter().enumerate() {
            // SAFETY: the lanes end with the row.
            unsafe { lanes.store(self.out.as_mut_ptr().add(from + n * S::F32_LANES), sum) };
        }
    }
}

/// Sums of products of inputs and gradients: `[taps, period]`.
struct WeightSums<'a> {
    depthwise: &'a Depthwise,
    patch: &'a [f32],
    gradient: &'a [f32],
    sums: &'a mut [f32],
}

impl WeightSums<'_> {
    fn compute(self) {
        run(self);
    }

    fn check(&self) {
        let depthwise = self.depthwise;
        assert!(
            self.patch.len() >= depthwise.rows() * depthwise.line()
                && self.gradient.len() >= depthwise.image_out()
                && self.sums.len() >= depthwise.taps() * depthwise.period(),
            "sums reach beyond their image"
        );
    }
}

impl WithSimd for WeightSums<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.check();
        match self.depthwise.size {
            1 => self.rows::<S, 1>(simd),
            3 => self.rows::<S, 3>(simd),
            _ => self.rows::<S, 5>(simd),
        }
    }
}

impl WeightSums<'_> {
    #[expect(unsafe_code, reason = "vectors are read and written through pointers")]
    #[inline(always)]
    fn rows<S: Simd, const K: usize>(&mut self, simd: S) {
        let depthwise = self.depthwise;
        let (period, line) = (depthwise.period(), depthwise.line());
        let width = depthwise.out_width() * depthwise.channels;
        let starts: [usize; K] = std::array::from_fn(|column| depthwise.column(column));
        for tap_row in 0..K {
            for place in (0..period).step_by(S::F32_LANES) {
                let mut sums = [simd.splat_f32s(0.0); K];
                for y in 0..depthwise.out_height() {
                    let patch = (y * depthwise.stride + tap_row) * line;
                    for from in (place..width).step_by(period) {
                        let lanes = Lanes::new(simd, width - from);
                        // SAFETY: `check` has seen the buffers; a shifted row ends inside its line.
                        unsafe {
                            let gradient = self.gradient.as_ptr().add(y * width + from);
                            let gradient = lanes.load(gradient);
                            for (sum, start) in sums.iter_mut().zip(starts) {
                                let value = self.patch.as_ptr().add(patch + start + from);
                                *sum = simd.mul_add_e_f32s(lanes.load(value), gradient, *sum);
                            }
                        }
                    }
                }
                for (column, sum) in sums.into_iter().enumerate() {
                    // SAFETY: a period is made of whole vectors, and `check` has seen the buffer.
                    unsafe {
                        let to = (tap_row * K + column) * period + place;
                        let to = self.sums.as_mut_ptr().add(to).cast::<S::f32s>();
                        to.write_unaligned(simd.add_f32s(to.read_unaligned(), sum));
                    }
                }
            }
        }
    }
}
