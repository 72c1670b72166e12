//! The transforms of the weights, a vector of them at a time.
use crate::cpu::transforms::{POINTS, SIDE, TAPS, Vectors, kernel, kernel_transposed};
use crate::cpu::vectors::Lanes;
use pulp::{Simd, WithSimd};

/// Nine planes of weights to 36.
pub(super) struct WeightTransform<'a> {
    pub(super) weight: &'a [f32],
    pub(super) points: &'a mut [f32],
}

/// Panics unless these are lengths of the same kernels, given and transformed.
fn check_planes(weight: usize, points: usize) {
    assert!(
        weight.is_multiple_of(TAPS) && weight / TAPS * POINTS == points,
        "weights and transformed weights of different kernels"
    );
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
impl WithSimd for WeightTransform<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        check_planes(self.weight.len(), self.points.len());
        let a = Vectors(simd);
        let plane = self.weight.len() / TAPS;
        for first in (0..plane).step_by(S::F32_LANES) {
            let lanes = Lanes::new(simd, plane - first);
            let mut half = [[simd.splat_f32s(0.0); 3]; SIDE];
            for x in 0..3 {
                // SAFETY: `check_planes` has seen the planes, and the lanes end with them.
                let column = std::array::from_fn(|y| unsafe {
                    lanes.load(self.weight.as_ptr().add((y * 3 + x) * plane + first))
                });
                for (half, value) in half.iter_mut().zip(kernel(a, column)) {
                    half[x] = value;
                }
            }
            for (y, half) in half.into_iter().enumerate() {
                for (x, value) in kernel(a, half).into_iter().enumerate() {
                    let to = (y * SIDE + x) * plane + first;
                    // SAFETY: as above.
                    unsafe { lanes.store(self.points.as_mut_ptr().add(to), value) };
                }
            }
        }
    }
}

/// The transpose of [`WeightTransform`].
pub(super) struct WeightGradientTransform<'a> {
    pub(super) points: &'a [f32],
    pub(super) weight: &'a mut [f32],
}

#[expect(unsafe_code, reason = "vectors are read and written through pointers")]
impl WithSimd for WeightGradientTransform<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        check_planes(self.weight.len(), self.points.len());
        let a = Vectors(simd);
        let plane = self.weight.len() / TAPS;
        for first in (0..plane).step_by(S::F32_LANES) {
            let lanes = Lanes::new(simd, plane - first);
            let mut half = [[simd.splat_f32s(0.0); SIDE]; 3];
            for x in 0..SIDE {
                // SAFETY: `check_planes` has seen the planes, and the lanes end with them.
                let column = std::array::from_fn(|y| unsafe {
                    lanes.load(self.points.as_ptr().add((y * SIDE + x) * plane + first))
                });
                for (half, value) in half.iter_mut().zip(kernel_transposed(a, column)) {
                    half[x] = value;
                }
            }
            for (y, half) in half.into_iter().enumerate() {
                for (x, value) in kernel_transposed(a, half).into_iter().enumerate() {
                    let to = (y * 3 + x) * plane + first;
                    // SAFETY: as above.
                    unsafe { lanes.store(self.weight.as_mut_ptr().add(to), value) };
                }
            }
        }
    }
}
