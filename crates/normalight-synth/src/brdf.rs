use glam::Vec3;
use std::f32::consts::PI;

/// What one point of the surface is made of. Colours are linear RGB.
///
/// Light is measured so that white matte paper facing a lamp of intensity 1 has the value 1: the
/// reflectance function times pi times the cosine.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Surface {
    /// Share of light scattered diffusely.
    pub(crate) albedo: Vec3,
    /// Oren-Nayar roughness: deviation of the facets' slope in radians, squared.
    pub(crate) facet_variance: f32,
    /// Mirror reflectance at normal incidence.
    pub(crate) f0: Vec3,
    /// GGX widths (alpha) of a narrow and a wide highlight.
    pub(crate) alphas: [f32; 2],
    /// Their weights.
    pub(crate) weights: [f32; 2],
    /// Velvet-like rim.
    pub(crate) sheen: f32,
}

impl Surface {
    /// Everything in between: `share` of `other`, the rest of `self`.
    pub(crate) fn mixed(&self, other: &Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * share;
        Self {
            albedo: self.albedo.lerp(other.albedo, share),
            facet_variance: mix(self.facet_variance, other.facet_variance),
            f0: self.f0.lerp(other.f0, share),
            alphas: [
                mix(self.alphas[0], other.alphas[0]),
                mix(self.alphas[1], other.alphas[1]),
            ],
            weights: [
                mix(self.weights[0], other.weights[0]),
                mix(self.weights[1], other.weights[1]),
            ],
            sheen: mix(self.sheen, other.sheen),
        }
    }
}

/// A distant lamp as seen from an orthographic camera on the z axis: the halfway vector and the
/// Fresnel factor are the same for all pixels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lamp {
    pub(crate) direction: Vec3,
    halfway: Vec3,
    /// (1 - v.h)^5 of Schlick's approximation (1994).
    fresnel: f32,
}

impl Lamp {
    pub(crate) fn new(direction: Vec3) -> Self {
        let halfway = (direction + Vec3::Z).normalize_or(Vec3::Z);
        let away = 1.0 - halfway.z;
        let square = away * away;
        Self {
            direction,
            halfway,
            fresnel: square * square * away,
        }
    }

    /// Light sent to the camera, zero when the surface faces away from the lamp.
    #[inline]
    pub(crate) fn shade(&self, surface: &Surface, normal: Vec3) -> Vec3 {
        let to_lamp = normal.dot(self.direction);
        let to_eye = normal.z;
        if to_lamp <= 0.0 || to_eye <= 0.0 {
            return Vec3::ZERO;
        }
        let diffuse =
            oren_nayar(surface.facet_variance, to_lamp, to_eye, self.direction.z) * to_lamp;
        let mut light = surface.albedo * diffuse;
        let to_half = normal.dot(self.halfway);
        let mut highlight = 0.0;
        for (&alpha, &weight) in surface.alphas.iter().zip(&surface.weights) {
            if weight > 0.0 {
                let squared = alpha * alpha;
                highlight += weight
                    * ggx_density(squared, to_half)
                    * ggx_visibility(squared, to_lamp, to_eye);
            }
        }
        let reflectance = surface.f0 + (Vec3::ONE - surface.f0) * self.fresnel;
        light += reflectance * (PI * to_lamp * highlight);
        if surface.sheen > 0.0 {
            let rim = 1.0 - to_eye;
            light += Vec3::splat(surface.sheen * rim * rim * rim * to_lamp);
        }
        light
    }
}

/// Diffuse factor relative to Lambert of the qualitative model of Oren & Nayar (1994).
///
/// `cosine_between`: cosine of the angle between the directions to lamp and eye. Their
/// `cos(phi) sin(alpha) tan(beta)` is `(l.v - n.l n.v) / max(n.l, n.v)`.
#[inline]
fn oren_nayar(variance: f32, to_lamp: f32, to_eye: f32, cosine_between: f32) -> f32 {
    let a = 1.0 - 0.5 * variance / (variance + 0.33);
    let b = 0.45 * variance / (variance + 0.09);
    let azimuth_term = (cosine_between - to_lamp * to_eye).max(0.0) / to_lamp.max(to_eye);
    a + b * azimuth_term
}

/// Density D of GGX facets (Walter et al. 2007, equation 33), from alpha squared and n.h.
#[inline]
fn ggx_density(alpha_squared: f32, to_half: f32) -> f32 {
    let root = to_half * to_half * (alpha_squared - 1.0) + 1.0;
    alpha_squared / (PI * root * root)
}

/// Facets neither shadowed nor hidden, over 4 n.l n.v: the Smith term of Walter et al. 2007 with
/// both effects correlated by height.
#[inline]
fn ggx_visibility(alpha_squared: f32, to_lamp: f32, to_eye: f32) -> f32 {
    let rest = 1.0 - alpha_squared;
    let eye = to_lamp * (alpha_squared + rest * to_eye * to_eye).sqrt();
    let lamp = to_eye * (alpha_squared + rest * to_lamp * to_lamp).sqrt();
    0.5 / (eye + lamp)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integral over the upper hemisphere by the midpoint rule in cosine and azimuth.
    fn hemisphere(integrand: impl Fn(Vec3) -> f64) -> f64 {
        let (rows, columns) = (2000, 200);
        let mut sum = 0.0;
        for row in 0..rows {
            // Squared spacing puts more places near the pole, where narrow highlights lie.
            let t = (row as f64 + 0.5) / rows as f64;
            let cosine = 1.0 - t * t;
            let weight = 2.0 * t / rows as f64;
            let sine = (1.0 - cosine * cosine).sqrt();
            for column in 0..columns {
                let angle = std::f64::consts::TAU * (column as f64 + 0.5) / columns as f64;
                let direction = Vec3::new(
                    (sine * angle.cos()) as f32,
                    (sine * angle.sin()) as f32,
                    cosine as f32,
                );
                sum += weight * integrand(direction) * std::f64::consts::TAU / columns as f64;
            }
        }
        sum
    }

    #[test]
    fn facets_cover_the_surface_once() {
        for alpha in [0.1f32, 0.3, 0.8, 1.0] {
            let area = hemisphere(|h| f64::from(ggx_density(alpha * alpha, h.z)) * f64::from(h.z));
            assert!((area - 1.0).abs() < 5e-3, "alpha {alpha}: {area}");
        }
    }

    #[test]
    fn a_perfect_mirror_surface_reflects_no_more_than_it_gets() {
        let surface = |alpha| Surface {
            f0: Vec3::ONE,
            alphas: [alpha, 1.0],
            weights: [1.0, 0.0],
            ..Surface::default()
        };
        for alpha in [0.1f32, 0.4, 0.8] {
            for tilt in [0.0f32, 0.5, 1.0, 1.4] {
                // The eye is fixed, so the surface tilts; lamps come from all around its normal.
                let normal = Vec3::new(tilt.sin(), 0.0, tilt.cos());
                let side = Vec3::new(tilt.cos(), 0.0, -tilt.sin());
                let surface = surface(alpha);
                let total = hemisphere(|local| {
                    let direction = side * local.x + Vec3::Y * local.y + normal * local.z;
                    f64::from(Lamp::new(direction).shade(&surface, normal).x)
                }) / std::f64::consts::PI;
                assert!(total <= 1.01, "alpha {alpha}, tilt {tilt}: {total}");
                assert!(total > 0.4, "alpha {alpha}, tilt {tilt}: {total}");
            }
        }
    }

    #[test]
    fn matte_surfaces_follow_the_cosine() {
        let surface = Surface {
            albedo: Vec3::new(0.5, 0.25, 1.0),
            ..Surface::default()
        };
        let normal = Vec3::new(0.0, 0.6, 0.8);
        let direction = Vec3::new(0.48, 0.64, 0.6);
        let light = Lamp::new(direction).shade(&surface, normal);
        let cosine = 0.6 * 0.64 + 0.8 * 0.6;
        assert!((light - Vec3::new(0.5, 0.25, 1.0) * cosine).length() < 1e-6);
        assert_eq!(
            Lamp::new(Vec3::new(0.0, -0.9, 0.1).normalize()).shade(&surface, normal),
            Vec3::ZERO
        );
    }

    #[test]
    fn rough_diffuse_is_flatter_and_reflects_back() {
        // Without roughness Lambert; with the lamp behind the eye edges get brighter than Lambert.
        assert_eq!(oren_nayar(0.0, 0.5, 0.5, 1.0), 1.0);
        assert!(oren_nayar(0.3, 0.2, 0.2, 1.0) > oren_nayar(0.3, 1.0, 1.0, 1.0));
    }
}
