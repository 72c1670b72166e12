use crate::brdf::Surface;
use crate::view::View;
use glam::Vec3;
use normalight_core::Light;
use std::f32::consts::PI;

/// Patches a side that pass light on.
const PATCHES: usize = 12;
/// Exchange smaller than this is not worth following.
const MIN_EXCHANGE: f32 = 2e-4;

/// One bounce of light between facing parts of an object: what makes hollows brighter.
pub(crate) struct Bounces {
    patches: Vec<Patch>,
    /// Light leaving each patch in each image.
    ///
    /// `[patches, images]`
    leaving: Vec<Vec3>,
    images: usize,
}

struct Patch {
    point: Vec3,
    normal: Vec3,
    area: f32,
}

impl Bounces {
    /// Patches from a view of the whole object; `reflectance` at a point of it.
    pub(crate) fn new(view: &View, lights: &[Light], surface_at: impl Fn(Vec3) -> Surface) -> Self {
        let window = view.window;
        let block = window.width.div_ceil(PATCHES).max(1);
        let mut patches = Vec::new();
        let mut leaving = Vec::new();
        for row in (0..window.height).step_by(block) {
            for column in (0..window.width).step_by(block) {
                let Some(patch) = Patch::gather(view, row, column, block) else {
                    continue;
                };
                let surface = surface_at(patch.point);
                let reflectance = surface.albedo + surface.f0 * 0.5;
                leaving.extend(lights.iter().map(|light| {
                    let falling = patch.normal.dot(light.direction).max(0.0);
                    reflectance * (falling * light.intensity[0])
                }));
                patches.push(patch);
            }
        }
        Self {
            patches,
            leaving,
            images: lights.len(),
        }
    }

    /// Adds the light that falls on a point from the patches, relative to a lamp of intensity 1
    /// facing it, to `falling`: one colour per image.
    pub(crate) fn gather(&self, point: Vec3, normal: Vec3, falling: &mut [Vec3]) {
        for (index, patch) in self.patches.iter().enumerate() {
            let between = patch.point - point;
            let out = between.dot(normal);
            let back = -between.dot(patch.normal);
            if out <= 0.0 || back <= 0.0 {
                continue;
            }
            // cos cos area / (pi r^2); the patch's own size keeps near neighbours finite.
            let squared = between.length_squared();
            let exchange = out * back * patch.area / (PI * squared * (squared + patch.area));
            if exchange < MIN_EXCHANGE {
                continue;
            }
            let leaving = &self.leaving[index * self.images..(index + 1) * self.images];
            for (sum, &light) in falling.iter_mut().zip(leaving) {
                *sum += light * exchange;
            }
        }
    }
}

impl Patch {
    /// Mean of a block of pixels.
    fn gather(view: &View, row: usize, column: usize, block: usize) -> Option<Self> {
        let window = view.window;
        let (mut point, mut normal, mut area, mut count) = (Vec3::ZERO, Vec3::ZERO, 0.0, 0.0f32);
        for row in row..(row + block).min(window.height) {
            for column in column..(column + block).min(window.width) {
                let pixel = row * window.width + column;
                if !view.is_inside(pixel) {
                    continue;
                }
                point += Vec3::new(window.x(column), window.y(row), view.depth[pixel]);
                normal += view.normals[pixel];
                // Slanted surfaces are larger than they look.
                area += window.pitch * window.pitch / view.normals[pixel].z.max(0.15);
                count += 1.0;
            }
        }
        (count > 0.0).then(|| Self {
            point: point / count,
            normal: normal.normalize_or(Vec3::Z),
            area,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_facing_patch_gives_its_solid_angle() {
        let patch = Patch {
            point: Vec3::new(0.0, 0.0, 2.0),
            normal: -Vec3::Z,
            area: 0.01,
        };
        let bounces = Bounces {
            patches: vec![patch],
            leaving: vec![Vec3::ONE],
            images: 1,
        };
        let mut falling = [Vec3::ZERO];
        bounces.gather(Vec3::ZERO, Vec3::Z, &mut falling);
        let expected = 0.01 / (PI * 4.0);
        assert!((falling[0].x - expected).abs() < 0.01 * expected);
        // Behind the surface nothing arrives.
        let mut behind = [Vec3::ZERO];
        bounces.gather(Vec3::ZERO, -Vec3::Z, &mut behind);
        assert_eq!(behind[0], Vec3::ZERO);
    }
}
