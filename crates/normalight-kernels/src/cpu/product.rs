//! Matrix products without packing: what convolutions multiply lies in the cache already.
use crate::cpu::vectors::{Lanes, run};
use pulp::{Simd, WithSimd};

/// Rows of a register tile of two vectors where there are 32 registers, and where there are fewer: all sums, the
/// vectors and a factor stay in registers.
const TILE_ROWS: [usize; 2] = [8, 6];

/// The left matrix: element `(r, [i, j])` is at `r * row + i * steps[0] + j * steps[1]`.
#[derive(Clone, Copy)]
pub(crate) struct Left<'a> {
    pub(crate) values: &'a [f32],
    pub(crate) row: usize,
    pub(crate) steps: [usize; 2],
}

/// The right matrix: element `([i, j], c)` is at `i * steps[0] + j * steps[1] + c`.
#[derive(Clone, Copy)]
pub(crate) struct Right<'a> {
    pub(crate) values: &'a [f32],
    pub(crate) steps: [usize; 2],
}

impl<'a> Left<'a> {
    /// Rows one after the other, `row` floats apart.
    pub(crate) fn rows(values: &'a [f32], row: usize) -> Self {
        Self {
            values,
            row,
            steps: [0, 1],
        }
    }
}

impl<'a> Right<'a> {
    /// Rows one after the other, `row` floats apart.
    pub(crate) fn rows(values: &'a [f32], row: usize) -> Self {
        Self {
            values,
            steps: [0, row],
        }
    }
}

/// What becomes of a finished sum.
#[derive(Clone, Copy)]
pub(crate) enum Finish<'a> {
    /// It replaces the value that was there.
    Stored,
    /// It is added to the value that was there.
    Added,
    /// It replaces the value, with a bias for each column and the leaky ReLU of that slope.
    Activated { bias: &'a [f32], slope: f32 },
}

/// `output = left * right`, summed over two nested counts.
pub(crate) struct Product<'a> {
    /// `[rows, columns]` of the output.
    pub(crate) size: [usize; 2],
    /// Outer and inner number of products in a sum.
    pub(crate) counts: [usize; 2],
    pub(crate) left: Left<'a>,
    pub(crate) right: Right<'a>,
    pub(crate) output: &'a mut [f32],
    /// Distance of the output's rows.
    pub(crate) output_row: usize,
    pub(crate) finish: Finish<'a>,
}

impl Product<'_> {
    pub(crate) fn compute(self) {
        if !self.size.contains(&0) {
            run(self);
        }
    }

    /// Panics unless the largest index of every matrix lies inside its slice.
    fn check(&self) {
        let ([rows, columns], [outer, inner]) = (self.size, self.counts);
        assert!(outer > 0 && inner > 0, "a product without factors");
        let along = |steps: [usize; 2]| (outer - 1) * steps[0] + (inner - 1) * steps[1];
        let left = (rows - 1) * self.left.row + along(self.left.steps);
        let right = along(self.right.steps) + columns - 1;
        let output = (rows - 1) * self.output_row + columns - 1;
        let bias = match self.finish {
            Finish::Activated { bias, .. } => bias.len(),
            Finish::Stored | Finish::Added => columns,
        };
        assert!(
            left < self.left.values.len()
                && right < self.right.values.len()
                && output < self.output.len()
                && columns <= bias,
            "a matrix product reaches beyond its slices"
        );
    }
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        self.check();
        let [rows, columns] = self.size;
        let most = TILE_ROWS[usize::from(S::REGISTER_COUNT < 32)];
        let pair = 2 * S::F32_LANES;
        for column in (0..columns).step_by(pair) {
            let left = columns - column;
            for row in (0..rows).step_by(most) {
                let tile = Tile {
                    row,
                    rows: most.min(rows - row),
                    column,
                };
                let last = Lanes::new(
                    simd,
                    left - left.min(pair).saturating_sub(1) / S::F32_LANES * S::F32_LANES,
                );
                match (
                    left > S::F32_LANES,
                    left.is_multiple_of(S::F32_LANES) || left > pair,
                ) {
                    (true, true) => tile.compute::<S, 2, true>(&mut self, last),
                    (true, false) => tile.compute::<S, 2, false>(&mut self, last),
                    (false, true) => tile.compute::<S, 1, true>(&mut self, last),
                    (false, false) => tile.compute::<S, 1, false>(&mut self, last),
                }
            }
        }
    }
}

/// A part of the output whose sums are kept in registers.
struct Tile {
    row: usize,
    rows: usize,
    column: usize,
}

impl Tile {
    /// `N` vectors of columns; `last` says how much of the last one is used unless it is `WHOLE`.
    #[inline(always)]
    fn compute<S: Simd, const N: usize, const WHOLE: bool>(
        &self,
        product: &mut Product<'_>,
        last: Lanes<S>,
    ) {
        #[expect(unsafe_code, reason = "vectors are read and written through pointers")]
        // SAFETY: `Product::check` has seen the largest index of every matrix, and a tile lies inside the product.
        unsafe {
            match self.rows {
                1 => self.rows::<S, 1, N, WHOLE>(product, last),
                2 => self.rows::<S, 2, N, WHOLE>(product, last),
                3 => self.rows::<S, 3, N, WHOLE>(product, last),
                4 => self.rows::<S, 4, N, WHOLE>(product, last),
                5 => self.rows::<S, 5, N, WHOLE>(product, last),
                6 => self.rows::<S, 6, N, WHOLE>(product, last),
                7 => self.rows::<S, 7, N, WHOLE>(product, last),
                _ => self.rows::<S, 8, N, WHOLE>(product, last),
            }
        }
    }

    /// `M` rows and `N` vectors of columns.
    ///
    /// # Safety
    /// [`Product::check`] must have passed, and the tile's rows and the lanes in use must lie inside the product.
    #[expect(unsafe_code, reason = "vectors are read and written through pointers")]
    #[inline(always)]
    unsafe fn rows<S: Simd, const M: usize, const N: usize, const WHOLE: bool>(
        &self,
        product: &mut Product<'_>,
        last: Lanes<S>,
    ) {
        let simd = last.simd;
        let full = Lanes::all(simd);
        let access = |n: usize| if WHOLE || n + 1 < N { full } else { last };
        let zero = simd.splat_f32s(0.0);
        let mut sums = [[zero; N]; M];
        let (left, right) = (&product.left, &product.right);
        // SAFETY: every index is at most the largest of its matrix, which `Product::check` has seen; of the last vector
        // only the lanes of columns that exist are read and written. The output is borrowed exclusively.
        unsafe {
            for outer in 0..product.counts[0] {
                let from = self.row * left.row + outer * left.steps[0];
                let mut factors = left.values.as_ptr().add(from);
                let from = self.column + outer * right.steps[0];
                let mut vectors = right.values.as_ptr().add(from);
                for _ in 0..product.counts[1] {
                    let mut vector = [zero; N];
                    for (n, vector) in vector.iter_mut().enumerate() {
                        *vector = access(n).load(vectors.add(n * S::F32_LANES));
                    }
                    for (m, sums) in sums.iter_mut().enumerate() {
                        let factor = simd.splat_f32s(*factors.add(m * left.row));
                        for (sum, vector) in sums.iter_mut().zip(vector) {
                            *sum = simd.mul_add_e_f32s(factor, vector, *sum);
                        }
                    }
                    // Beyond the last element these may point outside; they are not read then.
                    factors = factors.wrapping_add(left.steps[1]);
                    vectors = vectors.wrapping_add(right.steps[1]);
                }
            }
            for n in 0..N {
                let column = self.column + n * S::F32_LANES;
                for (m, sums) in sums.iter().enumerate() {
                    let place = (self.row + m) * product.output_row + column;
                    let to = product.output.as_mut_ptr().add(place);
                    let value = match product.finish {
                        Finish::Stored => sums[n],
                        Finish::Added => simd.add_f32s(sums[n], access(n).load(to)),
                        Finish::Activated { bias, slope } => {
                            let bias = access(n).load(bias.as_ptr().add(column));
                            let sum = simd.add_f32s(sums[n], bias);
                            leaky(simd, sum, slope)
                        }
                    };
                    access(n).store(to, value);
                }
            }
        }
    }
}

/// Leaky ReLU of a slope of at most 1; NaN stays NaN.
#[inline(always)]
pub(crate) fn leaky<S: Simd>(simd: S, value: S::f32s, slope: f32) -> S::f32s {
    let positive = simd.less_than_f32s(simd.splat_f32s(0.0), value);
    let below = simd.mul_f32s(value, simd.splat_f32s(slope));
    simd.select_f32s(positive, value, below)
}
