use crate::albedo::{ALBEDO_QUANTILE, MIN_SHADING, albedo_of, check, thinned};
use crate::{CoreError, ImageStack, Light, Mask, NormalMap, luminance};
use glam::{DMat3, DVec3, Vec3};

/// How lights are refitted to normals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefitSettings {
    /// Quantile of intensity / shading over the images that counts as albedo; below the median,
    /// because highlights only ever add light.
    pub albedo_quantile: f32,
    /// How far each light moves to its refitted value, 0..1.
    pub step: f32,
    /// Most pixels used; more are thinned out evenly.
    pub max_pixels: usize,
    /// Rounds of reweighting.
    pub rounds: usize,
}

impl Default for RefitSettings {
    fn default() -> Self {
        Self {
            albedo_quantile: ALBEDO_QUANTILE,
            step: 0.25,
            max_pixels: 32_768,
            rounds: 8,
        }
    }
}

/// Refits every light to the stack, given normals: per pixel an albedo that is robust to shadows
/// and highlights; then per image the vector `e l` that best explains `albedo * n.(e l)` in the
/// sense of Cauchy's robust loss, by reweighted least squares. Each light moves part of the way.
///
/// Intensities come back relative to their mean, grey.
///
/// # Errors
/// [`CoreError::LightCount`] or [`CoreError::MapSize`].
pub fn refit_lights(
    stack: &ImageStack,
    mask: &Mask,
    normals: &NormalMap,
    lights: &[Light],
    settings: RefitSettings,
) -> Result<Vec<Light>, CoreError> {
    check(stack, mask, normals, lights)?;
    let pixels = thinned(mask, settings.max_pixels);
    let albedo: Vec<f32> = albedo_of(stack, normals, lights, &pixels, settings.albedo_quantile)
        .into_iter()
        .map(luminance)
        .collect();
    let mut refitted = Vec::with_capacity(lights.len());
    let mut values = vec![[0.0; 3]; pixels.len()];
    for (image, &light) in lights.iter().enumerate() {
        stack.linear_pixels(image, &pixels, &mut values);
        let equations: Vec<(DVec3, f64)> = pixels
            .iter()
            .zip(&values)
            .zip(&albedo)
            .filter_map(|((&pixel, &value), &albedo)| {
                let normal = normals.normals()[pixel];
                let grey = luminance(value);
                let lit = normal.dot(light.direction) > MIN_SHADING && grey > 0.0 && albedo > 0.0;
                lit.then(|| ((normal * albedo).as_dvec3(), f64::from(grey)))
            })
            .collect();
        let start = (light.direction * light.mean_intensity()).as_dvec3();
        let target = robust_fit(&equations, start, settings.rounds).as_vec3();
        refitted.push(moved(light, target, settings.step));
    }
    let mean = refitted.iter().map(Light::mean_intensity).sum::<f32>() / refitted.len() as f32;
    if mean > 0.0 && mean.is_finite() {
        for light in &mut refitted {
            light.intensity = light.intensity.map(|value| value / mean);
        }
    }
    Ok(refitted)
}

/// The vector `v` that minimises the sum of `log(1 + (r / s)^2)` over `r = value - row.v`, with `s`
/// from the median absolute residual; the start where the equations do not determine it.
fn robust_fit(equations: &[(DVec3, f64)], start: DVec3, rounds: usize) -> DVec3 {
    // A handful of pixels says nothing about a light.
    if equations.len() < 12 {
        return start;
    }
    let mut vector = start;
    let mut residuals = vec![0.0; equations.len()];
    for _ in 0..rounds {
        for (residual, (row, value)) in residuals.iter_mut().zip(equations) {
            *residual = (value - row.dot(vector)).abs();
        }
        let middle = residuals.len() / 2;
        let mut sorted = residuals.clone();
        let median = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
        // 2.385 gives the Cauchy loss 95 % efficiency under Gaussian noise; 1.4826 turns the
        // median into a standard deviation.
        let scale = (2.385 * 1.4826 * median).max(1e-9);
        let mut gram = DMat3::ZERO;
        let mut projected = DVec3::ZERO;
        for ((row, value), residual) in equations.iter().zip(&residuals) {
            let weight = 1.0 / (1.0 + (residual / scale).powi(2));
            let weighted = *row * weight;
            gram += DMat3::from_cols(weighted * row.x, weighted * row.y, weighted * row.z);
            projected += weighted * *value;
        }
        // Flat objects show a light in few directions only: hold the others at the start.
        let ridge = 1e-3 * (gram.x_axis.x + gram.y_axis.y + gram.z_axis.z) / 3.0;
        gram += DMat3::from_diagonal(DVec3::splat(ridge));
        projected += start * ridge;
        let next = gram.inverse() * projected;
        if !next.is_finite() {
            return start;
        }
        vector = next;
    }
    vector
}

/// The light moved by `step` of the way to the vector `intensity * direction`.
fn moved(light: Light, target: Vec3, step: f32) -> Light {
    let length = target.length();
    // A light behind the object cannot have lit it.
    if !length.is_finite() || length <= 0.0 || target.z <= 0.0 {
        return light;
    }
    let direction = light.direction.lerp(target / length, step);
    let intensity = light.mean_intensity() + (length - light.mean_intensity()) * step;
    Light {
        confidence: light.confidence,
        ..Light::new(direction, intensity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::albedo::{albedo_map, quantile_of};
    use crate::{
        Samples, StackImage, Transfer, direction_from_angles, intensity_error, mean_light_error,
    };

    /// A Lambertian hemisphere under known lights, with a highlight-like outlier in some pixels.
    fn hemisphere(lights: &[Light]) -> (ImageStack, Mask, NormalMap) {
        let side = 48;
        let normals: Vec<Vec3> = (0..side * side)
            .map(|index| {
                let x = (index % side) as f32 / 23.5 - 1.0;
                let y = 1.0 - (index / side) as f32 / 23.5;
                let square = 1.0 - x * x - y * y;
                if square > 0.0 {
                    Vec3::new(x, y, square.sqrt())
                } else {
                    Vec3::ZERO
                }
            })
            .collect();
        let images = lights
            .iter()
            .map(|light| {
                let samples = normals
                    .iter()
                    .enumerate()
                    .map(|(index, normal)| {
                        let shading = normal.dot(light.direction).max(0.0);
                        let outlier = if index % 17 == 0 { 0.3 } else { 0.0 };
                        light.mean_intensity() * (0.4 * shading + outlier * shading.powi(20))
                    })
                    .collect();
                StackImage {
                    name: "hemisphere".into(),
                    width: side,
                    height: side,
                    channels: 1,
                    samples: Samples::F32(samples),
                    transfer: Transfer::Linear,
                }
            })
            .collect();
        let inside = normals.iter().map(|normal| *normal != Vec3::ZERO).collect();
        (
            ImageStack::new(images).unwrap(),
            Mask::new(side, side, inside),
            NormalMap::new(side, side, normals),
        )
    }

    fn ring_of_lights() -> Vec<Light> {
        (0..12)
            .map(|k| {
                let turn = k as f32 * 0.5;
                let direction = direction_from_angles(0.6 * turn.cos(), 0.6 * turn.sin());
                Light::new(direction, 0.7 + 0.05 * k as f32)
            })
            .collect()
    }

    #[test]
    fn true_lights_stay() {
        let truth = ring_of_lights();
        let (stack, mask, normals) = hemisphere(&truth);
        let settings = RefitSettings::default();
        let lights = refit_lights(&stack, &mask, &normals, &truth, settings).unwrap();
        assert!(mean_light_error(&lights, &truth).unwrap().to_degrees() < 0.2);
        assert!(intensity_error(&lights, &truth).unwrap() < 0.005);
        let albedo = albedo_map(&stack, &mask, &normals, &truth).unwrap();
        assert!((albedo[24 * 48 + 24] - 0.4).abs() < 1e-3);
        assert_eq!(albedo[0], 0.0);
    }

    #[test]
    fn wrong_lights_come_closer() {
        let truth = ring_of_lights();
        let (stack, mask, normals) = hemisphere(&truth);
        let wrong: Vec<Light> = truth
            .iter()
            .enumerate()
            .map(|(k, light)| {
                let drift = 0.12 * Vec3::new((k as f32).sin(), (k as f32 * 1.7).cos(), 0.0);
                Light::new(light.direction + drift, 1.0)
            })
            .collect();
        let settings = RefitSettings {
            step: 0.5,
            ..RefitSettings::default()
        };
        let lights = refit_lights(&stack, &mask, &normals, &wrong, settings).unwrap();
        let before = mean_light_error(&wrong, &truth).unwrap();
        let after = mean_light_error(&lights, &truth).unwrap();
        assert!(after < 0.75 * before, "{before} -> {after}");
        let before = intensity_error(&wrong, &truth).unwrap();
        let after = intensity_error(&lights, &truth).unwrap();
        assert!(after < 0.75 * before, "{before} -> {after}");
    }

    #[test]
    fn lights_that_nothing_shows_stay() {
        let light = Light::new(Vec3::Z, 1.0);
        assert_eq!(robust_fit(&[], Vec3::Z.as_dvec3(), 3), DVec3::Z);
        assert_eq!(moved(light, Vec3::NAN, 0.5), light);
        assert_eq!(moved(light, -Vec3::Z, 0.5), light);
        assert_eq!(quantile_of(&mut [], 0.4), 0.0);
    }
}
