use crate::{CoreError, ImageStack, Light, Mask, NormalMap, Rect};
use glam::{DMat3, DVec3, Vec3};

/// Grey value of linear RGB (ITU-R BT.601 weights, as DiLiGenT's baseline uses).
pub fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2989 * r + 0.587 * g + 0.114 * b
}

/// The product of a vector with itself as a matrix.
pub(crate) fn outer(vector: DVec3) -> DMat3 {
    DMat3::from_cols(vector * vector.x, vector * vector.y, vector * vector.z)
}

/// Calibrated least squares (Woodham 1980): per pixel the vector `g` that minimises the sum over
/// the images of `(i - l.g)^2`, where `i` is the grey value after division by the light's intensity per
/// channel; its direction is the normal, its length the albedo.
///
/// Returns the normals and the grey albedo (`[height, width]`, zero outside the mask).
///
/// # Errors
/// [`CoreError::LightCount`] or the errors of [`ImageStack::check_mask`].
pub fn least_squares_normals(
    stack: &ImageStack,
    mask: &Mask,
    lights: &[Light],
) -> Result<(NormalMap, Vec<f32>), CoreError> {
    stack.check_mask(mask, "mask")?;
    if lights.len() != stack.len() {
        return Err(CoreError::LightCount {
            found: lights.len(),
            expected: stack.len(),
        });
    }
    let (width, height) = (stack.width(), stack.height());
    let rect = Rect::whole(width, height);
    let area = rect.area();
    let mut gram = DMat3::ZERO;
    let mut projected = vec![DVec3::ZERO; area];
    let mut tile = vec![0.0; 3 * area];
    for (image, light) in lights.iter().enumerate() {
        stack.linear_tile(image, rect, &mut tile);
        let direction = light.direction.as_dvec3();
        gram += outer(direction);
        let [r, g, b] = light.intensity.map(|value| value.max(f32::MIN_POSITIVE));
        for (pixel, sum) in projected.iter_mut().enumerate() {
            let grey = luminance([
                tile[pixel] / r,
                tile[area + pixel] / g,
                tile[2 * area + pixel] / b,
            ]);
            *sum += direction * f64::from(grey);
        }
    }
    // Coplanar lights leave the matrix singular: a touch of ridge keeps the answer finite.
    let ridge = 1e-9 * stack.len() as f64;
    let inverse = (gram + DMat3::from_diagonal(DVec3::splat(ridge))).inverse();
    let scaled: Vec<Vec3> = projected
        .iter()
        .zip(mask.inside())
        .map(|(&sum, &inside)| {
            if inside {
                (inverse * sum).as_vec3()
            } else {
                Vec3::ZERO
            }
        })
        .collect();
    let albedo = scaled.iter().map(|vector| vector.length()).collect();
    Ok((NormalMap::new(width, height, scaled), albedo))
}

/// Determinants of [`mean_outer`] of directions that span nearly no space, too little for what is doubtful anyway, and none.
pub(crate) const NEARLY_FLAT: f64 = 1e-5;
pub(crate) const FLAT: f64 = 1e-7;

/// Mean outer product of directions: its determinant says how far they span space. Of lights all over the half in front of an
/// object it is 0.03 and more, of lights all over a cone of ten degrees 6e-5, of lights in a plane 0.
pub(crate) fn mean_outer(directions: &[Vec3]) -> DMat3 {
    let products = directions.iter().map(|l| outer(l.as_dvec3()));
    products.fold(DMat3::ZERO, |sum, one| sum + one) * (1.0 / directions.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Samples, StackImage, Transfer, direction_from_angles, normal_error};
    use proptest::prelude::*;

    /// Normals of a sphere that fills the frame, tilted so far only that no light leaves a shadow.
    fn shallow_dome(side: usize) -> NormalMap {
        let normals = (0..side * side)
            .map(|index| {
                let x = (index % side) as f32 / side as f32 - 0.5;
                let y = 0.5 - (index / side) as f32 / side as f32;
                Vec3::new(x, y, (1.0 - x * x - y * y).sqrt())
            })
            .collect();
        NormalMap::new(side, side, normals)
    }

    proptest! {
        #[test]
        fn exact_on_lambert_without_shadow(
            albedo in 0.1f32..1.0,
            lights in proptest::collection::vec((-0.5f32..0.5, -0.5f32..0.5, 0.5f32..2.0), 5..12),
        ) {
            let truth = shallow_dome(9);
            let mut known: Vec<Light> = lights
                .iter()
                .map(|&(a, e, i)| Light::new(direction_from_angles(a, e), i))
                .collect();
            // Three fixed ones keep the set from being coplanar.
            known.extend([(0.5, 0.0), (-0.4, 0.4), (0.0, -0.5)].map(|(a, e)| {
                Light::new(direction_from_angles(a, e), 1.0)
            }));
            let images = known.iter().map(|light| StackImage {
                name: "lambert".into(),
                width: 9,
                height: 9,
                channels: 1,
                samples: Samples::F32(truth.normals().iter().map(|normal| {
                    albedo * light.mean_intensity() * normal.dot(light.direction).max(0.0)
                }).collect()),
                transfer: Transfer::Linear,
            }).collect();
            let stack = ImageStack::new(images).unwrap();
            let mask = Mask::whole(9, 9);
            let (normals, found) = least_squares_normals(&stack, &mask, &known).unwrap();
            let error = normal_error(&normals, &truth, &mask).unwrap();
            prop_assert!(error.mean.to_degrees() < 0.01, "{}", error.mean.to_degrees());
            // The grey weights sum to 0.9999.
            prop_assert!(found.iter().all(|value| (value / albedo - 0.9999).abs() < 1e-3));
        }
    }
}
