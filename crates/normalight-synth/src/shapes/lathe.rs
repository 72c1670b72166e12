use glam::{Mat3, Vec2, Vec3};

/// Cosine of the steepest angle that walls lean by, with radii that change by twice the height.
const LEANING: f32 = 0.45;

/// A body turned on a lathe: a radius that depends on the height along its axis.
#[derive(Debug, Clone)]
pub(crate) struct Lathe {
    /// Radii at evenly spaced heights from bottom to top, at least two.
    radii: Vec<f32>,
    half_height: f32,
    /// Rounding of the rims.
    rounding: f32,
    hollow: Option<Hollow>,
    to_upright: Mat3,
}

/// The inside of a bowl.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hollow {
    /// Thickness of the wall.
    pub(crate) wall: f32,
    /// Height of the inner floor, -half_height..half_height.
    pub(crate) floor: f32,
}

impl Lathe {
    /// Upright around the origin.
    pub(crate) fn new(
        radii: Vec<f32>,
        half_height: f32,
        rounding: f32,
        hollow: Option<Hollow>,
    ) -> Self {
        Self {
            radii,
            half_height,
            rounding,
            hollow,
            to_upright: Mat3::IDENTITY,
        }
    }

    pub(crate) fn rotated(mut self, rotation: Mat3) -> Self {
        self.to_upright *= rotation.transpose();
        self
    }

    /// Radius of a sphere around the origin that holds the body.
    pub(crate) fn reach(&self) -> f32 {
        let radius = self.widest();
        (radius * radius + self.half_height * self.half_height).sqrt()
    }

    /// Half extents to the right and up of a rectangle around the origin that holds the body.
    pub(crate) fn extent(&self) -> Vec2 {
        let axis = self.to_upright.transpose() * Vec3::Y;
        let along = axis.truncate().abs();
        let across = (Vec2::ONE - along * along).max(Vec2::ZERO).map(f32::sqrt);
        along * self.half_height + across * self.widest()
    }

    /// How far a ray may go at this distance without leaping over a wall.
    pub(crate) fn furthest(&self, distance: f32) -> f32 {
        let within = |hollow: Hollow| LEANING * (distance + hollow.wall / 2.0);
        self.hollow.map_or(f32::INFINITY, within)
    }

    /// Share of its distance that is safe to walk. The distance is right for a wall that leans as it does at
    /// the point's height; rays that come down into a hollow meet it where it leans more.
    pub(crate) fn step(&self) -> f32 {
        self.hollow.map_or(0.8, |_| LEANING)
    }

    fn widest(&self) -> f32 {
        // Splines overshoot a little.
        1.1 * self.radii.iter().fold(0.0f32, |a, &b| a.max(b))
    }

    /// Largest radius near a height in -half_height..half_height, for placing handles.
    pub(crate) fn radius_at(&self, height: f32) -> f32 {
        self.radius_and_slope(height).0
    }

    /// Estimate of the signed distance, negative inside.
    #[inline]
    pub(crate) fn distance(&self, point: Vec3) -> f32 {
        let upright = self.to_upright * point;
        let out = Vec2::new(upright.x, upright.z).length();
        let height = upright.y;
        let (radius, slope) = self.radius_and_slope(height);
        let shrink = 1.0 / (1.0 + slope * slope).sqrt();
        let side = (out - radius) * shrink;
        let solid = rounded_max(side, height.abs() - self.half_height, self.rounding);
        let Some(hollow) = self.hollow else {
            return solid;
        };
        let inner_side = (out - (radius - hollow.wall)) * shrink;
        let inside = rounded_max(inner_side, hollow.floor - height, 3.0 * self.rounding);
        rounded_max(solid, -inside, self.rounding)
    }

    /// Catmull-Rom spline through the radii and its derivative by the height.
    #[inline]
    fn radius_and_slope(&self, height: f32) -> (f32, f32) {
        let last = self.radii.len() - 1;
        let per_height = last as f32 / (2.0 * self.half_height);
        let position = ((height + self.half_height) * per_height).clamp(0.0, last as f32);
        let start = (position as usize).min(last - 1);
        let t = position - start as f32;
        let before = self.radii[start.saturating_sub(1)];
        let (a, b) = (self.radii[start], self.radii[start + 1]);
        let after = self.radii[(start + 2).min(last)];
        let (slope_a, slope_b) = ((b - before) / 2.0, (after - a) / 2.0);
        let square = 3.0 * (b - a) - 2.0 * slope_a - slope_b;
        let cube = 2.0 * (a - b) + slope_a + slope_b;
        (
            a + t * (slope_a + t * (square + t * cube)),
            (slope_a + t * (2.0 * square + 3.0 * cube * t)) * per_height,
        )
    }
}

/// Larger of two numbers, with the corner rounded over `width`.
#[inline]
pub(crate) fn rounded_max(a: f32, b: f32, width: f32) -> f32 {
    let overlap = (width - (a - b).abs()).max(0.0);
    a.max(b) + overlap * overlap / (4.0 * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constant_radius_gives_a_cylinder() {
        let lathe = Lathe::new(vec![0.5; 6], 1.0, 0.01, None);
        assert!((lathe.distance(Vec3::new(1.0, 0.2, 0.0)) - 0.5).abs() < 1e-5);
        assert!((lathe.distance(Vec3::new(0.0, 1.3, 0.1)) - 0.3).abs() < 1e-5);
    }

    #[test]
    fn hollow_body_is_empty_above_its_floor() {
        let hollow = Hollow {
            wall: 0.1,
            floor: -0.8,
        };
        let lathe = Lathe::new(vec![0.5; 6], 1.0, 0.01, Some(hollow));
        assert!(lathe.distance(Vec3::ZERO) > 0.3);
        assert!(lathe.distance(Vec3::new(0.45, 0.0, 0.0)) < 0.0);
        assert!(lathe.distance(Vec3::new(0.0, -0.9, 0.0)) < 0.0);
    }

    #[test]
    fn slope_is_the_derivative_of_the_radius() {
        let lathe = Lathe::new(vec![0.5, 0.2, 0.9, 0.4, 0.6], 1.0, 0.01, None);
        for step in 0..19 {
            let height = -0.93 + 0.1 * step as f32;
            let difference =
                (lathe.radius_at(height + 1e-3) - lathe.radius_at(height - 1e-3)) / 2e-3;
            let slope = lathe.radius_and_slope(height).1;
            assert!((difference - slope).abs() < 2e-2, "{difference} {slope}");
        }
    }
}
