use crate::{CoreError, Light, Mask, NormalMap, angle_between};
use glam::Vec3;
use std::f32::consts::FRAC_PI_2;

/// How far normals are from the truth, over the pixels of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalError {
    /// Mean angle in radians.
    pub mean: f32,
    /// Median angle in radians; of an even number the mean of the middle two.
    pub median: f32,
    /// Share (0..1) of pixels under 11.25, 22.5 and 30 degrees.
    pub shares: [f32; 3],
    /// Number of pixels compared.
    pub pixels: usize,
}

/// Mean angular error of a normal map over the mask; pixels whose true normal is zero are left out.
///
/// # Errors
/// [`CoreError::MapSize`] when the sizes differ.
pub fn normal_error(
    estimate: &NormalMap,
    truth: &NormalMap,
    mask: &Mask,
) -> Result<NormalError, CoreError> {
    for (width, height) in [
        (estimate.width(), estimate.height()),
        (mask.width(), mask.height()),
    ] {
        if (width, height) != (truth.width(), truth.height()) {
            return Err(CoreError::MapSize {
                found_width: width,
                found_height: height,
                expected_width: truth.width(),
                expected_height: truth.height(),
            });
        }
    }
    let pairs = estimate
        .normals()
        .iter()
        .zip(truth.normals())
        .zip(mask.inside())
        .filter(|&(_, &inside)| inside)
        .map(|((&estimate, &truth), _)| (estimate, truth));
    Ok(normal_error_between(pairs))
}

/// The angle between an estimated and a true normal in radians; an estimate of zero, which says nothing, counts as a right
/// angle. `None` where the truth is zero.
pub fn angle_to_truth(estimate: Vec3, truth: Vec3) -> Option<f32> {
    match (estimate, truth) {
        (_, Vec3::ZERO) => None,
        (Vec3::ZERO, _) => Some(FRAC_PI_2),
        (estimate, truth) => Some(angle_between(estimate, truth)),
    }
}

/// Mean angular error over pairs of (estimate, truth), see [`angle_to_truth`]; pairs whose truth is zero are left out.
pub fn normal_error_between(pairs: impl IntoIterator<Item = (Vec3, Vec3)>) -> NormalError {
    const LIMITS: [f32; 3] = [11.25, 22.5, 30.0];
    let mut sum = 0.0f64;
    let mut under = [0usize; 3];
    let mut angles = Vec::new();
    for (estimate, truth) in pairs {
        let Some(angle) = angle_to_truth(estimate, truth) else {
            continue;
        };
        sum += f64::from(angle);
        angles.push(angle);
        for (count, limit) in under.iter_mut().zip(LIMITS) {
            *count += usize::from(angle.to_degrees() < limit);
        }
    }
    let pixels = angles.len();
    let total = pixels.max(1) as f32;
    NormalError {
        mean: (sum / f64::from(total)) as f32,
        median: median(&mut angles),
        shares: under.map(|count| count as f32 / total),
        pixels,
    }
}

/// The middle one, or the mean of the middle two; 0 of none.
fn median(values: &mut [f32]) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f32::total_cmp);
    match below.iter().copied().max_by(f32::total_cmp) {
        Some(lower) if even => (lower + upper) / 2.0,
        _ => upper,
    }
}

/// Mean angle in radians between estimated and true light directions.
///
/// # Errors
/// [`CoreError::LightCount`] when the numbers differ.
pub fn mean_light_error(estimate: &[Light], truth: &[Light]) -> Result<f32, CoreError> {
    check_counts(estimate, truth)?;
    let sum: f32 = estimate
        .iter()
        .zip(truth)
        .map(|(estimate, truth)| angle_between(estimate.direction, truth.direction))
        .sum();
    Ok(sum / truth.len().max(1) as f32)
}

/// Scale-invariant relative intensity error (Chen et al. 2019): true intensities are divided by
/// the first image's, per channel; one least-squares scale; mean of `|s p - g| / g`.
///
/// # Errors
/// [`CoreError::LightCount`] when the numbers differ.
pub fn intensity_error(estimate: &[Light], truth: &[Light]) -> Result<f32, CoreError> {
    check_counts(estimate, truth)?;
    let Some(first) = truth.first() else {
        return Ok(0.0);
    };
    let mut pairs = Vec::with_capacity(3 * truth.len());
    for (estimate, truth) in estimate.iter().zip(truth) {
        for channel in 0..3 {
            let relative = truth.intensity[channel] / first.intensity[channel];
            pairs.push((estimate.intensity[channel], relative));
        }
    }
    let dot: f32 = pairs.iter().map(|(p, g)| p * g).sum();
    let square: f32 = pairs.iter().map(|(p, _)| p * p).sum();
    let scale = dot / square.max(f32::MIN_POSITIVE);
    let sum: f32 = pairs.iter().map(|(p, g)| (scale * p - g).abs() / g).sum();
    Ok(sum / pairs.len() as f32)
}

fn check_counts(estimate: &[Light], truth: &[Light]) -> Result<(), CoreError> {
    if estimate.len() == truth.len() {
        return Ok(());
    }
    Err(CoreError::LightCount {
        found: estimate.len(),
        expected: truth.len(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn turning_all_normals_by_one_angle_gives_that_error(degrees in 0.1f32..60.0) {
            let pairs = (0..50).map(|k| {
                let truth = Vec3::new(k as f32 * 0.01, 0.0, 1.0).normalize();
                (glam::Quat::from_rotation_y(degrees.to_radians()) * truth, truth)
            });
            let error = normal_error_between(pairs);
            prop_assert!((error.mean.to_degrees() - degrees).abs() < 1e-3);
            prop_assert_eq!(error.shares[1], if degrees < 22.5 { 1.0 } else { 0.0 });
        }

        #[test]
        fn intensity_error_ignores_scale(scale in 0.01f32..100.0) {
            let truth: Vec<_> = (1..9).map(|k| Light::new(Vec3::Z, k as f32)).collect();
            let scaled: Vec<_> = (1..9).map(|k| Light::new(Vec3::Z, k as f32 * scale)).collect();
            prop_assert!(intensity_error(&scaled, &truth).unwrap() < 1e-5);
        }
    }

    #[test]
    fn intensity_error_by_hand() {
        let truth = [Light::new(Vec3::Z, 2.0), Light::new(Vec3::Z, 4.0)];
        let flat = [Light::new(Vec3::Z, 1.0), Light::new(Vec3::Z, 1.0)];
        // Relative truth (1, 2); best scale 1.5; errors 0.5 / 1 and 0.5 / 2.
        assert!((intensity_error(&flat, &truth).unwrap() - 0.375).abs() < 1e-6);
        assert!(intensity_error(&flat[..1], &truth).is_err());
    }

    #[test]
    fn zero_truth_is_left_out() {
        let error = normal_error_between([(Vec3::Z, Vec3::ZERO), (Vec3::X, Vec3::Z)]);
        assert_eq!(error.pixels, 1);
        assert!((error.mean.to_degrees() - 90.0).abs() < 1e-4);
    }

    #[test]
    fn a_network_that_says_nothing_is_not_a_good_one() {
        let error = normal_error_between([(Vec3::ZERO, Vec3::Z), (Vec3::Z, Vec3::Z)]);
        assert!((error.mean.to_degrees() - 45.0).abs() < 1e-4);
        assert_eq!(error.shares, [0.5; 3]);
    }
}
