use glam::Vec3;

/// One of the eight ways to turn and mirror a picture, and with it the world before the camera: the
/// symmetries of the square. A transposition comes first, then the mirrorings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Symmetry {
    /// Rows become columns.
    pub transposed: bool,
    /// Left and right change places.
    pub mirrored: bool,
    /// Top and bottom change places.
    pub upside_down: bool,
}

impl Symmetry {
    /// Everything stays where it is.
    pub const NONE: Self = Self::new(false, false, false);

    /// All eight: first the four that keep rows, of these first the two that keep up and down.
    pub const ALL: [Self; 8] = [
        Self::NONE,
        Self::new(false, true, false),
        Self::new(false, false, true),
        Self::new(false, true, true),
        Self::new(true, false, false),
        Self::new(true, true, false),
        Self::new(true, false, true),
        Self::new(true, true, true),
    ];

    const fn new(transposed: bool, mirrored: bool, upside_down: bool) -> Self {
        Self {
            transposed,
            mirrored,
            upside_down,
        }
    }

    /// The one that brings everything back.
    pub fn inverse(self) -> Self {
        if self.transposed {
            // What mirrors columns after the transposition mirrors rows before it.
            Self::new(true, self.upside_down, self.mirrored)
        } else {
            self
        }
    }

    /// Width and height of a picture afterwards.
    pub fn size(self, width: usize, height: usize) -> (usize, usize) {
        if self.transposed {
            (height, width)
        } else {
            (width, height)
        }
    }

    /// Column and row to which a pixel of a picture of `width` x `height` goes.
    pub fn pixel(self, x: usize, y: usize, width: usize, height: usize) -> (usize, usize) {
        let (width, height) = self.size(width, height);
        let (x, y) = if self.transposed { (y, x) } else { (x, y) };
        let mirror =
            |place: usize, length, mirrored| if mirrored { length - 1 - place } else { place };
        (
            mirror(x, width, self.mirrored),
            mirror(y, height, self.upside_down),
        )
    }

    /// Where a direction goes: x right, y up, z to the camera.
    pub fn vector(self, vector: Vec3) -> Vec3 {
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
    use std::collections::HashSet;

    const WIDTH: usize = 5;
    const HEIGHT: usize = 4;

    fn pixels() -> impl Iterator<Item = (usize, usize)> {
        (0..WIDTH * HEIGHT).map(|index| (index % WIDTH, index / WIDTH))
    }

    #[test]
    fn pixels_and_directions_go_the_same_way() {
        for symmetry in Symmetry::ALL {
            let (width, height) = symmetry.size(WIDTH, HEIGHT);
            // Seen from the picture's middle, twice as large so that it stays whole.
            let towards = |(x, y): (usize, usize), width: usize, height: usize| {
                let (right, down) = (2 * x + 1, 2 * y + 1);
                let up = height as f32 - down as f32;
                Vec3::new(right as f32 - width as f32, up, 1.0)
            };
            for (x, y) in pixels() {
                let turned = symmetry.pixel(x, y, WIDTH, HEIGHT);
                assert_eq!(
                    symmetry.vector(towards((x, y), WIDTH, HEIGHT)),
                    towards(turned, width, height),
                    "{symmetry:?}"
                );
            }
        }
    }

    #[test]
    fn the_inverse_brings_everything_back() {
        let vector = Vec3::new(1.0, 2.0, 3.0);
        let mut places = HashSet::new();
        for symmetry in Symmetry::ALL {
            let inverse = symmetry.inverse();
            let (width, height) = symmetry.size(WIDTH, HEIGHT);
            for (x, y) in pixels() {
                let (there, down) = symmetry.pixel(x, y, WIDTH, HEIGHT);
                assert_eq!(inverse.pixel(there, down, width, height), (x, y));
            }
            assert_eq!(inverse.vector(symmetry.vector(vector)), vector);
            places.insert(symmetry.vector(vector).to_array().map(|v| v as i32));
        }
        assert_eq!(places.len(), 8, "two are the same");
    }
}
