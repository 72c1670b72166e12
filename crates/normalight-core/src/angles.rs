use glam::Vec3;

/// Unit direction of a light with the given azimuth and elevation, in radians.
///
/// `(sin az cos el, sin el, cos az cos el)`, the convention of the light classes.
pub fn direction_from_angles(azimuth: f32, elevation: f32) -> Vec3 {
    let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
    let (sin_elevation, cos_elevation) = elevation.sin_cos();
    Vec3::new(
        sin_azimuth * cos_elevation,
        sin_elevation,
        cos_azimuth * cos_elevation,
    )
}

/// Azimuth and elevation in radians of a direction; the inverse of [`direction_from_angles`].
///
/// Both lie in (-pi/2, pi/2) for directions towards the camera's side (z > 0).
pub fn direction_to_angles(direction: Vec3) -> (f32, f32) {
    let unit = direction.normalize_or(Vec3::Z);
    (unit.x.atan2(unit.z), unit.y.clamp(-1.0, 1.0).asin())
}

/// Angle between two directions in radians, 0..pi; lengths do not matter.
///
/// Computed by atan2, which stays exact for tiny angles where the arc cosine does not.
pub fn angle_between(a: Vec3, b: Vec3) -> f32 {
    a.cross(b).length().atan2(a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f32::consts::FRAC_PI_2;

    proptest! {
        #[test]
        fn angles_round_trip(azimuth in -1.55f32..1.55, elevation in -1.55f32..1.55) {
            let direction = direction_from_angles(azimuth, elevation);
            prop_assert!((direction.length() - 1.0).abs() < 1e-5);
            let (azimuth_again, elevation_again) = direction_to_angles(direction);
            // Near the poles the azimuth is ill-conditioned: compare on the sphere.
            prop_assert!((elevation - elevation_again).abs() < 2e-3);
            prop_assert!((azimuth - azimuth_again).abs() * elevation.cos() < 1e-4);
        }

        #[test]
        fn angle_matches_rotation(angle in 1e-4f32..3.1, azimuth in -3.0f32..3.0) {
            let axis = Vec3::new(azimuth.sin(), 0.3, azimuth.cos()).normalize();
            let start = axis.any_orthonormal_vector();
            let turned = glam::Quat::from_axis_angle(axis, angle) * start;
            prop_assert!((angle_between(start, turned * 7.0) - angle).abs() < 1e-5);
        }
    }

    #[test]
    fn axes() {
        assert!((direction_from_angles(0.0, 0.0) - Vec3::Z).length() < 1e-6);
        assert!((direction_from_angles(FRAC_PI_2, 0.0) - Vec3::X).length() < 1e-6);
        assert!((direction_from_angles(0.0, FRAC_PI_2) - Vec3::Y).length() < 1e-6);
    }
}
