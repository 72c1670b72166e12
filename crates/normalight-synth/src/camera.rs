use crate::noise::Deviates;
use crate::random::Random;
use crate::recipe::CameraRecipe;
use std::sync::OnceLock;

/// Below this mean a scene is not darkened any further to save its highlights.
const DARKEST_MEAN: f32 = 0.02;

/// A camera's exposure, noise and number format.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Camera {
    mean: f32,
    clips: bool,
    /// Deviation of the noise in the dark.
    read_noise: f32,
    /// Deviation of the photon noise at full scale; it grows with the square root of the light.
    shot_noise: f32,
    storage: Storage,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Storage {
    Linear8,
    Srgb8,
    Linear16,
}

impl Camera {
    pub(crate) fn draw(recipe: &CameraRecipe, random: &mut Random) -> Self {
        let [low, high] = recipe.noise;
        let noise = random.log_range(low, high);
        let storage = random.unit();
        Self {
            mean: random.log_range(recipe.mean[0], recipe.mean[1]),
            clips: random.chance(recipe.clip_share),
            read_noise: noise * random.range(0.02, 0.25),
            shot_noise: noise,
            storage: if storage < recipe.linear_8_bit_share {
                Storage::Linear8
            } else if storage < recipe.linear_8_bit_share + recipe.srgb_8_bit_share {
                Storage::Srgb8
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

    /// Takes the picture: exposes, adds noise, clips and rounds the values of one plane at the
    /// given pixels.
    pub(crate) fn take(&self, plane: &mut [f32], pixels: &[usize], gain: f32, random: &mut Random) {
        let deviates = Deviates::shared();
        let start = random.below(1 << 14);
        let read = self.read_noise * self.read_noise;
        let shot = self.shot_noise * self.shot_noise;
        for (index, &pixel) in pixels.iter().enumerate() {
            let light = plane[pixel] * gain;
            let noisy = light + deviates.at(start + index) * (read + shot * light).sqrt();
            plane[pixel] = self.store(noisy.clamp(0.0, 1.0));
        }
    }

    fn store(&self, value: f32) -> f32 {
        match self.storage {
            Storage::Linear8 => round(value, 255.0),
            Storage::Linear16 => round(value, 65535.0),
            Storage::Srgb8 => SrgbCodes::shared().round(value),
        }
    }
}

fn round(value: f32, steps: f32) -> f32 {
    (value * steps + 0.5) as u32 as f32 / steps
}

/// The light of each 8-bit sRGB code (IEC 61966-2-1).
struct SrgbCodes([f32; 256]);

impl SrgbCodes {
    fn shared() -> &'static Self {
        static CODES: OnceLock<SrgbCodes> = OnceLock::new();
        CODES.get_or_init(|| {
            Self(std::array::from_fn(|code| {
                let encoded = code as f32 / 255.0;
                if encoded <= 0.04045 {
                    encoded / 12.92
                } else {
                    libm::powf((encoded + 0.055) / 1.055, 2.4)
                }
            }))
        })
    }

    /// The light nearest to `value` that has a code.
    fn round(&self, value: f32) -> f32 {
        let above = self.0.partition_point(|&light| light < value).min(255);
        let below = above.saturating_sub(1);
        if value - self.0[below] < self.0[above] - value {
            self.0[below]
        } else {
            self.0[above]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_core::Transfer;

    #[test]
    fn srgb_codes_survive_their_own_rounding() {
        for code in 0..=255u8 {
            let light = Transfer::Srgb.decode(f32::from(code) / 255.0);
            let rounded = SrgbCodes::shared().round(light);
            assert_eq!(
                (Transfer::Srgb.encode(rounded) * 255.0).round(),
                f32::from(code)
            );
        }
    }

    #[test]
    fn rounding_hits_the_nearest_step() {
        assert_eq!(round(0.3 / 255.0, 255.0), 0.0);
        assert_eq!(round(0.6 / 255.0, 255.0), 1.0 / 255.0);
        assert_eq!(round(1.0, 65535.0), 1.0);
    }

    #[test]
    fn cautious_exposure_saves_highlights_but_not_at_any_price() {
        let camera = Camera {
            mean: 0.2,
            clips: false,
            read_noise: 0.0,
            shot_noise: 0.0,
            storage: Storage::Linear16,
        };
        let close = |a: f32, b: f32| (a - b).abs() < 1e-5;
        assert!(close(camera.gain(0.1, 0.2), 2.0));
        assert!(close(camera.gain(0.1, 1.0), 1.0));
        assert!(close(camera.gain(0.1, 100.0), 0.2));
    }
}
