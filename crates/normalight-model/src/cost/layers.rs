//! What single layers cost.

use std::iter::Sum;
use std::ops::{Add, Mul};

/// What some layers cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Trainable parameters, batch norm included.
    pub parameters: usize,
    /// Multiply-adds of convolutions and fully connected layers.
    pub multiply_adds: u64,
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            parameters: self.parameters + other.parameters,
            multiply_adds: self.multiply_adds + other.multiply_adds,
        }
    }
}

impl Mul<usize> for Cost {
    type Output = Self;

    fn mul(self, count: usize) -> Self {
        Self {
            parameters: self.parameters * count,
            multiply_adds: self.multiply_adds * count as u64,
        }
    }
}

impl Sum for Cost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::default(), Self::add)
    }
}

/// A 1x1 convolution without bias, and batch norm.
pub(super) fn pointwise(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: from * to + 2 * to,
        multiply_adds: (from * to * area) as u64,
    }
}

/// A 3x3 convolution with bias and that many output pixels.
pub(super) fn conv(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: 9 * from * to + to,
        multiply_adds: (9 * from * to * area) as u64,
    }
}

/// A 4x4 transposed convolution with bias that doubles the size, and that many output pixels.
pub(super) fn transposed(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: 16 * from * to + to,
        multiply_adds: (4 * from * to * area) as u64,
    }
}

/// A 1x1 convolution with bias and that many output pixels.
pub(super) fn biased(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: from * to + to,
        multiply_adds: (from * to * area) as u64,
    }
}

pub(super) fn dense(from: usize, to: usize) -> Cost {
    Cost {
        parameters: from * to + to,
        multiply_adds: (from * to) as u64,
    }
}
