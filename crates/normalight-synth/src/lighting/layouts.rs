use crate::random::Random;
use crate::recipe::LightRecipe;
use glam::Vec3;
use std::f32::consts::TAU;

/// Directions of the lamps of one scene, in one of the ways people place them.
pub(crate) fn directions(recipe: &LightRecipe, random: &mut Random, count: usize) -> Vec<Vec3> {
    let weights = [
        recipe.rectangle,
        recipe.cap,
        recipe.ring,
        recipe.dome,
        recipe.path,
    ];
    match random.weighted(&weights) {
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
        2 => {
            let [low, high] = recipe.ring_degrees;
            let radius = random.range(low, high);
            ring(random, count, radius)
        }
        3 => dome(recipe, random, count),
        _ => path(recipe, random, count),
    }
}

/// Evenly spaced but for a hand's precision; `polar` in degrees.
fn ring(random: &mut Random, count: usize, polar: f32) -> Vec<Vec3> {
    let start = random.unit();
    (0..count)
        .map(|index| {
            let polar = (polar + random.signed(4.0)).clamp(1.0, 85.0);
            let place = (index as f32 + random.signed(0.2)) / count as f32 + start;
            around_axis(libm::cosf(polar.to_radians()), place * TAU)
        })
        .collect()
}

/// Rings at two to four heights that share the lamps by their length, as fixed rigs have them.
fn dome(recipe: &LightRecipe, random: &mut Random, count: usize) -> Vec<Vec3> {
    let edge = random.range(recipe.cap_degrees[0], recipe.cap_degrees[1]);
    let rings = random.count(2, 4);
    let polar = |ring: usize| edge * (ring as f32 + 0.7) / rings as f32;
    let length = |ring: usize| libm::sinf(polar(ring).to_radians());
    let total: f32 = (0..rings).map(length).sum();
    let mut lamps = Vec::new();
    let mut share = 0.0;
    for number in 0..rings {
        share += length(number) / total;
        let upto = ((count as f32 * share + 0.5) as usize).min(count);
        let upto = if number + 1 == rings { count } else { upto };
        let part = upto - lamps.len().min(upto);
        if part > 0 {
            lamps.extend(ring(random, part, polar(number)));
        }
    }
    lamps
}

/// A hand that moves a lamp around the object and stops now and then: the polar angle swings while the
/// azimuth goes round, not always all the way.
fn path(recipe: &LightRecipe, random: &mut Random, count: usize) -> Vec<Vec3> {
    let edge = random.range(recipe.cap_degrees[0], recipe.cap_degrees[1]);
    let middle = edge * random.range(0.4, 0.8);
    let swing = (edge - middle) * random.unit();
    let (rounds, swings) = (random.range(0.6, 2.5), random.range(0.5, 4.0));
    let (start, phase) = (random.unit(), random.unit());
    (0..count)
        .map(|index| {
            let along = (index as f32 + random.signed(0.3)) / count as f32;
            let polar = middle + swing * libm::sinf((along * swings + phase) * TAU);
            let polar = (polar + random.signed(3.0)).clamp(1.0, 85.0);
            let azimuth = along * rounds + start;
            around_axis(libm::cosf(polar.to_radians()), azimuth * TAU)
        })
        .collect()
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

    fn only(layout: usize) -> LightRecipe {
        let weight = |k: usize| if k == layout { 1.0 } else { 0.0 };
        LightRecipe {
            rectangle: weight(0),
            cap: weight(1),
            ring: weight(2),
            dome: weight(3),
            path: weight(4),
            ..LightRecipe::default()
        }
    }

    #[test]
    fn rectangle_keeps_to_its_angles() {
        let mut random = Random::new(1, Stream::Lights);
        for direction in directions(&only(0), &mut random, 500) {
            let (azimuth, elevation) = normalight_core::direction_to_angles(direction);
            assert!(azimuth.to_degrees().abs() < 45.01);
            assert!(elevation.to_degrees().abs() < 45.01);
        }
    }

    #[test]
    fn every_layout_gives_as_many_lamps_as_asked_for_within_its_cap() {
        for layout in 1..5 {
            for seed in 0..100 {
                let mut random = Random::new(seed, Stream::Lights);
                let count = 1 + seed as usize % 40;
                let directions = directions(&only(layout), &mut random, count);
                assert_eq!(directions.len(), count, "layout {layout}");
                for direction in directions {
                    assert!((direction.length() - 1.0).abs() < 1e-4);
                    let polar = direction.z.clamp(-1.0, 1.0).acos().to_degrees();
                    assert!(polar < 85.1, "layout {layout}: {polar} degrees");
                }
            }
        }
    }
}
