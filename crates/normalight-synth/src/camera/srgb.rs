use std::sync::OnceLock;

/// Places of the table that gives a first guess.
const GUESSES: usize = 1024;

/// The 8-bit codes of sRGB (IEC 61966-2-1) and the light each stands for.
pub(crate) struct SrgbCodes {
    light: [f32; 256],
    /// Lights half way between neighbouring codes.
    between: [f32; 255],
    /// Largest code whose light is certainly not too bright, by the root of the light.
    guess: [u8; GUESSES],
}

impl SrgbCodes {
    pub(crate) fn shared() -> &'static Self {
        static CODES: OnceLock<SrgbCodes> = OnceLock::new();
        CODES.get_or_init(Self::new)
    }

    fn new() -> Self {
        let light: [f32; 256] = std::array::from_fn(|code| {
            let encoded = code as f32 / 255.0;
            if encoded <= 0.04045 {
                encoded / 12.92
            } else {
                libm::powf((encoded + 0.055) / 1.055, 2.4)
            }
        });
        let between: [f32; 255] = std::array::from_fn(|code| 0.5 * (light[code] + light[code + 1]));
        let guess = std::array::from_fn(|index| {
            let root = index as f32 / GUESSES as f32;
            between.partition_point(|&middle| middle < root * root) as u8
        });
        Self {
            light,
            between,
            guess,
        }
    }

    pub(crate) fn light(&self, code: u8) -> f32 {
        self.light[usize::from(code)]
    }

    /// The code whose light is nearest to a value in 0..=1.
    #[inline]
    pub(crate) fn nearest(&self, value: f32) -> u8 {
        let index = (value.sqrt() * GUESSES as f32) as usize;
        let mut code = self.guess[index.min(GUESSES - 1)];
        while code < 255 && value > self.between[usize::from(code)] {
            code += 1;
        }
        code
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_core::Transfer;

    #[test]
    fn codes_survive_their_own_rounding() {
        let codes = SrgbCodes::shared();
        for code in 0..=255u8 {
            let light = Transfer::Srgb.decode(f32::from(code) / 255.0);
            assert_eq!(codes.nearest(light), code);
            assert!((codes.light(code) - light).abs() < 1e-6);
        }
    }

    #[test]
    fn every_value_goes_to_its_nearest_code() {
        let codes = SrgbCodes::shared();
        for step in 0..=20_000 {
            let value = step as f32 / 20_000.0;
            let code = codes.nearest(value);
            let off = (codes.light(code) - value).abs();
            for other in [code.saturating_sub(1), code.saturating_add(1)] {
                assert!(off <= (codes.light(other) - value).abs() + 1e-7, "{value}");
            }
        }
    }
}
