use normalight_core::{Samples, StackImage, Transfer};
use normalight_synth::Sample;

/// Photographs shown of each stack.
const PHOTOGRAPHS: usize = 6;
/// Stacks beside each other.
const COLUMNS: usize = 2;
/// Pictures of one stack: its normals and some photographs.
const PICTURES: usize = 1 + PHOTOGRAPHS;

/// A picture of many stacks: for each its normals and some of its photographs, for the eye.
pub(crate) struct ContactSheet {
    size: usize,
    /// `[stacks][PICTURES * 3 * size * size]`, interleaved pictures one after the other
    strips: Vec<Vec<u8>>,
}

impl ContactSheet {
    /// `size`: side of the photographs in pixels.
    pub(crate) fn new(size: usize) -> Self {
        Self {
            size,
            strips: Vec::new(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.strips.len()
    }

    pub(crate) fn add(&mut self, sample: &Sample) {
        let area = self.size * self.size;
        let byte = |value: f32| (value * 255.0 + 0.5) as u8;
        let mut strip = Vec::with_capacity(PICTURES * 3 * area);
        for (normal, inside) in sample.normals.iter().zip(&sample.mask) {
            let shown = if *inside {
                0.5 + 0.5 * *normal
            } else {
                *normal
            };
            strip.extend(shown.to_array().map(byte));
        }
        let images = sample.lights.len();
        for shown in 0..PHOTOGRAPHS {
            // Evenly spaced; some twice when there are fewer.
            let image = shown * images / PHOTOGRAPHS;
            for pixel in 0..area {
                for channel in 0..3 {
                    let light = sample.images[(image * 3 + channel) * area + pixel];
                    strip.push(byte(Transfer::Srgb.encode(light)));
                }
            }
        }
        self.strips.push(strip);
    }

    pub(crate) fn to_image(&self) -> StackImage {
        let rows = self.strips.len().div_ceil(COLUMNS).max(1);
        let width = COLUMNS * PICTURES * self.size;
        let height = rows * self.size;
        let mut bytes = vec![0; width * height * 3];
        let line = 3 * self.size;
        for (index, strip) in self.strips.iter().enumerate() {
            for (picture, pixels) in strip.chunks_exact(line * self.size).enumerate() {
                let left = (index % COLUMNS * PICTURES + picture) * line;
                for (row, values) in pixels.chunks_exact(line).enumerate() {
                    let start = (index / COLUMNS * self.size + row) * width * 3 + left;
                    bytes[start..start + line].copy_from_slice(values);
                }
            }
        }
        StackImage {
            name: "sheet.png".to_owned(),
            width,
            height,
            channels: 3,
            samples: Samples::U8(bytes),
            transfer: Transfer::Linear,
        }
    }
}
