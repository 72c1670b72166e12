//! Light in grooves too narrow for the picture's depth: what their walls keep from their ground.
use super::Lamp;
use crate::lanes::{LANES, Lanes, lanes, lanes_mut, vectorised};
use crate::scene::Points;
use std::f32::consts::FRAC_2_PI;

/// Reduces the share of the lamp that points see.
///
/// The ground of a groove with upright walls, `ratio` times as deep as wide, is lit but for the share
/// `ratio * tan` that its wall shades, `tan` being that of the angle between lamp and normal within the
/// groove's cross-section. Grooves run in all directions: on average that is 2 / pi of the tangent of the
/// whole angle.
///
/// `lit`: padded; points without grooves are left as they are.
pub(crate) fn narrow(lamp: &Lamp, points: &Points, lit: &mut [f32]) {
    if points.grooves.is_empty() {
        return;
    }
    vectorised(
        #[inline(always)]
        || {
            for start in (0..lit.len()).step_by(LANES) {
                let (to_lamp, _) = lamp.seen_from(points, start);
                let normal: [&Lanes; 3] =
                    std::array::from_fn(|axis| lanes(&points.normal[axis], start));
                let ratios = lanes(&points.grooves, start);
                let lit = lanes_mut(lit, start);
                for lane in 0..LANES {
                    let cosine = normal[0][lane] * to_lamp[0][lane]
                        + normal[1][lane] * to_lamp[1][lane]
                        + normal[2][lane] * to_lamp[2][lane];
                    lit[lane] *= ground(ratios[lane], cosine);
                }
            }
        },
    );
}

/// Share of a groove's ground that is lit; `cosine`: of the angle between lamp and normal.
#[inline(always)]
fn ground(ratio: f32, cosine: f32) -> f32 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let shaded = ratio * FRAC_2_PI * sine / cosine.max(1e-3);
    (1.0 - shaded).max(0.0)
}

/// Share of an evenly bright sky that the ground of a long groove sees: `sqrt(1 + r^2) - r` (Hottel's
/// crossed strings).
pub(crate) fn open_sky(ratio: f32) -> f32 {
    (1.0 + ratio * ratio).sqrt() - ratio
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Points on the ground of grooves in all directions, each tested for a wall that hides the lamp.
    #[test]
    fn walls_shade_what_rays_find() {
        for (ratio, polar) in [(0.3f64, 40.0f64), (0.5, 60.0), (0.9, 20.0), (0.1, 80.0)] {
            let tangent = polar.to_radians().tan();
            let (steps, turns) = (400, 400);
            let mut lit = 0;
            for turn in 0..turns {
                let across =
                    tangent * (2.0 * PI * (f64::from(turn) + 0.5) / f64::from(turns)).cos();
                for step in 0..steps {
                    // Where the ray leaves the groove at the height of its rim.
                    let at = (f64::from(step) + 0.5) / f64::from(steps) + ratio * across;
                    lit += i32::from((0.0..=1.0).contains(&at));
                }
            }
            let expected = f64::from(lit) / f64::from(steps * turns);
            let found = ground(ratio as f32, polar.to_radians().cos() as f32);
            assert!(
                (f64::from(found) - expected).abs() < 2e-3,
                "{found}, {expected}"
            );
        }
    }

    /// Light from the opening of a groove, summed over strips of it, to points of the ground.
    #[test]
    fn the_sky_over_a_groove_is_that_of_its_strips() {
        for ratio in [0.0f64, 0.2, 0.7, 1.5] {
            let steps = 600;
            let at = |step: i32| (f64::from(step) + 0.5) / f64::from(steps);
            let mut sum = 0.0;
            for ground in 0..steps {
                for strip in 0..steps {
                    let (x, d) = (at(strip) - at(ground), ratio.max(1e-9));
                    // View factor of a long strip: half the change of the sine of its angle.
                    let half = 0.5 / f64::from(steps);
                    let sine = |x: f64| x / (x * x + d * d).sqrt();
                    sum += 0.5 * (sine(x + half) - sine(x - half)) / f64::from(steps);
                }
            }
            let found = f64::from(open_sky(ratio as f32));
            assert!((found - sum).abs() < 5e-3, "{ratio}: {found}, {sum}");
        }
    }
}
