use crate::{CoreError, Rect, Transfer};

/// Smallest side of an image, in pixels.
const MIN_SIDE: usize = 4;

/// Samples of one image as decoded: rows from the top, channels interleaved.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// 8 bits, 255 is full scale.
    U8(Vec<u8>),
    /// 16 bits, 65535 is full scale.
    U16(Vec<u16>),
    /// Floating point, already linear whatever the transfer says.
    F32(Vec<f32>),
}

impl Samples {
    fn len(&self) -> usize {
        match self {
            Samples::U8(samples) => samples.len(),
            Samples::U16(samples) => samples.len(),
            Samples::F32(samples) => samples.len(),
        }
    }
}

/// One photograph of a stack.
#[derive(Debug, Clone, PartialEq)]
pub struct StackImage {
    /// File name, for messages and for `lights.csv`.
    pub name: String,
    /// Width in pixels.
    pub width: usize,
    /// Height in pixels.
    pub height: usize,
    /// 1 (grey) or 3 (RGB).
    pub channels: usize,
    /// width * height * channels samples.
    pub samples: Samples,
    /// How the samples relate to light.
    pub transfer: Transfer,
}

impl StackImage {
    /// Checks the image by itself and against the first one of its stack.
    ///
    /// # Errors
    /// Another size than the first one's, a tiny one, a wrong number of samples, NaN or infinite samples.
    pub(super) fn check(&self, first: &Self) -> Result<(), CoreError> {
        let name = || self.name.clone();
        if (self.width, self.height) != (first.width, first.height) {
            return Err(CoreError::SizeMismatch {
                name: name(),
                found_width: self.width,
                found_height: self.height,
                expected_width: first.width,
                expected_height: first.height,
            });
        }
        if self.width < MIN_SIDE || self.height < MIN_SIDE {
            return Err(CoreError::TooSmall {
                name: name(),
                width: self.width,
                height: self.height,
                expected: MIN_SIDE,
            });
        }
        let expected = self.width * self.height * self.channels;
        if self.samples.len() != expected || !matches!(self.channels, 1 | 3) {
            return Err(CoreError::SampleCount {
                name: name(),
                found: self.samples.len(),
                expected,
            });
        }
        if let Samples::F32(samples) = &self.samples
            && let Some(index) = samples.iter().position(|value| !value.is_finite())
        {
            return Err(CoreError::NotFinite {
                name: name(),
                index,
                value: samples[index],
            });
        }
        Ok(())
    }

    /// Linear RGB planes of a rectangle, see [`ImageStack::linear_tile`](super::ImageStack::linear_tile);
    /// `srgb8`: linear value of each 8-bit sRGB code.
    pub(super) fn linear_tile(&self, srgb8: &[f32; 256], rect: Rect, out: &mut [f32]) {
        match &self.samples {
            Samples::U8(samples) => match self.transfer {
                Transfer::Linear => {
                    copy_tile(self, samples, rect, out, |code| f32::from(code) / 255.0);
                }
                Transfer::Srgb => {
                    copy_tile(self, samples, rect, out, |code| srgb8[usize::from(code)]);
                }
            },
            Samples::U16(samples) => copy_tile(self, samples, rect, out, |code| {
                self.transfer.decode(f32::from(code) / 65535.0)
            }),
            Samples::F32(samples) => copy_tile(self, samples, rect, out, |value| value),
        }
    }

    /// Linear RGB of single pixels, see [`ImageStack::linear_pixels`](super::ImageStack::linear_pixels).
    pub(super) fn linear_pixels(&self, srgb8: &[f32; 256], pixels: &[usize], out: &mut [[f32; 3]]) {
        match &self.samples {
            Samples::U8(samples) => match self.transfer {
                Transfer::Linear => {
                    copy_pixels(self, samples, pixels, out, |code| f32::from(code) / 255.0);
                }
                Transfer::Srgb => {
                    copy_pixels(self, samples, pixels, out, |code| srgb8[usize::from(code)]);
                }
            },
            Samples::U16(samples) => copy_pixels(self, samples, pixels, out, |code| {
                self.transfer.decode(f32::from(code) / 65535.0)
            }),
            Samples::F32(samples) => copy_pixels(self, samples, pixels, out, |value| value),
        }
    }
}

fn copy_tile<T: Copy>(
    image: &StackImage,
    samples: &[T],
    rect: Rect,
    out: &mut [f32],
    decode: impl Fn(T) -> f32,
) {
    let channels = image.channels;
    for (channel, plane) in out.chunks_exact_mut(rect.area()).enumerate() {
        let source_channel = channel.min(channels - 1);
        for (row, line) in plane.chunks_exact_mut(rect.width).enumerate() {
            let start = ((rect.y + row) * image.width + rect.x) * channels;
            let source = &samples[start..start + rect.width * channels];
            for (value, pixel) in line.iter_mut().zip(source.chunks_exact(channels)) {
                // Negative light (possible in EXR) carries no meaning here.
                *value = decode(pixel[source_channel]).max(0.0);
            }
        }
    }
}

fn copy_pixels<T: Copy>(
    image: &StackImage,
    samples: &[T],
    pixels: &[usize],
    out: &mut [[f32; 3]],
    decode: impl Fn(T) -> f32,
) {
    for (value, &pixel) in out.iter_mut().zip(pixels) {
        let start = pixel * image.channels;
        *value = std::array::from_fn(|channel| {
            decode(samples[start + channel.min(image.channels - 1)]).max(0.0)
        });
    }
}
