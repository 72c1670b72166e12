//! What guides the light network at a second look, in its training samples.
use crate::lights::{Noise, unit};
use crate::{GuidanceMix, LightSettings};
use glam::{Mat3, Quat, Vec3};
use normalight_core::Light;
use normalight_model::Guidance;
use normalight_synth::{Sample, scrambled};

/// Makes the choice of guidance independent of its disturbances.
const CHOICE: u64 = 0x6775_6964;

/// Where the guidance of a sample comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GuidedBy {
    /// Nothing is known: the first look.
    Nothing,
    /// What frozen networks say about the sample.
    Networks,
    /// The truth, distorted as a wrong estimate would be.
    Truth,
}

impl GuidedBy {
    /// The choice for the sample of a seed, in the recipe's shares.
    pub(crate) fn choose(settings: &LightSettings, seed: u64) -> Self {
        let mix = &settings.guidance;
        let choice = unit(scrambled(seed ^ CHOICE));
        if !settings.architecture.guided {
            Self::Nothing
        } else if choice < mix.predicted {
            Self::Networks
        } else if choice < mix.predicted + mix.perturbed {
            Self::Truth
        } else {
            Self::Nothing
        }
    }
}

/// Lights and normals that are wrong together: to first order normals and lights in one wrong basis
/// explain matt photographs as well as the right ones, n . l = (A^-T n) . (A l) (Belhumeur et al. 1999).
/// Each light is a little wrong by itself, too.
pub(crate) fn distorted(mix: &GuidanceMix, sample: &Sample, seed: u64) -> Guidance {
    let mut noise = Noise::new(seed);
    let common = mix.drift_degrees.to_radians() * noise.share();
    let single = mix.noise_degrees.to_radians() * noise.share();
    let drift = Mat3::from_quat(Quat::from_scaled_axis(noise.vector() * common));
    // Sides and depth stretched, by up to a tenth at the default drift.
    let stretch = (Vec3::ONE + noise.vector() * common).max(Vec3::splat(0.5));
    let basis = drift * Mat3::from_diagonal(stretch);
    let inverse = basis.inverse().transpose();
    let lights: Vec<Light> = sample
        .lights
        .iter()
        .map(|light| {
            let turn = Quat::from_scaled_axis(noise.vector() * single);
            let factor = 1.0 + mix.intensity_noise * noise.normal();
            let intensity = light.mean_intensity() * factor.max(0.3);
            Light::new(turn * (basis * light.direction), intensity)
        })
        .collect();
    let turned = |normal: &Vec3| (inverse * *normal).normalize_or_zero();
    Guidance::new(sample.normals.iter().map(turned).collect(), &lights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_model::LightArchitecture;
    use normalight_synth::{Framing, Preset, Renderer};

    /// Normals and lights in one wrong basis agree about where each light's own shadow begins.
    #[test]
    fn distortions_keep_attached_shadows() {
        let renderer = Renderer::new(Preset::World.recipe()).unwrap();
        let sample = renderer.sample(5, 6, 64, Framing::WholeObject);
        let mix = GuidanceMix {
            noise_degrees: 0.0,
            intensity_noise: 0.0,
            ..GuidanceMix::default()
        };
        let (mut lit, mut dark, mut moved) = (0, 0, 0.0f32);
        for seed in 0..4 {
            let guidance = distorted(&mix, &sample, seed);
            for (pixel, normal) in sample.normals.iter().enumerate() {
                let [x, y, z, _] = guidance.channels(0, pixel);
                moved = moved.max(normal.angle_between(Vec3::new(x, y, z)));
                for (image, light) in sample.lights.iter().enumerate() {
                    let truth = normal.dot(light.direction);
                    let [.., shading] = guidance.channels(image, pixel);
                    if truth > 1e-4 {
                        assert!(shading > 0.0, "{truth} {shading}");
                        lit += 1;
                    } else if truth < -1e-4 {
                        assert_eq!(shading, 0.0, "{truth}");
                        dark += 1;
                    }
                }
            }
        }
        assert!(lit > 10_000 && dark > 100, "{lit} {dark}");
        let moved = moved.to_degrees();
        assert!((2.0..60.0).contains(&moved), "{moved} degrees");
    }

    #[test]
    fn shares_are_as_the_recipe_says() {
        let mut settings = LightSettings {
            guidance: GuidanceMix {
                predicted: 0.5,
                perturbed: 0.2,
                ..GuidanceMix::default()
            },
            ..LightSettings::default()
        };
        let count = |settings: &LightSettings, kind: GuidedBy| {
            let choices = (0..10_000).map(|seed| GuidedBy::choose(settings, seed));
            choices.filter(|&choice| choice == kind).count()
        };
        assert_eq!(count(&settings, GuidedBy::Nothing), 10_000);
        settings.architecture = LightArchitecture {
            guided: true,
            ..LightArchitecture::plain()
        };
        for (kind, expected) in [
            (GuidedBy::Networks, 5000),
            (GuidedBy::Truth, 2000),
            (GuidedBy::Nothing, 3000),
        ] {
            let found = count(&settings, kind);
            assert!(found.abs_diff(expected) < 200, "{kind:?}: {found}");
        }
    }
}
