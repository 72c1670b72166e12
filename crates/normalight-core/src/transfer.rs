/// How stored samples relate to light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Transfer {
    /// Samples are proportional to light.
    #[default]
    Linear,
    /// Samples are encoded with the sRGB curve (IEC 61966-2-1).
    Srgb,
}

impl Transfer {
    /// Linear light of an encoded value in 0..1.
    pub fn decode(self, encoded: f32) -> f32 {
        match self {
            Transfer::Linear => encoded,
            Transfer::Srgb if encoded <= 0.04045 => encoded / 12.92,
            Transfer::Srgb => ((encoded + 0.055) / 1.055).powf(2.4),
        }
    }

    /// Encoded value of linear light in 0..1; the inverse of [`Transfer::decode`].
    pub fn encode(self, linear: f32) -> f32 {
        match self {
            Transfer::Linear => linear,
            Transfer::Srgb if linear <= 0.003_130_8 => linear * 12.92,
            Transfer::Srgb => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn srgb_round_trips(value in 0.0f32..1.0) {
            let again = Transfer::Srgb.encode(Transfer::Srgb.decode(value));
            prop_assert!((again - value).abs() < 1e-5);
        }
    }

    #[test]
    fn srgb_middle_grey() {
        // 50 % encoded is 21.4 % of the light (IEC 61966-2-1).
        assert!((Transfer::Srgb.decode(0.5) - 0.214_041).abs() < 1e-5);
    }
}
