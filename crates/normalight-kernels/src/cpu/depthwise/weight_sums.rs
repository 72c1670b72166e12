use super::sizes::Depthwise;
use crate::cpu::vectors::Lanes;
use pulp::{Simd, WithSimd};

/// Sums of products of inputs and gradients: `[taps, period]`.
pub(super) struct WeightSums<'a> {
    pub(super) depthwise: &'a Depthwise,
    pub(super) patch: &'a [f32],
    pub(super) gradient: &'a [f32],
    pub(super) sums: &'a mut [f32],
}

impl WeightSums<'_> {
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
            5 => self.rows::<S, 5>(simd),
            size => unreachable!("kernels of {size} are not among the supported sizes"),
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
                    let row_start = (y * depthwise.stride + tap_row) * line;
                    for from in (place..width).step_by(period) {
                        let lanes = Lanes::new(simd, width - from);
                        // SAFETY: `check` has seen the buffers; a shifted row ends inside its line.
                        unsafe {
                            let gradient = self.gradient.as_ptr().add(y * width + from);
                            let gradient = lanes.load(gradient);
                            for (sum, start) in sums.iter_mut().zip(starts) {
                                let value = self.patch.as_ptr().add(row_start + start + from);
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
