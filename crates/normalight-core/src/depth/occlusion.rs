use super::DepthMap;
use crate::Vec3;
use std::f32::consts::{FRAC_PI_2, PI};

/// Planes through the line of sight in which horizons are looked for.
const SLICES: usize = 12;

/// How far each sample lies beyond the last, at least one pixel: near walls hide most.
const GROWTH: f32 = 1.25;

impl DepthMap {
    /// Share (0..=1) of the light of an evenly bright sky that reaches every pixel, weighted by the cosine
    /// to the surface's normal: 1 on planes and bulges, `sin^2 a` in a groove whose walls meet at the angle
    /// `2 a`; 1 outside the mask. Only what lies within `radius` pixels hides the sky.
    ///
    /// Horizons in a few planes through the line of sight, integrated in closed form (Jiménez, Wu, Pesce &
    /// Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion", SIGGRAPH 2016 course,
    /// equation 7).
    pub fn ambient_occlusion(&self, radius: f32) -> Vec<f32> {
        let normals = self.surface_normals();
        let walks: Vec<Walk> = (0..SLICES).map(|slice| Walk::new(slice, radius)).collect();
        let mut light = vec![1.0; normals.len()];
        for pixel in self.mask().pixels() {
            let sum: f32 = walks
                .iter()
                .map(|walk| walk.light(self, pixel, normals[pixel]))
                .sum();
            light[pixel] = (sum / SLICES as f32).clamp(0.0, 1.0);
        }
        light
    }
}

/// A plane through the line of sight: its direction, and the steps along it.
struct Walk {
    /// Right and up, of unit length.
    direction: Vec3,
    steps: Vec<[isize; 2]>,
}

impl Walk {
    fn new(slice: usize, radius: f32) -> Self {
        let angle = PI * (slice as f32 + 0.5) / SLICES as f32;
        let direction = Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.0);
        let mut steps: Vec<[isize; 2]> = Vec::new();
        let mut distance = 1.0f32;
        while distance <= radius.min(1e5) {
            let step = [direction.x, -direction.y].map(|side| (side * distance).round() as isize);
            if steps.last() != Some(&step) {
                steps.push(step);
            }
            distance = f32::max(distance + 1.0, distance * GROWTH);
        }
        Self { direction, steps }
    }

    /// Light that comes to a pixel within the plane.
    fn light(&self, depth: &DepthMap, pixel: usize, normal: Vec3) -> f32 {
        let across = Vec3::Z.cross(self.direction);
        let within = normal - across * normal.dot(across);
        let length = within.length();
        if length == 0.0 {
            return 0.0;
        }
        // The angle of the normal within the plane, from the line of sight towards the direction.
        let tilt = libm::atan2f(within.dot(self.direction), within.z);
        let [ahead, behind] = [1, -1].map(|way| {
            let highest = self.highest(depth, pixel, way);
            // From the line of sight, and not below the surface's own plane.
            let horizon = FRAC_PI_2 - libm::atanf(highest);
            let tilt = tilt * way as f32;
            horizon.min(tilt + FRAC_PI_2)
        });
        let arc = |horizon: f32, tilt: f32| {
            libm::cosf(tilt) - libm::cosf(2.0 * horizon - tilt) + 2.0 * horizon * libm::sinf(tilt)
        };
        // Behind, angles are counted the other way.
        length * (arc(ahead, tilt) + arc(behind, -tilt)) / 4.0
    }

    /// Steepest rise to anything on one side.
    fn highest(&self, depth: &DepthMap, pixel: usize, way: isize) -> f32 {
        let (width, height) = (depth.width() as isize, depth.height() as isize);
        let (x, y) = (pixel as isize % width, pixel as isize / width);
        let here = depth.position(pixel);
        let mut highest = f32::NEG_INFINITY;
        for [right, down] in &self.steps {
            let (x, y) = (x + way * right, y + way * down);
            if x < 0 || y < 0 || x >= width || y >= height {
                break;
            }
            let other = (y * width + x) as usize;
            if depth.mask().inside()[other] {
                let to = depth.position(other) - here;
                highest = highest.max(to.z / to.x.hypot(to.y).max(f32::MIN_POSITIVE));
            }
        }
        highest
    }
}
