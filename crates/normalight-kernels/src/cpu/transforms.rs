//! Winograd's F(4x4, 3x3) in one dimension (Lavin & Gray 2016, points 0, 1, -1, 2, -2 and infinity), on anything that
//! can be added and multiplied.

/// Rows and columns of a transformed tile.
pub(crate) const SIDE: usize = 6;

/// Transformed values of a tile.
pub(crate) const POINTS: usize = SIDE * SIDE;

/// Output rows and columns of a tile.
pub(crate) const KEPT: usize = 4;

/// Taps of a kernel.
pub(crate) const TAPS: usize = 9;

/// What the transforms need.
pub(crate) trait Arithmetic: Copy {
    /// A number or a vector of numbers.
    type Value: Copy;

    fn add(self, a: Self::Value, b: Self::Value) -> Self::Value;
    fn subtract(self, a: Self::Value, b: Self::Value) -> Self::Value;
    /// `factor * a + b`.
    fn scale_add(self, factor: f32, a: Self::Value, b: Self::Value) -> Self::Value;
    fn scale(self, factor: f32, a: Self::Value) -> Self::Value;
}

/// Six inputs to their transform.
#[inline(always)]
pub(crate) fn input<A: Arithmetic>(a: A, d: [A::Value; 6]) -> [A::Value; 6] {
    let even = a.scale_add(-4.0, d[2], d[4]);
    let odd = a.scale_add(-4.0, d[1], d[3]);
    let high = a.subtract(d[4], d[2]);
    let steep = a.scale(2.0, a.subtract(d[3], d[1]));
    [
        a.scale_add(4.0, d[0], a.scale_add(-5.0, d[2], d[4])),
        a.add(even, odd),
        a.subtract(even, odd),
        a.add(high, steep),
        a.subtract(high, steep),
        a.scale_add(4.0, d[1], a.scale_add(-5.0, d[3], d[5])),
    ]
}

/// The transpose of [`input`].
#[inline(always)]
pub(crate) fn input_transposed<A: Arithmetic>(a: A, v: [A::Value; 6]) -> [A::Value; 6] {
    let near = a.add(v[1], v[2]);
    let far = a.add(v[3], v[4]);
    let near_slope = a.subtract(v[2], v[1]);
    let far_slope = a.subtract(v[4], v[3]);
    [
        a.scale(4.0, v[0]),
        a.scale_add(4.0, a.add(near_slope, v[5]), a.scale(2.0, far_slope)),
        a.subtract(a.scale_add(-5.0, v[0], a.scale(-4.0, near)), far),
        a.subtract(
            a.scale_add(-5.0, v[5], a.scale(-2.0, far_slope)),
            near_slope,
        ),
        a.add(v[0], a.add(near, far)),
        v[5],
    ]
}

/// Six sums of products to four outputs.
#[inline(always)]
pub(crate) fn output<A: Arithmetic>(a: A, m: [A::Value; 6]) -> [A::Value; 4] {
    let near = a.add(m[1], m[2]);
    let far = a.add(m[3], m[4]);
    let near_slope = a.subtract(m[1], m[2]);
    let far_slope = a.subtract(m[3], m[4]);
    [
        a.add(m[0], a.add(near, far)),
        a.scale_add(2.0, far_slope, near_slope),
        a.scale_add(4.0, far, near),
        a.add(a.scale_add(8.0, far_slope, near_slope), m[5]),
    ]
}

/// The transpose of [`output`].
#[inline(always)]
pub(crate) fn output_transposed<A: Arithmetic>(a: A, y: [A::Value; 4]) -> [A::Value; 6] {
    let even = a.add(y[0], y[2]);
    let odd = a.add(y[1], y[3]);
    let far_even = a.scale_add(4.0, y[2], y[0]);
    let far_odd = a.scale_add(8.0, y[3], a.scale(2.0, y[1]));
    [
        y[0],
        a.add(even, odd),
        a.subtract(even, odd),
        a.add(far_even, far_odd),
        a.subtract(far_even, far_odd),
        y[3],
    ]
}

/// Three taps to their transform.
#[inline(always)]
pub(crate) fn kernel<A: Arithmetic>(a: A, g: [A::Value; 3]) -> [A::Value; 6] {
    let outer = a.scale(-1.0 / 6.0, a.add(g[0], g[2]));
    let middle = a.scale(1.0 / 6.0, g[1]);
    let far = a.scale_add(1.0 / 24.0, g[0], a.scale(1.0 / 6.0, g[2]));
    let far_middle = a.scale(1.0 / 12.0, g[1]);
    [
        a.scale(0.25, g[0]),
        a.subtract(outer, middle),
        a.add(outer, middle),
        a.add(far, far_middle),
        a.subtract(far, far_middle),
        g[2],
    ]
}

/// The transpose of [`kernel`].
#[inline(always)]
pub(crate) fn kernel_transposed<A: Arithmetic>(a: A, u: [A::Value; 6]) -> [A::Value; 3] {
    let near = a.add(u[1], u[2]);
    let far = a.add(u[3], u[4]);
    let near_slope = a.scale(1.0 / 6.0, a.subtract(u[2], u[1]));
    let far_slope = a.scale(1.0 / 12.0, a.subtract(u[3], u[4]));
    let sixth = a.scale(-1.0 / 6.0, near);
    [
        a.scale_add(0.25, u[0], a.scale_add(1.0 / 24.0, far, sixth)),
        a.add(near_slope, far_slope),
        a.add(a.scale_add(1.0 / 6.0, far, sixth), u[5]),
    ]
}

/// Vectors.
#[derive(Clone, Copy)]
pub(crate) struct Vectors<S>(pub(crate) S);

impl<S: pulp::Simd> Arithmetic for Vectors<S> {
    type Value = S::f32s;

    #[inline(always)]
    fn add(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.0.add_f32s(a, b)
    }

    #[inline(always)]
    fn subtract(self, a: S::f32s, b: S::f32s) -> S::f32s {
        self.0.sub_f32s(a, b)
    }

    #[inline(always)]
    fn scale_add(self, factor: f32, a: S::f32s, b: S::f32s) -> S::f32s {
        self.0.mul_add_e_f32s(self.0.splat_f32s(factor), a, b)
    }

    #[inline(always)]
    fn scale(self, factor: f32, a: S::f32s) -> S::f32s {
        self.0.mul_f32s(self.0.splat_f32s(factor), a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plain numbers.
    #[derive(Clone, Copy)]
    struct Numbers;

    impl Arithmetic for Numbers {
        type Value = f32;

        fn add(self, a: f32, b: f32) -> f32 {
            a + b
        }

        fn subtract(self, a: f32, b: f32) -> f32 {
            a - b
        }

        fn scale_add(self, factor: f32, a: f32, b: f32) -> f32 {
            factor * a + b
        }

        fn scale(self, factor: f32, a: f32) -> f32 {
            factor * a
        }
    }

    /// The transform's definition: convolving in the transformed space gives the convolution.
    #[test]
    fn one_dimensional_convolution() {
        let d = [0.3f32, -1.2, 0.7, 2.0, -0.4, 1.1];
        let g = [0.5f32, -0.3, 0.9];
        let (v, u) = (input(Numbers, d), kernel(Numbers, g));
        let found = output(Numbers, std::array::from_fn(|k| v[k] * u[k]));
        for (k, found) in found.into_iter().enumerate() {
            let expected: f32 = (0..3).map(|t| d[k + t] * g[t]).sum();
            assert!((found - expected).abs() < 1e-5, "{k}: {found} {expected}");
        }
    }

    /// <T x, y> = <x, T' y> for each pair.
    #[test]
    fn transposes() {
        fn dot<const N: usize>(a: [f32; N], b: [f32; N]) -> f32 {
            a.iter().zip(b).map(|(a, b)| a * b).sum()
        }
        let six = [0.3f32, -1.2, 0.7, 2.0, -0.4, 1.1];
        let other = [1.3f32, 0.2, -0.8, 0.5, -0.9, 0.4];
        let (four, three) = ([0.4f32, -0.7, 1.2, 0.6], [0.5f32, -0.3, 0.9]);
        let close = |a: f32, b: f32| assert!((a - b).abs() < 1e-4, "{a} {b}");
        close(
            dot(input(Numbers, six), other),
            dot(six, input_transposed(Numbers, other)),
        );
        close(
            dot(output(Numbers, six), four),
            dot(six, output_transposed(Numbers, four)),
        );
        close(
            dot(kernel(Numbers, three), other),
            dot(three, kernel_transposed(Numbers, other)),
        );
    }
}
