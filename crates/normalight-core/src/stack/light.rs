//! Samples to linear light and back.
use super::{Samples, StackImage};
use crate::Transfer;

impl StackImage {
    /// The image with each sample's linear light (full scale 1) replaced by what `change` makes of
    /// its position and its light, kind of sample and transfer as they are.
    pub fn with_light(&self, mut change: impl FnMut(usize, f32) -> f32) -> Self {
        let samples = match &self.samples {
            Samples::U8(codes) => {
                let table = self.light_of_codes(255);
                let changed = codes.iter().enumerate().map(|(place, &code)| {
                    let light = change(place, table[usize::from(code)]);
                    (self.code_value(light) * 255.0).round() as u8
                });
                Samples::U8(changed.collect())
            }
            Samples::U16(codes) => {
                let table = self.light_of_codes(65_535);
                let changed = codes.iter().enumerate().map(|(place, &code)| {
                    let light = change(place, table[usize::from(code)]);
                    (self.code_value(light) * 65_535.0).round() as u16
                });
                Samples::U16(changed.collect())
            }
            Samples::F32(values) => {
                let values = values.iter().enumerate();
                Samples::F32(values.map(|(place, &light)| change(place, light)).collect())
            }
        };
        Self {
            name: self.name.clone(),
            samples,
            ..*self
        }
    }

    /// Linear light of each code up to the full one.
    pub(crate) fn light_of_codes(&self, full: u16) -> Vec<f32> {
        let decode = |code: u16| self.transfer.decode(f32::from(code) / f32::from(full));
        (0..=full).map(decode).collect()
    }

    /// Encoded value of linear light, 0 to 1.
    pub(crate) fn code_value(&self, light: f32) -> f32 {
        let light = light.clamp(0.0, 1.0);
        match self.transfer {
            Transfer::Linear => light,
            transfer => transfer.encode(light).clamp(0.0, 1.0),
        }
    }
}
