//! Numbers as they come out of the decoder.
use super::layout::{Kind, Layout};
use normalight_core::Samples;
use tiff::decoder::DecodingResult;

/// Samples before they are brought to full scale.
pub(super) struct Codes {
    pub(super) samples: Samples,
    /// Largest code; 1 for floating point, which is at full scale already.
    pub(super) full: u32,
}

impl Codes {
    /// Interleaved channels of what was decoded; `None` when there is too little of it.
    ///
    /// Signed and 32-bit integers become fractions of their largest value.
    pub(super) fn new(decoded: DecodingResult, layout: &Layout) -> Option<Self> {
        let signed = layout.kind == Kind::Signed;
        let part = |value: f64, full: f64| (value / full) as f32;
        let samples = match decoded {
            DecodingResult::U8(bytes) if layout.bits < 8 => {
                Samples::U8(unpacked(&bytes, layout, |code| code as u8)?)
            }
            DecodingResult::U8(bytes) if layout.bits > 8 => {
                Samples::U16(unpacked(&bytes, layout, |code| code)?)
            }
            DecodingResult::U8(codes) if signed => {
                let values = codes.iter().map(|&code| f64::from(code as i8));
                Samples::F32(values.map(|value| part(value, 127.0)).collect())
            }
            DecodingResult::U8(codes) => Samples::U8(codes),
            DecodingResult::U16(codes) if signed => {
                let values = codes.iter().map(|&code| f64::from(code as i16));
                Samples::F32(values.map(|value| part(value, 32_767.0)).collect())
            }
            DecodingResult::U16(codes) => Samples::U16(codes),
            DecodingResult::U32(codes) if signed => {
                let values = codes.iter().map(|&code| f64::from(code as i32));
                Samples::F32(
                    values
                        .map(|value| part(value, f64::from(i32::MAX)))
                        .collect(),
                )
            }
            DecodingResult::U32(codes) => {
                let values = codes.iter().map(|&code| f64::from(code));
                Samples::F32(
                    values
                        .map(|value| part(value, f64::from(u32::MAX)))
                        .collect(),
                )
            }
            DecodingResult::U64(codes) => {
                let values = codes.iter().map(|&code| match signed {
                    true => part(code as i64 as f64, i64::MAX as f64),
                    false => part(code as f64, u64::MAX as f64),
                });
                Samples::F32(values.collect())
            }
            DecodingResult::F16(values) => {
                Samples::F32(values.iter().map(|value| value.to_f32()).collect())
            }
            DecodingResult::F32(values) => Samples::F32(values),
            DecodingResult::F64(values) => {
                Samples::F32(values.iter().map(|&value| value as f32).collect())
            }
            _ => return None,
        };
        let full = match &samples {
            Samples::F32(_) => 1,
            _ => (1 << layout.bits) - 1,
        };
        let area = layout.width as usize * layout.height as usize;
        let count = match &samples {
            Samples::U8(codes) => codes.len(),
            Samples::U16(codes) => codes.len(),
            Samples::F32(values) => values.len(),
        };
        (count == area * layout.samples).then_some(Self { samples, full })
    }

    /// Planes of one kind, pixel by pixel; `None` when they differ.
    pub(super) fn woven(planes: Vec<Self>) -> Option<Self> {
        let full = planes.first()?.full;
        let (mut bytes, mut words, mut values) = (Vec::new(), Vec::new(), Vec::new());
        let count = planes.len();
        for plane in planes {
            match plane.samples {
                Samples::U8(codes) => bytes.push(codes),
                Samples::U16(codes) => words.push(codes),
                Samples::F32(samples) => values.push(samples),
            }
        }
        let samples = match count {
            count if count == bytes.len() => Samples::U8(interleaved(&bytes)?),
            count if count == words.len() => Samples::U16(interleaved(&words)?),
            count if count == values.len() => Samples::F32(interleaved(&values)?),
            _ => return None,
        };
        Some(Self { samples, full })
    }

    /// Some of `channels` channels, in this order.
    pub(super) fn chosen(self, channels: usize, places: &[usize]) -> Self {
        fn some<T: Copy>(values: Vec<T>, channels: usize, places: &[usize]) -> Vec<T> {
            if places.iter().copied().eq(0..channels) {
                return values;
            }
            let pixels = values.chunks_exact(channels);
            pixels
                .flat_map(|pixel| places.iter().map(|&place| pixel[place]))
                .collect()
        }
        let samples = match self.samples {
            Samples::U8(codes) => Samples::U8(some(codes, channels, places)),
            Samples::U16(codes) => Samples::U16(some(codes, channels, places)),
            Samples::F32(values) => Samples::F32(some(values, channels, places)),
        };
        Self { samples, ..self }
    }

    /// Codes spread to full scale.
    pub(super) fn scaled(self) -> Samples {
        let full = self.full;
        match self.samples {
            Samples::U8(codes) if full != 255 => {
                let spread = |code: u8| (u32::from(code) * 255 + full / 2) / full;
                Samples::U8(codes.into_iter().map(|code| spread(code) as u8).collect())
            }
            Samples::U16(codes) if full != 65_535 => {
                let spread = |code: u16| (u32::from(code) * 65_535 + full / 2) / full;
                Samples::U16(codes.into_iter().map(|code| spread(code) as u16).collect())
            }
            samples => samples,
        }
    }
}

/// Codes of less than 16 bits out of bytes, first bits first; rows begin with a byte.
fn unpacked<T>(packed: &[u8], layout: &Layout, code: impl Fn(u16) -> T) -> Option<Vec<T>> {
    let bits = u32::from(layout.bits);
    let row = layout.width as usize * layout.samples;
    let rows = layout.height as usize;
    let bytes = (row * usize::from(layout.bits)).div_ceil(8);
    if packed.len() != bytes * rows {
        return None;
    }
    let mask = (1u32 << bits) - 1;
    let mut codes = Vec::with_capacity(row * rows);
    for line in packed.chunks_exact(bytes) {
        let (mut held, mut count) = (0u32, 0);
        let mut line = line.iter();
        for _ in 0..row {
            while count < bits {
                held = held << 8 | u32::from(*line.next()?);
                count += 8;
            }
            count -= bits;
            codes.push(code((held >> count & mask) as u16));
        }
    }
    Some(codes)
}

/// Planes of one length, pixel by pixel.
fn interleaved<T: Copy>(planes: &[Vec<T>]) -> Option<Vec<T>> {
    let area = planes.first()?.len();
    if planes.iter().any(|plane| plane.len() != area) {
        return None;
    }
    let mut pixels = Vec::with_capacity(area * planes.len());
    for pixel in 0..area {
        pixels.extend(planes.iter().map(|plane| plane[pixel]));
    }
    Some(pixels)
}
