use crate::lanes::{LANES, Lanes, lanes, lanes_mut, vectorised};
use crate::materials::Surfaces;
use crate::scene::Points;
use crate::shapes::View;
use glam::Vec3;
use std::f32::consts::PI;

/// Patches along each side that pass light on.
const PATCHES: usize = 12;
/// Largest share that comes again: where patches touch, form factors are rough.
const MOST_AGAIN: f32 = 0.9;
/// Exchange smaller than this is not worth following.
const MIN_EXCHANGE: f32 = 1e-4;

/// Light that bounces between facing parts of an object: what makes hollows brighter, and their colour
/// stronger.
///
/// The object's visible side is divided into patches; each receives the lamps' light (shadows included)
/// and passes what it scatters on to every point that faces it. What stands between a patch and a point
/// is ignored. Of what arrives at a point the share `g` that its patches would send back on comes again,
/// and of that again, so the first bounce counts `1 / (1 - g)` times: the sum of the Neumann series where
/// `g`, albedo times form factors, is the same all over, exact inside an evenly lit sphere.
pub(crate) struct Bounces {
    patches: Vec<Patch>,
    /// Patch of each point.
    owner: Vec<u32>,
}

struct Patch {
    place: Vec3,
    normal: Vec3,
    area: f32,
    points: f32,
}

impl Bounces {
    pub(crate) fn new(view: &View, points: &Points) -> Self {
        let window = view.window;
        let block = window.width.max(window.height).div_ceil(PATCHES).max(1);
        let per_row = window.width.div_ceil(block);
        let mut numbers = vec![u32::MAX; per_row * window.height.div_ceil(block)];
        let mut patches: Vec<Patch> = Vec::new();
        let mut owner = Vec::with_capacity(points.count());
        for (index, &pixel) in points.pixels.iter().enumerate() {
            let (row, column) = (pixel as usize / window.width, pixel as usize % window.width);
            let number = &mut numbers[row / block * per_row + column / block];
            if *number == u32::MAX {
                *number = patches.len() as u32;
                patches.push(Patch::EMPTY);
            }
            owner.push(*number);
            let (place, normal) = (points.places[index], points.normals[index]);
            // Seen from nearby, pixels cover less of things in front of the plane z = 0.
            let pitch = window.pitch * (1.0 - place.z * window.inverse_distance);
            let patch = &mut patches[*number as usize];
            patch.place += place;
            patch.normal += normal;
            // Slanted surfaces are larger than they look.
            patch.area += pitch * pitch / normal.z.max(0.15);
            patch.points += 1.0;
        }
        for patch in &mut patches {
            patch.place /= patch.points;
            patch.normal = patch.normal.normalize_or(Vec3::Z);
        }
        Self { patches, owner }
    }

    /// Adds the light that has bounced to `radiance`.
    ///
    /// - `irradiance`: for every lamp the light that falls on each point, relative to a lamp of intensity
    ///   1 that faces it, shadows included; padded
    /// - `radiance`: for every lamp red, green and blue of each point, padded
    pub(crate) fn add(
        &self,
        points: &Points,
        surfaces: &Surfaces,
        irradiance: &[Vec<f32>],
        radiance: &mut [[Vec<f32>; 3]],
    ) {
        if self.patches.is_empty() {
            return;
        }
        let leaving = self.leaving(surfaces, irradiance);
        let albedo = self.leaving(surfaces, &[vec![1.0; points.normal[0].len()]]);
        vectorised(
            #[inline(always)]
            || {
                let mut near = Vec::with_capacity(self.patches.len());
                for start in (0..points.normal[0].len()).step_by(LANES) {
                    self.find_near(points, start, &mut near);
                    if near.is_empty() {
                        continue;
                    }
                    let of = |planes: &[f32], row: usize| {
                        let first = row * self.patches.len();
                        falling(&planes[first..first + self.patches.len()], &near)
                    };
                    // What a point scatters of all bounces, relative to what falls on it with the first.
                    let scattered: [Lanes; 3] = std::array::from_fn(|channel| {
                        let mut scattered = *lanes(&surfaces.scattered[channel], start);
                        let again = of(&albedo, channel);
                        for lane in 0..LANES {
                            scattered[lane] /= 1.0 - again[lane].min(MOST_AGAIN);
                        }
                        scattered
                    });
                    for (lamp, planes) in radiance.iter_mut().enumerate() {
                        for (channel, plane) in planes.iter_mut().enumerate() {
                            let falling = of(&leaving, lamp * 3 + channel);
                            let plane = lanes_mut(plane, start);
                            for lane in 0..LANES {
                                plane[lane] += scattered[channel][lane] * falling[lane];
                            }
                        }
                    }
                }
            },
        );
    }

    /// Light that leaves each patch.
    ///
    /// `[lamps, 3, patches]`
    fn leaving(&self, surfaces: &Surfaces, irradiance: &[Vec<f32>]) -> Vec<f32> {
        let count = self.patches.len();
        let mut leaving = vec![0.0; irradiance.len() * 3 * count];
        for (falling, planes) in irradiance.iter().zip(leaving.chunks_exact_mut(3 * count)) {
            for (channel, plane) in planes.chunks_exact_mut(count).enumerate() {
                let scattered = &surfaces.scattered[channel];
                for (index, &owner) in self.owner.iter().enumerate() {
                    plane[owner as usize] += falling[index] * scattered[index];
                }
                for (sum, patch) in plane.iter_mut().zip(&self.patches) {
                    *sum /= patch.points;
                }
            }
        }
        leaving
    }

    /// Finds the patches that pass light on to sixteen points, and the share of a patch's light that
    /// arrives: that of a disc, `cos cos area / (pi r^2 + area)`, which stays finite nearby.
    #[inline(always)]
    fn find_near(&self, points: &Points, start: usize, near: &mut Vec<(usize, Lanes)>) {
        near.clear();
        let place: [&Lanes; 3] = std::array::from_fn(|axis| lanes(&points.place[axis], start));
        let normal: [&Lanes; 3] = std::array::from_fn(|axis| lanes(&points.normal[axis], start));
        for (number, patch) in self.patches.iter().enumerate() {
            let mut exchange = [0.0; LANES];
            let mut most = 0.0;
            for lane in 0..LANES {
                let between = [
                    patch.place.x - place[0][lane],
                    patch.place.y - place[1][lane],
                    patch.place.z - place[2][lane],
                ];
                let out = between[0] * normal[0][lane]
                    + between[1] * normal[1][lane]
                    + between[2] * normal[2][lane];
                let back = -(between[0] * patch.normal.x
                    + between[1] * patch.normal.y
                    + between[2] * patch.normal.z);
                let square =
                    between[0] * between[0] + between[1] * between[1] + between[2] * between[2];
                let facing = if out > 0.0 && back > 0.0 {
                    out * back
                } else {
                    0.0
                };
                let share = facing * patch.area / (square * (PI * square + patch.area) + 1e-12);
                exchange[lane] = share;
                most = if share > most { share } else { most };
            }
            if most > MIN_EXCHANGE {
                near.push((number, exchange));
            }
        }
    }
}

/// What arrives at sixteen points of what leaves the patches.
#[inline(always)]
fn falling(leaving: &[f32], near: &[(usize, Lanes)]) -> Lanes {
    let mut falling = [0.0; LANES];
    for (patch, exchange) in near {
        for lane in 0..LANES {
            falling[lane] += leaving[*patch] * exchange[lane];
        }
    }
    falling
}

impl Patch {
    const EMPTY: Self = Self {
        place: Vec3::ZERO,
        normal: Vec3::ZERO,
        area: 0.0,
        points: 0.0,
    };
}

#[cfg(test)]
mod tests;
