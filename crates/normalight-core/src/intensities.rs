//! Brightness of lamps whose directions are known.
use crate::woodham::{NEARLY_FLAT, mean_outer};
use crate::{ImageStack, Light, Mask, evenly_spaced_indices, luminance};
use glam::{Mat3, Vec3};

/// Pixels of the object that are looked at.
const PIXELS: usize = 4000;
/// Rounds of normals and brightnesses, and of weights within each.
const ROUNDS: usize = 40;
const WEIGHINGS: usize = 3;
/// Below this share of a pixel's brightest expectation a sample lies in shadow.
const SHADOW: f32 = 0.05;
/// Fewest lights of which the brightness can be told from the shape.
const FEWEST: usize = 5;

/// Brightness of each light relative to the mean of all, from the photographs and the lights' directions: least
/// squares in turns over the pixels' scaled normals and over the lights' brightnesses, in which shadows do not
/// count and highlights count little (weights of Cauchy's distribution).
///
/// On the five objects of DiLiGenT at hand and on rendered scenes the mean error is 1 to 18 % (median 10 %), where
/// equal brightness is wrong by 12 to 100 %.
///
/// `None` for fewer than five lights, lights in a plane, or an object without light.
///
/// # Panics
/// There is not one light for each image: a mistake of the caller.
pub fn intensities_from_directions(
    stack: &ImageStack,
    mask: &Mask,
    lights: &[Light],
) -> Option<Vec<f32>> {
    assert_eq!(lights.len(), stack.len());
    let directions: Vec<Vec3> = lights.iter().map(|light| light.direction).collect();
    if lights.len() < FEWEST || mean_outer(&directions).determinant() < NEARLY_FLAT {
        return None;
    }
    let samples = samples(stack, mask);
    let mut brightness = vec![1.0; lights.len()];
    for _ in 0..ROUNDS {
        let (mut above, mut below) = (vec![0.0f64; lights.len()], vec![0.0f64; lights.len()]);
        for values in &samples {
            let Some((scaled, weights)) = scaled_normal(&directions, values, &brightness) else {
                continue;
            };
            for (k, direction) in directions.iter().enumerate() {
                let expected = direction.dot(scaled).max(0.0);
                above[k] += f64::from(weights[k] * expected * values[k]);
                below[k] += f64::from(weights[k] * expected * expected);
            }
        }
        let next: Vec<f32> = above
            .iter()
            .zip(&below)
            .map(|(above, below)| (above / below) as f32)
            .collect();
        let mean = next.iter().sum::<f32>() / next.len() as f32;
        if !next.iter().all(|value| value.is_finite() && *value > 0.0) {
            return None;
        }
        brightness = next.into_iter().map(|value| value / mean).collect();
    }
    Some(brightness)
}

/// Light of some pixels of the object: for each pixel that of all images.
fn samples(stack: &ImageStack, mask: &Mask) -> Vec<Vec<f32>> {
    let inside = mask.pixels();
    let chosen: Vec<usize> = evenly_spaced_indices(inside.len(), PIXELS)
        .into_iter()
        .map(|place| inside[place])
        .collect();
    let mut samples = vec![Vec::with_capacity(stack.len()); chosen.len()];
    let mut colors = vec![[0.0; 3]; chosen.len()];
    for image in 0..stack.len() {
        stack.linear_pixels(image, &chosen, &mut colors);
        for (values, &color) in samples.iter_mut().zip(&colors) {
            values.push(luminance(color));
        }
    }
    samples
}

/// The normal of a pixel times its albedo, and how much each sample says. `None` for a black pixel.
fn scaled_normal(
    directions: &[Vec3],
    values: &[f32],
    brightness: &[f32],
) -> Option<(Vec3, Vec<f32>)> {
    let even: Vec<f32> = values.iter().zip(brightness).map(|(v, b)| v / b).collect();
    let mut weights = vec![1.0; even.len()];
    let mut scaled = Vec3::ZERO;
    for weighing in 0..=WEIGHINGS {
        let (mut gram, mut sum) = (Mat3::from_diagonal(Vec3::splat(1e-6)), Vec3::ZERO);
        for ((&direction, &value), &weight) in directions.iter().zip(&even).zip(&weights) {
            gram += outer(direction) * weight;
            sum += direction * (weight * value);
        }
        scaled = gram.inverse() * sum;
        if !scaled.is_finite() || scaled == Vec3::ZERO {
            return None;
        }
        if weighing == WEIGHINGS {
            break;
        }
        let expected = directions.iter().map(|direction| direction.dot(scaled));
        let expected: Vec<f32> = expected.collect();
        let brightest = expected.iter().copied().fold(0.0, f32::max);
        let off = |k: usize| (even[k] - expected[k]).abs();
        let mut sorted: Vec<f32> = (0..even.len()).map(off).collect();
        sorted.sort_by(f32::total_cmp);
        let scale = 2.0 * sorted[sorted.len() / 2] + 1e-9;
        for (k, weight) in weights.iter_mut().enumerate() {
            let shadowed = even[k] < SHADOW * brightest || expected[k] < SHADOW * brightest;
            *weight = match shadowed {
                true => 0.0,
                false => 1.0 / (1.0 + (off(k) / scale).powi(2)),
            };
        }
    }
    Some((scaled, weights))
}

fn outer(l: Vec3) -> Mat3 {
    Mat3::from_cols(l * l.x, l * l.y, l * l.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Samples, StackImage, Transfer};

    const SIDE: usize = 40;

    /// A ball that is matte but for a highlight, under lamps of different brightness.
    fn ball(directions: &[Vec3], brightness: &[f32]) -> (ImageStack, Mask) {
        let normal = |pixel: usize| {
            let x = (pixel % SIDE) as f32 - 19.5;
            let y = 19.5 - (pixel / SIDE) as f32;
            let z = 324.0 - x * x - y * y;
            (z > 0.0).then(|| Vec3::new(x, y, z.sqrt()) / 18.0)
        };
        let image = |(&light, &brightness): (&Vec3, &f32)| StackImage {
            name: String::new(),
            width: SIDE,
            height: SIDE,
            channels: 1,
            samples: Samples::F32(
                (0..SIDE * SIDE)
                    .map(|pixel| {
                        let Some(n) = normal(pixel) else { return 0.0 };
                        let half = (light + Vec3::Z).normalize().dot(n).max(0.0);
                        brightness * (0.4 * n.dot(light).max(0.0) + 0.25 * half.powi(60))
                    })
                    .collect(),
            ),
            transfer: Transfer::Linear,
        };
        let images = directions.iter().zip(brightness).map(image).collect();
        let inside = (0..SIDE * SIDE).map(|p| normal(p).is_some()).collect();
        (
            ImageStack::new(images).unwrap(),
            Mask::new(SIDE, SIDE, inside),
        )
    }

    #[test]
    fn brightness_comes_back() {
        let directions: Vec<Vec3> = (0..9)
            .map(|k| {
                let turn = k as f32 * 2.4;
                let tilt = [0.3, 0.7, 1.1][k % 3];
                Vec3::new(turn.cos() * tilt, turn.sin() * tilt, 1.0).normalize()
            })
            .collect();
        let truth: Vec<f32> = (0..9).map(|k| 0.5 + 0.25 * ((k * 4) % 9) as f32).collect();
        let mean = truth.iter().sum::<f32>() / 9.0;
        let (stack, mask) = ball(&directions, &truth);
        let lights: Vec<Light> = directions.iter().map(|&l| Light::new(l, 1.0)).collect();
        let found = intensities_from_directions(&stack, &mask, &lights).unwrap();
        for (found, truth) in found.iter().zip(&truth) {
            assert!((found * mean / truth - 1.0).abs() < 0.05, "{found} {truth}");
        }
        assert_eq!(
            intensities_from_directions(&stack, &mask, &vec![Light::new(Vec3::Z, 1.0); 9]),
            None
        );
    }
}
