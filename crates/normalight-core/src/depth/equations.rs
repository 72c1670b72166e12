use super::map::centred;
use super::{Integration, Projection};
use crate::{NormalMap, Rect};

/// Below this cosine between surface and line of sight (88 degrees and more) a normal says too little.
const LEAST_FACING: f32 = 0.035;

/// How much a pixel without a usable normal resists being tilted, against 1 for one that is seen straight
/// on: enough to fill it in smoothly, too little to be felt beside it.
const FILLED: Equation = Equation {
    facing: 0.02,
    slopes: [0.0; 2],
};

/// What a pixel says about the differences of heights beside it: `facing * difference = slope`, to the
/// right and downwards.
///
/// Orthographic: `n_z dz/dx = -n_x`. Perspective, with the point at `d (u, v, -f) / f` and the height
/// `h = -f ln(d / f)`, from `n . dP/du = 0`: `(n_z - (u n_x + v n_y) / f) dh/du = -n_x`, which is the same
/// for `f` without end (Cao et al. 2022, in our axes). Rows go down, so the vertical slope is `n_y`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Equation {
    pub(super) facing: f32,
    pub(super) slopes: [f32; 2],
}

impl Equation {
    /// How much the equation counts on the link to another pixel. The paper's weight, the square of the facing,
    /// prefers the flatter of two slopes, so all that bulges comes out too flat. Here the slope is that of the mean of
    /// both normals, the bisector, to which the chord of a circle is at right angles: arcs are exact up to their rim.
    pub(super) fn weight_beside(self, other: Self) -> f32 {
        let usable = |equation: Self| equation.facing > FILLED.facing;
        match usable(self) && usable(other) {
            true => self.facing * (self.facing + other.facing) / 2.0,
            false => self.facing * self.facing,
        }
    }
}

/// The equations of a rectangle of pixels with a border of one pixel that belongs to nothing, so that
/// every pixel inside has four neighbours.
#[derive(Debug)]
pub(super) struct Field {
    /// Length of a row, border included.
    pub(super) stride: usize,
    pub(super) inside: Vec<bool>,
    pub(super) equations: Vec<Equation>,
}

/// Pixels whose normals could not be used.
#[derive(Debug, Default)]
pub(super) struct Unusable {
    pub(super) missing: usize,
    pub(super) steep: usize,
}

impl Field {
    /// Nothing inside yet.
    fn empty(width: usize, height: usize) -> Self {
        let count = (width + 2) * (height + 2);
        Self {
            stride: width + 2,
            inside: vec![false; count],
            equations: vec![Equation::default(); count],
        }
    }

    /// The equations of the pixels of `bounds` that are `inside`.
    pub(super) fn new(
        normals: &NormalMap,
        inside: &[bool],
        bounds: Rect,
        (projection, integration): (Projection, Integration),
    ) -> (Self, Unusable) {
        let mut field = Self::empty(bounds.width, bounds.height);
        let mut unusable = Unusable::default();
        for (pixel, place) in field.places(normals.width(), bounds) {
            if !inside[pixel] {
                continue;
            }
            let normal = normals.normals()[pixel];
            let [u, v] = centred(pixel, normals.width(), normals.height());
            let facing = match projection {
                Projection::Orthographic => normal.z,
                Projection::Perspective { focal } => {
                    normal.z - (u * normal.x + v * normal.y) / focal
                }
            };
            let slopes = [-normal.x, normal.y];
            field.inside[place] = true;
            field.equations[place] = if normal.length_squared() == 0.0 {
                unusable.missing += 1;
                FILLED
            } else if facing < LEAST_FACING {
                unusable.steep += 1;
                FILLED
            } else {
                match integration {
                    Integration::Bilateral => Equation { facing, slopes },
                    Integration::Poisson => Equation {
                        facing: 1.0,
                        slopes: slopes.map(|slope| slope / facing),
                    },
                }
            };
        }
        (field, unusable)
    }

    /// Pixels of a map and their places here, row by row; `bounds` is the part of the map that this is.
    pub(super) fn places(
        &self,
        map_width: usize,
        bounds: Rect,
    ) -> impl Iterator<Item = (usize, usize)> + use<> {
        let stride = self.stride;
        (0..bounds.height).flat_map(move |y| {
            let pixel = (bounds.y + y) * map_width + bounds.x;
            let place = (y + 1) * stride + 1;
            (0..bounds.width).map(move |x| (pixel + x, place + x))
        })
    }

    /// Rows, border included.
    pub(super) fn rows(&self) -> usize {
        self.inside.len() / self.stride
    }

    /// Half as wide and high; equations of four pixels are averaged, which averages their normals.
    pub(super) fn halved(&self) -> Self {
        let (width, height) = (self.stride - 2, self.rows() - 2);
        let mut half = Self::empty(width.div_ceil(2), height.div_ceil(2));
        let mut counts = vec![0u8; half.inside.len()];
        for place in self.inner() {
            let coarse = self.place_in_half(place, half.stride);
            let (sum, own) = (&mut half.equations[coarse], self.equations[place]);
            sum.facing += own.facing;
            for (sum, own) in sum.slopes.iter_mut().zip(own.slopes) {
                *sum += own;
            }
            half.inside[coarse] = true;
            counts[coarse] += 1;
        }
        for (equation, count) in half.equations.iter_mut().zip(counts) {
            let share = 1.0 / f32::from(count.max(1));
            equation.facing *= share;
            equation.slopes = equation.slopes.map(|slope| slope * share);
        }
        half
    }

    /// Heights for this field from those of the halved one: each block of four pixels is continued along
    /// their own slopes, as far as they are not too steep.
    pub(super) fn heights_from_half(&self, half: &Self, heights: &[f32]) -> Vec<f32> {
        const STEEPEST: f32 = 4.0;
        let mut fine = vec![0.0; self.inside.len()];
        for place in self.inner() {
            let own = self.equations[place];
            let sides = [place % self.stride, place / self.stride].map(|at| match at % 2 {
                // Places begin at 1.
                1 => -0.5,
                _ => 0.5,
            });
            let slopes = own.slopes.map(|slope| slope / own.facing);
            let tilt: f32 = slopes
                .iter()
                .zip(sides)
                .map(|(slope, side)| slope.clamp(-STEEPEST, STEEPEST) * side)
                .sum();
            fine[place] = 2.0 * heights[self.place_in_half(place, half.stride)] + tilt;
        }
        fine
    }

    /// Places inside, row by row.
    pub(super) fn inner(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.inside.len()).filter(|&place| self.inside[place])
    }

    fn place_in_half(&self, place: usize, half_stride: usize) -> usize {
        let (x, y) = (place % self.stride, place / self.stride);
        y.div_ceil(2) * half_stride + x.div_ceil(2)
    }
}
