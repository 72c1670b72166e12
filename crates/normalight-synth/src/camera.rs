//! From light to the numbers in an image file.
mod jpeg;
mod optics;
mod srgb;
mod visible;

pub(crate) use visible::Visible;

use crate::lanes::vectorised;
use crate::noise::Deviates;
use crate::random::Random;
use crate::recipe::CameraRecipe;
use jpeg::Jpeg;
use optics::{Kernel, blurred};
use srgb::SrgbCodes;

/// Below this mean a scene is not darkened any further to save its highlights.
const DARKEST_MEAN: f32 = 0.02;
/// Longest run of the bank of noise that is used at a time.
const RUN: usize = 2048;
/// Images are out of register by no more than this, in pixels.
const FURTHEST_SHIFT: f32 = 2.0;

/// A camera's exposure, optics, noise and file format.
#[derive(Debug, Clone)]
pub(crate) struct Camera {
    mean: f32,
    clips: bool,
    /// Deviation of the noise in the dark.
    read_noise: f32,
    /// Deviation of the photon noise at full scale; it grows with the square root of the light.
    shot_noise: f32,
    /// Deviation of each image's shift, in pixels.
    shift: f32,
    /// Deviation of the blur, in pixels.
    blur: f32,
    storage: Storage,
}

#[derive(Debug, Clone)]
enum Storage {
    Linear8,
    Srgb8,
    Jpeg(Box<Jpeg>),
    Linear16,
}

impl Camera {
    pub(crate) fn draw(recipe: &CameraRecipe, random: &mut Random) -> Self {
        let [low, high] = recipe.noise;
        // Nothing is drawn from the logarithm of zero.
        let noise = if high > 0.0 {
            random.log_range(low.max(1e-6), high.max(1e-6))
        } else {
            0.0
        };
        let storage = random.unit();
        let quality = random.range(recipe.jpeg_quality[0], recipe.jpeg_quality[1]);
        let [linear, srgb] = [recipe.linear_8_bit_share, recipe.srgb_8_bit_share];
        let within = |random: &mut Random, share: f32, [low, high]: [f32; 2]| {
            if random.chance(share) {
                random.range(low, high)
            } else {
                0.0
            }
        };
        Self {
            mean: random.log_range(recipe.mean[0], recipe.mean[1]),
            clips: random.chance(recipe.clip_share),
            read_noise: noise * random.range(0.02, 0.25),
            shot_noise: noise,
            shift: within(random, recipe.shift_share, recipe.shift_pixels),
            blur: within(random, recipe.blur_share, recipe.blur_pixels),
            storage: if storage < linear {
                Storage::Linear8
            } else if storage < linear + srgb {
                Storage::Srgb8
            } else if storage < linear + srgb + recipe.jpeg_share {
                Storage::Jpeg(Box::new(Jpeg::new(quality)))
            } else {
                Storage::Linear16
            },
        }
    }

    /// Factor from scene light to 0..1, from the object's mean and largest light.
    pub(crate) fn gain(&self, mean: f32, largest: f32) -> f32 {
        let mean = mean.max(1e-6);
        let gain = self.mean / mean;
        if self.clips {
            return gain;
        }
        gain.min((1.0 / largest.max(1e-6)).max(DARKEST_MEAN / mean))
    }

    /// Takes a picture: `light` holds red, green and blue of the visible pixels one after the other and
    /// becomes the decoded values of the file, 0..=1.
    pub(crate) fn take(
        &self,
        light: &mut [f32],
        visible: &Visible,
        gain: f32,
        random: &mut Random,
    ) {
        self.look(light, visible, random);
        self.expose(light, gain, random);
        match &self.storage {
            Storage::Linear8 => round_all(light, 255.0),
            Storage::Linear16 => round_all(light, 65535.0),
            Storage::Srgb8 => {
                let codes = SrgbCodes::shared();
                for value in light {
                    *value = codes.light(codes.nearest(*value));
                }
            }
            Storage::Jpeg(jpeg) => jpeg.store(light, visible),
        }
    }

    fn look(&self, light: &mut [f32], visible: &Visible, random: &mut Random) {
        let offset = |random: &mut Random| {
            (self.shift * random.normal()).clamp(-FURTHEST_SHIFT, FURTHEST_SHIFT)
        };
        let (right, down) = (offset(random), offset(random));
        if self.blur > 0.0 || self.shift > 0.0 {
            let across = Kernel::new(right, self.blur);
            let along = Kernel::new(down, self.blur);
            blurred(light, visible, &across, &along);
        }
    }

    fn expose(&self, light: &mut [f32], gain: f32, random: &mut Random) {
        let deviates = Deviates::shared();
        let read = self.read_noise * self.read_noise;
        let shot = self.shot_noise * self.shot_noise;
        vectorised(
            #[inline(always)]
            || {
                let mut rest = &mut *light;
                // Runs of the bank of noise, each from another place.
                while !rest.is_empty() {
                    let bank = deviates.from(random.below(Deviates::COUNT));
                    let (run, after) = rest.split_at_mut(bank.len().min(rest.len()).min(RUN));
                    for (value, deviate) in run.iter_mut().zip(bank) {
                        let light = *value * gain;
                        let noisy = light + deviate * (read + shot * light).sqrt();
                        let noisy = if noisy > 0.0 { noisy } else { 0.0 };
                        *value = if noisy < 1.0 { noisy } else { 1.0 };
                    }
                    rest = after;
                }
            },
        );
    }
}

fn round_all(values: &mut [f32], steps: f32) {
    vectorised(
        #[inline(always)]
        || {
            for value in values {
                *value = round(*value * steps) / steps;
            }
        },
    );
}

/// To the nearest whole number, for 0..=65535: at this size floats have no room for fractions.
#[inline(always)]
fn round(value: f32) -> f32 {
    const WHOLE: f32 = 8_388_608.0;
    (value + WHOLE) - WHOLE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_hits_the_nearest_step() {
        let mut values = [0.3 / 255.0, 0.6 / 255.0, 1.0, 0.0];
        round_all(&mut values, 255.0);
        assert_eq!(values, [0.0, 1.0 / 255.0, 1.0, 0.0]);
        let mut values = [1.0, 0.5];
        round_all(&mut values, 65535.0);
        assert_eq!(values[0], 1.0);
        assert!((values[1] - 0.5).abs() < 1.0 / 65535.0);
    }

    fn ideal() -> Camera {
        Camera {
            mean: 0.2,
            clips: false,
            read_noise: 0.0,
            shot_noise: 0.0,
            shift: 0.0,
            blur: 0.0,
            storage: Storage::Linear16,
        }
    }

    #[test]
    fn cautious_exposure_saves_highlights_but_not_at_any_price() {
        let camera = ideal();
        let close = |a: f32, b: f32| (a - b).abs() < 1e-5;
        assert!(close(camera.gain(0.1, 0.2), 2.0));
        assert!(close(camera.gain(0.1, 1.0), 1.0));
        assert!(close(camera.gain(0.1, 100.0), 0.2));
    }

    #[test]
    fn noise_has_the_deviations_asked_for() {
        let camera = Camera {
            read_noise: 0.01,
            shot_noise: 0.02,
            ..ideal()
        };
        let mut random = Random::new(1, crate::random::Stream::Camera);
        for level in [0.1f32, 0.5] {
            let mut light = vec![level; 60_000];
            camera.expose(&mut light, 1.0, &mut random);
            let count = light.len() as f32;
            let mean = light.iter().sum::<f32>() / count;
            let variance = light.iter().map(|v| (v - mean).powi(2)).sum::<f32>() / count;
            let expected = 0.01f32.powi(2) + 0.02f32.powi(2) * level;
            assert!((mean - level).abs() < 1e-3, "{mean}");
            assert!(
                (variance / expected - 1.0).abs() < 0.05,
                "{variance} {expected}"
            );
        }
    }
}
