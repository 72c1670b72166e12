use crate::cpu::vectors::{Lanes, WIDEST};
use pulp::{Simd, WithSimd};

/// One row as a sum over taps of shifted rows times repeated weights.
pub(super) struct Row<'a> {
    values: &'a [f32],
    weight: &'a [f32],
    period: usize,
    out: &'a mut [f32],
    /// Starts in `values` and in `weight`.
    taps: [(usize, usize); 25],
    count: usize,
}

impl<'a> Row<'a> {
    pub(super) fn new(
        values: &'a [f32],
        weight: &'a [f32],
        period: usize,
        out: &'a mut [f32],
        starts: impl Iterator<Item = (usize, usize)>,
    ) -> Self {
        let mut taps = [(0, 0); 25];
        let mut count = 0;
        // A larger kernel than there are taps for ends here, not in a sum of some of them.
        for start in starts {
            taps[count] = start;
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
