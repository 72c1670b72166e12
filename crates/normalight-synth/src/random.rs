use glam::{Mat3, Vec3};
use rand_pcg::{Pcg32, rand_core::Rng};
use std::f32::consts::TAU;

/// What a stream of random numbers decides; each has its own, so that drawing more lights does not
/// change the shape.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Stream {
    Shape,
    Material,
    Lights,
    Framing,
    Camera,
    Crop,
    Overlay,
}

/// A number without any visible relation to those of its neighbours: the step and the finaliser of
/// SplitMix64 (Steele et al. 2014).
pub fn scrambled(number: u64) -> u64 {
    let mut state = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^ (state >> 31)
}

/// Random numbers that are the same on every machine.
#[derive(Debug, Clone)]
pub(crate) struct Random(Pcg32);

impl Random {
    pub(crate) fn new(seed: u64, stream: Stream) -> Self {
        // Neighbouring seeds must not give neighbouring states.
        Self(Pcg32::new(scrambled(seed), stream as u64))
    }

    /// Uniform in [0, 1), 24 bits.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as f32 / 16_777_216.0
    }

    pub(crate) fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Uniform in -size..size.
    pub(crate) fn signed(&mut self, size: f32) -> f32 {
        self.range(-size, size)
    }

    /// Uniform in the logarithm; both ends are raised to a tiny positive number.
    pub(crate) fn log_range(&mut self, low: f32, high: f32) -> f32 {
        let low = low.max(1e-6);
        low * libm::powf(high.max(1e-6) / low, self.unit())
    }

    /// Sum of twelve uniforms: mean 0, deviation 1, and no logarithm.
    pub(crate) fn normal(&mut self) -> f32 {
        (0..12).map(|_| self.unit()).sum::<f32>() - 6.0
    }

    pub(crate) fn chance(&mut self, probability: f32) -> bool {
        self.unit() < probability
    }

    /// Whole number in 0..count, `count` below 2^24.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f32) as usize).min(count - 1)
    }

    /// Whole number in low..=high.
    pub(crate) fn count(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high - low + 1)
    }

    /// Index drawn with the given weights; the last when all are zero.
    pub(crate) fn weighted(&mut self, weights: &[f32]) -> usize {
        let mut rest = self.unit() * weights.iter().sum::<f32>();
        for (index, &weight) in weights.iter().enumerate() {
            if rest < weight {
                return index;
            }
            rest -= weight;
        }
        // Rounding may leave a remainder; an index of weight zero must not be drawn.
        let last = weights.iter().rposition(|&weight| weight > 0.0);
        last.unwrap_or(weights.len() - 1)
    }

    /// The first `count` of the numbers 0..total in a random order.
    pub(crate) fn some_of(&mut self, total: usize, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..total).collect();
        let count = count.min(total);
        for place in 0..count {
            let other = place + self.below(total - place);
            order.swap(place, other);
        }
        order.truncate(count);
        order
    }

    /// Uniform on the unit sphere.
    pub(crate) fn direction(&mut self) -> Vec3 {
        let z = self.signed(1.0);
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let angle = self.range(0.0, TAU);
        Vec3::new(radius * libm::cosf(angle), radius * libm::sinf(angle), z)
    }

    /// Every component uniform in -size..size.
    pub(crate) fn vector(&mut self, size: f32) -> Vec3 {
        Vec3::new(self.signed(size), self.signed(size), self.signed(size))
    }

    pub(crate) fn rotation(&mut self) -> Mat3 {
        let z = self.direction();
        let x = z
            .cross(self.direction())
            .normalize_or(z.any_orthonormal_vector());
        Mat3::from_cols(x, z.cross(x), z)
    }
}

/// Rotation about the x axis: positive angles turn the top (y) towards the camera (z).
pub(crate) fn about_x(angle: f32) -> Mat3 {
    let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
    Mat3::from_cols(Vec3::X, Vec3::new(0.0, cos, sin), Vec3::new(0.0, -sin, cos))
}

/// Rotation about the vertical axis.
pub(crate) fn about_y(angle: f32) -> Mat3 {
    let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
    Mat3::from_cols(Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos))
}

/// Rotation about the viewing axis.
pub(crate) fn about_z(angle: f32) -> Mat3 {
    let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
    Mat3::from_cols(Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0), Vec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_no_weight_is_drawn() {
        let weights = [0.12, 0.33, 0.72, 0.71, 0.94, 0.42, 0.0];
        let mut random = Random::new(1, Stream::Shape);
        let mut counts = [0u32; 7];
        for _ in 0..30_000 {
            counts[random.weighted(&weights)] += 1;
        }
        assert_eq!(counts[6], 0);
        for (count, weight) in counts.iter().zip(weights) {
            let expected = 30_000.0 * weight / 3.24;
            assert!((*count as f32 - expected).abs() < 0.06 * expected + 1.0);
        }
        assert_eq!(random.weighted(&[0.0, 1.0, 0.0]), 1);
    }
}
