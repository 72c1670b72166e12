use crate::view::View;
use glam::Vec3;

/// How far behind its visible side an object is taken to be solid. The depth map knows only the
/// front; infinitely deep objects would throw shadows that are too long.
const THICKNESS: f32 = 0.6;
/// Steps grow by this factor: far obstacles need less precision.
const GROWTH: f32 = 1.12;
/// Enough for 300 pixels.
const MAX_STEPS: usize = 32;

/// Cast shadows from depth maps: a fine one around the sample, a coarse one of all the rest.
pub(crate) struct Shadows<'a> {
    fine: &'a View,
    coarse: Option<&'a View>,
    /// Highest z of anything.
    top: f32,
}

impl<'a> Shadows<'a> {
    pub(crate) fn new(fine: &'a View, coarse: Option<&'a View>) -> Self {
        let views = std::iter::once(fine).chain(coarse);
        let top = views
            .flat_map(|view| view.depth.iter().copied())
            .fold(f32::NEG_INFINITY, f32::max);
        Self { fine, coarse, top }
    }

    /// Share of the lamp a point of the surface sees: 0 in shadow, 1 lit, between at the border.
    pub(crate) fn lit(&self, point: Vec3, normal: Vec3, lamp: Vec3) -> f32 {
        let fine_lit = self.march(self.fine, point, normal, lamp);
        match self.coarse {
            Some(coarse) if fine_lit > 0.0 => fine_lit.min(self.march(coarse, point, normal, lamp)),
            _ => fine_lit,
        }
    }

    fn march(&self, view: &View, point: Vec3, normal: Vec3, lamp: Vec3) -> f32 {
        let flat = (lamp.x * lamp.x + lamp.y * lamp.y).sqrt();
        if flat < 1e-3 {
            return 1.0;
        }
        let window = view.window;
        // Raised by a pixel along the normal, the ray clears the steps of the map on its own slope.
        let start = point + normal * (1.2 * window.pitch);
        let inverse_pitch = 1.0 / window.pitch;
        let column = (start.x - window.left) * inverse_pitch;
        let row = (window.top - start.y) * inverse_pitch;
        let (per_column, per_row) = (lamp.x / flat, -lamp.y / flat);
        let rise = lamp.z / flat * window.pitch;
        let (width, height) = (window.width as i32, window.height as i32);
        let mut lit = 1.0f32;
        let (mut walked, mut step) = (0.0, 1.0);
        for _ in 0..MAX_STEPS {
            walked += step;
            step *= GROWTH;
            let z = start.z + rise * walked;
            // Truncation takes the strip up to one pixel outside for inside: its depth is that of
            // the border, which does no harm.
            let column = (column + per_column * walked) as i32;
            let row = (row + per_row * walked) as i32;
            if z > self.top || column < 0 || row < 0 || column >= width || row >= height {
                break;
            }
            let clearance = z - view.depth[(row * width + column) as usize];
            if clearance > -THICKNESS {
                // A pixel of half shadow.
                lit = lit.min(1.0 + clearance * inverse_pitch);
                if lit <= 0.0 {
                    return 0.0;
                }
            }
        }
        lit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Window;

    /// A floor at z = 0 with a wall of height 1 on the left part, x < 0.
    fn wall() -> View {
        let size = 64;
        let window = Window {
            left: -2.0,
            top: 2.0,
            pitch: 4.0 / 64.0,
            width: size,
            height: size,
        };
        let depth = (0..size * size)
            .map(|pixel| {
                if window.x(pixel % size) < 0.0 {
                    0.5
                } else {
                    0.0
                }
            })
            .collect();
        View {
            window,
            depth,
            normals: vec![Vec3::Z; size * size],
        }
    }

    #[test]
    fn a_wall_shades_the_floor_behind_it() {
        let view = wall();
        let shadows = Shadows::new(&view, None);
        // 45 degrees from the left: the shadow is as long as the wall is high.
        let lamp = Vec3::new(-1.0, 0.0, 1.0).normalize();
        assert_eq!(shadows.lit(Vec3::new(0.25, 0.0, 0.0), Vec3::Z, lamp), 0.0);
        assert_eq!(shadows.lit(Vec3::new(0.75, 0.0, 0.0), Vec3::Z, lamp), 1.0);
        // From the right nothing is in the way.
        let other = Vec3::new(1.0, 0.0, 1.0).normalize();
        assert_eq!(shadows.lit(Vec3::new(0.25, 0.0, 0.0), Vec3::Z, other), 1.0);
        assert_eq!(shadows.lit(Vec3::new(-0.25, 0.0, 0.5), Vec3::Z, lamp), 1.0);
    }
}
