use crate::random::Random;
use glam::{Mat3, Vec3};

/// One of the ways to turn and mirror a square picture, and the world with it; and an order of the
/// colours.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Symmetry {
    transposed: bool,
    mirrored: bool,
    upside_down: bool,
    /// Which channel becomes red, green and blue.
    pub(crate) channels: [usize; 3],
}

impl Symmetry {
    pub(crate) const NONE: Self = Self {
        transposed: false,
        mirrored: false,
        upside_down: false,
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
            transposed: random.chance(0.5),
            mirrored: random.chance(0.5),
            upside_down: random.chance(0.5),
            channels: ORDERS[random.below(ORDERS.len())],
        }
    }

    /// Where a pixel of a square of `size` goes.
    pub(crate) fn pixel(&self, row: usize, column: usize, size: usize) -> (usize, usize) {
        let (row, column) = if self.transposed {
            (column, row)
        } else {
            (row, column)
        };
        let mirror = |place: usize, mirrored: bool| if mirrored { size - 1 - place } else { place };
        (mirror(row, self.upside_down), mirror(column, self.mirrored))
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
        // Rows run against y: exchanging rows and columns exchanges x and -y.
        let mut vector = if self.transposed {
            Vec3::new(-vector.y, -vector.x, vector.z)
        } else {
            vector
        };
        if self.mirrored {
            vector.x = -vector.x;
        }
        if self.upside_down {
            vector.y = -vector.y;
        }
        vector
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;

    #[test]
    fn pixels_and_directions_turn_the_same_way() {
        let mut random = Random::new(4, Stream::Framing);
        let size = 9;
        let middle = (size / 2, size / 2);
        for _ in 0..50 {
            let symmetry = Symmetry::draw(&mut random);
            let (row, column) = (random.below(size), random.below(size));
            let towards = |(row, column): (usize, usize)| {
                Vec3::new(
                    column as f32 - middle.1 as f32,
                    middle.0 as f32 - row as f32,
                    0.0,
                )
            };
            let turned = towards(symmetry.pixel(row, column, size));
            assert_eq!(
                symmetry.vector(towards((row, column))),
                turned,
                "{symmetry:?}"
            );
        }
    }
}
