//! The transforms of a row of tiles, a vector of channels at a time.
use crate::cpu::product::leaky;
use crate::cpu::transforms::{
    KEPT, POINTS, SIDE, Vectors, input, input_transposed, output, output_transposed,
};
use crate::cpu::vectors::Lanes;
use pulp::{Simd, WithSimd};

/// Where the transformed values of some tiles are: 36 planes of `[tiles, channels]`.
#[derive(Clone, Copy)]
pub(super) struct Points {
    pub(super) tiles: usize,
    pub(super) channels: usize,
}

impl Points {
    /// Floats from a plane to the next. A little more than needed: planes a power of two apart would all compete for
    /// the same few lines of the cache.
    #[inline(always)]
    pub(super) fn plane(self) -> usize {
        self.tiles * self.channels + 16
    }

    /// Floats of all planes.
    pub(super) fn floats(self) -> usize {
        POINTS * self.plane()
    }

    #[inline(always)]
    fn at(self, point: usize, tile: usize, channel: usize) -> usize {
        point * self.plane() + tile * self.channels + channel
    }

    /// Panics unless the tiles `first..first + count` lie inside `length` values.
    fn check(self, first: usize, count: usize, length: usize) {
        assert!(
            first + count <= self.tiles && self.floats() <= length,
            "tiles beyond their buffer"
        );
    }
}

/// Inputs to transformed values.
pub(super) struct Gather<'a> {
    /// `[6, columns, channels]`.
    pub(super) window: &'a [f32],
    pub(super) columns: usize,

    pub(super) tiles: usize,
    /// Tiles from `first` on are written.
    pub(super) points: &'a mut [f32],
    pub(super) place: Points,
    pub(super) first: usize,
}

impl Gather<'_> {
    fn check(&self) {
        self.place.check(self.first, self.tiles, self.points.len());
        check_window(
            self.tiles,
            self.columns,
            self.place.channels,
            self.window.len(),
        );
    }
}

fn check_window(tiles: usize, columns: usize, channels: usize, length: usize) {
    assert!(
        tiles * KEPT + SIDE - KEPT <= columns && SIDE * columns * channels <= length,
        "tiles beyond their window"
    );
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
#[expect(clippy::needless_range_loop, reason = "a column of an array of rows")]
impl WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.check();
        let a = Vectors(simd);
        for channel in (0..self.place.channels).step_by(S::F32_LANES) {
            let lanes = Lanes::new(simd, self.place.channels - channel);
            for tile in 0..self.tiles {
                let mut half = [[simd.splat_f32s(0.0); SIDE]; SIDE];
                for (y, half) in half.iter_mut().enumerate() {
                    let from = (y * self.columns + tile * KEPT) * self.place.channels + channel;
                    // SAFETY: `check` has seen the last tile's place in the window; a tile is 6 columns wide.
                    let row: [S::f32s; SIDE] = std::array::from_fn(|x| unsafe {
                        lanes.load(self.window.as_ptr().add(from + x * self.place.channels))
                    });
                    *half = input(a, row);
                }
                for x in 0..SIDE {
                    let column = input(a, std::array::from_fn(|y| half[y][x]));
                    for (y, value) in column.into_iter().enumerate() {
                        let to = self.place.at(y * SIDE + x, self.first + tile, channel);
                        // SAFETY: `check` has seen the last tile's place.
                        unsafe { lanes.store(self.points.as_mut_ptr().add(to), value) };
                    }
                }
            }
        }
    }
}

/// The transpose of [`Gather`]: tiles from the window's left edge on are added up, whatever was there before.
pub(super) struct Scatter<'a> {
    pub(super) points: &'a [f32],
    pub(super) place: Points,
    pub(super) first: usize,
    pub(super) tiles: usize,
    pub(super) window: &'a mut [f32],
    pub(super) columns: usize,
}

impl Scatter<'_> {
    fn check(&self) {
        self.place.check(self.first, self.tiles, self.points.len());
        check_window(
            self.tiles,
            self.columns,
            self.place.channels,
            self.window.len(),
        );
    }
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
impl WithSimd for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.check();
        let (a, zero) = (Vectors(simd), simd.splat_f32s(0.0));
        for channel in (0..self.place.channels).step_by(S::F32_LANES) {
            let lanes = Lanes::new(simd, self.place.channels - channel);
            for tile in 0..self.tiles {
                let mut half = [[simd.splat_f32s(0.0); SIDE]; SIDE];
                for x in 0..SIDE {
                    // SAFETY: `check` has seen the last tile's place.
                    let column: [S::f32s; SIDE] = std::array::from_fn(|y| unsafe {
                        let from = self.place.at(y * SIDE + x, self.first + tile, channel);
                        lanes.load(self.points.as_ptr().add(from))
                    });
                    let column = input_transposed(a, column);
                    for (half, value) in half.iter_mut().zip(column) {
                        half[x] = value;
                    }
                }
                for (y, half) in half.into_iter().enumerate() {
                    let to = (y * self.columns + tile * KEPT) * self.place.channels + channel;
                    for (x, value) in input_transposed(a, half).into_iter().enumerate() {
                        // The tile before has left its part in the first columns.
                        let shared = tile > 0 && x < SIDE - KEPT;
                        // SAFETY: `check` has seen the last tile's place in the window.
                        unsafe {
                            let to = self.window.as_mut_ptr().add(to + x * self.place.channels);
                            let before = if shared { lanes.load(to) } else { zero };
                            lanes.store(to, simd.add_f32s(value, before));
                        }
                    }
                }
            }
        }
    }
}

/// Sums of products to outputs.
pub(super) struct Write<'a> {
    pub(super) points: &'a [f32],
    pub(super) place: Points,
    pub(super) first: usize,
    pub(super) tiles: usize,
    /// Output rows that exist, at most 4.
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) bias: &'a [f32],
    pub(super) slope: f32,
    /// `[rows, columns, channels]`.
    pub(super) out: &'a mut [f32],
}

impl Write<'_> {
    fn check(&self) {
        self.place.check(self.first, self.tiles, self.points.len());
        assert!(
            self.rows <= KEPT
                && self.rows * self.columns * self.place.channels <= self.out.len()
                && self.place.channels <= self.bias.len(),
            "tiles beyond the output"
        );
    }
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
impl WithSimd for Write<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.check();
        let a = Vectors(simd);
        for channel in (0..self.place.channels).step_by(S::F32_LANES) {
            let lanes = Lanes::new(simd, self.place.channels - channel);
            // SAFETY: `check` has seen that there is a bias for every channel.
            let bias = unsafe { lanes.load(self.bias.as_ptr().add(channel)) };
            for tile in 0..self.tiles {
                let mut half = [[simd.splat_f32s(0.0); SIDE]; KEPT];
                for x in 0..SIDE {
                    // SAFETY: `check` has seen the last tile's place.
                    let column: [S::f32s; SIDE] = std::array::from_fn(|y| unsafe {
                        let from = self.place.at(y * SIDE + x, self.first + tile, channel);
                        lanes.load(self.points.as_ptr().add(from))
                    });
                    for (half, value) in half.iter_mut().zip(output(a, column)) {
                        half[x] = value;
                    }
                }
                let columns = KEPT.min(self.columns.saturating_sub(tile * KEPT));
                for (y, half) in half.into_iter().enumerate().take(self.rows) {
                    let to = (y * self.columns + tile * KEPT) * self.place.channels + channel;
                    for (x, value) in output(a, half).into_iter().enumerate().take(columns) {
                        let value = leaky(simd, simd.add_f32s(value, bias), self.slope);
                        // SAFETY: only rows and columns that exist are written.
                        unsafe {
                            let to = self.out.as_mut_ptr().add(to + x * self.place.channels);
                            lanes.store(to, value);
                        }
                    }
                }
            }
        }
    }
}

/// The transpose of [`Write`]: gradients of outputs to those of the sums of products; adds up those of the bias.
pub(super) struct Spread<'a> {
    /// `[rows, columns, channels]`.
    pub(super) output: &'a [f32],
    pub(super) gradient: &'a [f32],
    pub(super) slope: f32,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) bias: &'a mut [f32],
    pub(super) points: &'a mut [f32],
    pub(super) place: Points,
    pub(super) first: usize,
    pub(super) tiles: usize,
}

impl Spread<'_> {
    fn check(&self) {
        self.place.check(self.first, self.tiles, self.points.len());
        let floats = self.rows * self.columns * self.place.channels;
        assert!(
            self.rows <= KEPT
                && floats <= self.output.len()
                && floats <= self.gradient.len()
                && self.place.channels <= self.bias.len(),
            "tiles beyond the output"
        );
    }
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
#[expect(clippy::needless_range_loop, reason = "a column of an array of rows")]
impl WithSimd for Spread<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.check();
        let a = Vectors(simd);
        let zero = simd.splat_f32s(0.0);
        for channel in (0..self.place.channels).step_by(S::F32_LANES) {
            let lanes = Lanes::new(simd, self.place.channels - channel);
            let mut sum = zero;
            for tile in 0..self.tiles {
                let columns = KEPT.min(self.columns.saturating_sub(tile * KEPT));
                let mut half = [[zero; SIDE]; KEPT];
                for (y, half) in half.iter_mut().enumerate().take(self.rows) {
                    let from = (y * self.columns + tile * KEPT) * self.place.channels + channel;
                    let mut row = [zero; KEPT];
                    for (x, value) in row.iter_mut().enumerate().take(columns) {
                        let from = from + x * self.place.channels;
                        // SAFETY: only rows and columns that exist are read.
                        let (output, gradient) = unsafe {
                            (
                                lanes.load(self.output.as_ptr().add(from)),
                                lanes.load(self.gradient.as_ptr().add(from)),
                            )
                        };
                        let below = simd.mul_f32s(gradient, simd.splat_f32s(self.slope));
                        let positive = simd.less_than_f32s(zero, output);
                        *value = simd.select_f32s(positive, gradient, below);
                        sum = simd.add_f32s(sum, *value);
                    }
                    *half = output_transposed(a, row);
                }
                for x in 0..SIDE {
                    let column = output_transposed(a, std::array::from_fn(|y| half[y][x]));
                    for (y, value) in column.into_iter().enumerate() {
                        let to = self.place.at(y * SIDE + x, self.first + tile, channel);
                        // SAFETY: `check` has seen the last tile's place.
                        unsafe { lanes.store(self.points.as_mut_ptr().add(to), value) };
                    }
                }
            }
            // SAFETY: `check` has seen that there is a bias for every channel.
            unsafe {
                let to = self.bias.as_mut_ptr().add(channel);
                lanes.store(to, simd.add_f32s(sum, lanes.load(to)));
            }
        }
    }
}
