use crate::random::{Random, about_x, about_y};
use crate::recipe::LightRecipe;
use glam::{Mat3, Vec3};
use normalight_core::Light;
use std::f32::consts::TAU;

/// Lights lower over the horizon than this z are raised: they would leave the image black.
const MIN_Z: f32 = 0.08;

/// Draws the lights of one scene.
pub(crate) fn lamps(recipe: &LightRecipe, random: &mut Random, count: usize) -> Vec<Light> {
    let directions = directions(recipe, random, count);
    let shift = if random.chance(recipe.shift_share) {
        let size = recipe.shift_degrees.to_radians();
        about_x(random.signed(size)) * about_y(random.signed(size))
    } else {
        Mat3::IDENTITY
    };
    let brightness = random.unit();
    directions
        .into_iter()
        .map(|direction| {
            let mut turned = shift * direction;
            turned.z = turned.z.max(MIN_Z);
            let intensity = if brightness < recipe.equal_share {
                1.0
            } else if brightness < recipe.equal_share + recipe.mild_share {
                random.range(0.7, 1.3)
            } else {
                random.log_range(recipe.intensity[0], recipe.intensity[1])
            };
            Light::new(turned, intensity)
        })
        .collect()
}

fn directions(recipe: &LightRecipe, random: &mut Random, count: usize) -> Vec<Vec3> {
    match random.weighted(&[recipe.rectangle, recipe.cap, recipe.ring]) {
        0 => {
            let half = recipe.rectangle_degrees.to_radians();
            (0..count)
                .map(|_| from_angles(random.signed(half), random.signed(half)))
                .collect()
        }
        1 => {
            let [low, high] = recipe.cap_degrees;
            let edge = libm::cosf(random.range(low, high).to_radians());
            (0..count)
                .map(|_| around_axis(random.range(edge, 1.0), random.range(0.0, TAU)))
                .collect()
        }
        _ => {
            let [low, high] = recipe.ring_degrees;
            let radius = random.range(low, high);
            let start = random.unit();
            (0..count)
                .map(|index| {
                    let polar = (radius + random.signed(4.0)).clamp(1.0, 85.0);
                    let place = (index as f32 + random.signed(0.2)) / count as f32 + start;
                    around_axis(libm::cosf(polar.to_radians()), place * TAU)
                })
                .collect()
        }
    }
}

/// As `normalight_core::direction_from_angles`, with the same bits everywhere.
fn from_angles(azimuth: f32, elevation: f32) -> Vec3 {
    let flat = libm::cosf(elevation);
    Vec3::new(
        libm::sinf(azimuth) * flat,
        libm::sinf(elevation),
        libm::cosf(azimuth) * flat,
    )
}

fn around_axis(cosine: f32, angle: f32) -> Vec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    Vec3::new(sine * libm::cosf(angle), sine * libm::sinf(angle), cosine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;

    #[test]
    fn lights_are_unit_vectors_in_front_of_the_object() {
        for seed in 0..200 {
            let mut random = Random::new(seed, Stream::Lights);
            for light in lamps(&LightRecipe::default(), &mut random, 12) {
                assert!((light.direction.length() - 1.0).abs() < 1e-5);
                assert!(light.direction.z > 0.05);
                assert!(light.intensity[0] >= 0.2 && light.intensity[0] <= 2.0);
            }
        }
    }

    #[test]
    fn rectangle_keeps_to_its_angles() {
        let recipe = LightRecipe {
            cap: 0.0,
            ring: 0.0,
            shift_share: 0.0,
            ..LightRecipe::default()
        };
        let mut random = Random::new(1, Stream::Lights);
        for light in lamps(&recipe, &mut random, 500) {
            let (azimuth, elevation) = normalight_core::direction_to_angles(light.direction);
            assert!(azimuth.to_degrees().abs() < 45.01);
            assert!(elevation.to_degrees().abs() < 45.01);
        }
    }
}
