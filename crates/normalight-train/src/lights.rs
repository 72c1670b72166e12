//! The lights that come with samples of the normal network: true, perturbed or predicted.
use crate::NormalSettings;
use glam::{Quat, Vec3};
use normalight_core::Light;
use normalight_synth::scrambled;

/// Makes the choice between kinds of lights independent of the disturbances of the same seed.
const CHOICE: u64 = 0x6d69_7864;

/// The lights of a training sample in the recipe's mix; intensities relative to their mean.
///
/// `predicted`: what a light network says, needed where the mix has such lights.
pub(crate) fn mixed(
    settings: &NormalSettings,
    lights: &[Light],
    predicted: Option<&[Light]>,
    seed: u64,
) -> Vec<Light> {
    let mix = &settings.lights;
    let choice = unit(scrambled(seed ^ CHOICE));
    if choice < mix.truth {
        let mean = mean_intensity(lights);
        let relative = |light: &Light| Light::new(light.direction, light.mean_intensity() / mean);
        return lights.iter().map(relative).collect();
    }
    match predicted {
        Some(predicted) if choice >= mix.truth + mix.perturbed => predicted.to_vec(),
        _ => disturbed(settings, lights, seed),
    }
}

fn mean_intensity(lights: &[Light]) -> f32 {
    lights.iter().map(Light::mean_intensity).sum::<f32>() / lights.len() as f32
}

/// Uniform in [0, 1), 24 bits.
pub(crate) fn unit(number: u64) -> f32 {
    (number >> 40) as f32 / 16_777_216.0
}

/// Lights as a light network would give them: each a little off, all a little off together, and
/// intensities relative to their mean.
pub(crate) fn disturbed(settings: &NormalSettings, lights: &[Light], seed: u64) -> Vec<Light> {
    let mut noise = Noise::new(seed);
    let single = settings.light_noise_degrees.to_radians() * noise.share();
    let common = settings.light_drift_degrees.to_radians() * noise.share();
    let drift = Quat::from_scaled_axis(noise.vector() * common);
    // Stretching one axis imitates the light networks' typical error: angles too small or large.
    let stretch = 1.0 + 0.5 * common * noise.vector();
    let mean = mean_intensity(lights);
    lights
        .iter()
        .map(|light| {
            let turned = drift * (light.direction * stretch);
            let direction = Quat::from_scaled_axis(noise.vector() * single) * turned.normalize();
            let factor = 1.0 + settings.intensity_noise * noise.normal();
            Light::new(direction, light.mean_intensity() / mean * factor.max(0.3))
        })
        .collect()
}

/// What SplitMix64 adds to its state.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// A small reproducible source of disturbances (SplitMix64, Steele et al. 2014).
pub(crate) struct Noise(u64);

impl Noise {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed ^ 0x6c69_6768_7473)
    }

    fn unit(&mut self) -> f32 {
        let number = scrambled(self.0);
        self.0 = self.0.wrapping_add(STEP);
        unit(number)
    }

    /// Strength of this sample's disturbance: from none to twice the recipe's.
    pub(crate) fn share(&mut self) -> f32 {
        2.0 * self.unit()
    }

    /// Mean 0, deviation 1.
    pub(crate) fn normal(&mut self) -> f32 {
        (0..12).map(|_| self.unit()).sum::<f32>() - 6.0
    }

    pub(crate) fn vector(&mut self) -> Vec3 {
        // Deviation 1 over the two axes that move a direction.
        Vec3::new(self.normal(), self.normal(), self.normal()) * std::f32::consts::FRAC_1_SQRT_2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LightMix;

    #[test]
    fn shares_are_as_the_recipe_says() {
        let settings = NormalSettings {
            lights: LightMix {
                truth: 0.2,
                perturbed: 0.5,
                predicted: 0.3,
                light_weights: None,
            },
            ..NormalSettings::default()
        };
        let light = |x: f32, intensity| Light::new(Vec3::new(x, 0.0, 1.0).normalize(), intensity);
        let truth = [light(0.1, 1.0), light(-0.3, 3.0)];
        let predicted = [light(0.7, 1.2), light(0.5, 0.8)];
        let mut counts = [0; 3];
        for seed in 0..10_000 {
            let lights = mixed(&settings, &truth, Some(&predicted), seed);
            let mean = mean_intensity(&lights);
            let kind = if lights == predicted {
                2
            } else if lights[0].direction == truth[0].direction {
                assert_eq!((mean, lights[0].mean_intensity()), (1.0, 0.5));
                0
            } else {
                1
            };
            counts[kind] += 1;
        }
        for (count, expected) in counts.into_iter().zip([2000i32, 5000, 3000]) {
            assert!((count - expected).abs() < 200, "{counts:?}");
        }
    }
}
