use crate::random::Random;
use glam::{Mat3, Vec3};

/// One of the ways to turn and mirror a square picture, and the world with it; and an order of the
/// colours.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Symmetry {
    turned: normalight_core::Symmetry,
    /// Which channel becomes red, green and blue.
    pub(crate) channels: [usize; 3],
}

impl Symmetry {
    pub(crate) const NONE: Self = Self {
        turned: normalight_core::Symmetry::NONE,
        channels: [0, 1, 2],
    };

    pub(crate) fn draw(random: &mut Random) -> Self {
        const ORDERS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ];
        Self {
            turned: normalight_core::Symmetry {
                transposed: random.chance(0.5),
                mirrored: random.chance(0.5),
                upside_down: random.chance(0.5),
            },
            channels: ORDERS[random.below(ORDERS.len())],
        }
    }

    /// Where a pixel of a square of `size` goes.
    pub(crate) fn pixel(&self, row: usize, column: usize, size: usize) -> (usize, usize) {
        let (column, row) = self.turned.pixel(column, row, size, size);
        (row, column)
    }

    /// Where directions go, as a matrix.
    pub(crate) fn axes(&self) -> Mat3 {
        Mat3::from_cols(
            self.vector(Vec3::X),
            self.vector(Vec3::Y),
            self.vector(Vec3::Z),
        )
    }

    /// Where a direction goes.
    pub(crate) fn vector(&self, vector: Vec3) -> Vec3 {
        self.turned.vector(vector)
    }
}
