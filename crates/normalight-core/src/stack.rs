use crate::{CoreError, Mask, Rect, Transfer};

/// Fewest photographs that photometric stereo works with.
pub const MIN_IMAGES: usize = 3;

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

/// Photographs of one object from a fixed camera, one light each.
///
/// Samples stay as decoded (1 or 2 bytes each), so that 96 large photographs fit into memory;
/// [`ImageStack::linear_tile`] hands out linear RGB where it is needed.
#[derive(Debug, Clone)]
pub struct ImageStack {
    images: Vec<StackImage>,
    /// Linear value of each 8-bit sRGB code.
    srgb8: Box<[f32; 256]>,
}

impl ImageStack {
    /// Checks the images against each other and takes them.
    ///
    /// # Errors
    /// Fewer than [`MIN_IMAGES`] images, images of different or tiny sizes, a wrong number of
    /// samples, NaN or infinite samples.
    pub fn new(images: Vec<StackImage>) -> Result<Self, CoreError> {
        for image in &images {
            check_image(image, &images[0])?;
        }
        if images.len() < MIN_IMAGES {
            return Err(CoreError::TooFewImages {
                found: images.len(),
                expected: MIN_IMAGES,
            });
        }
        let mut srgb8 = Box::new([0.0; 256]);
        for (code, value) in srgb8.iter_mut().enumerate() {
            *value = Transfer::Srgb.decode(code as f32 / 255.0);
        }
        Ok(Self { images, srgb8 })
    }

    /// Number of images.
    pub fn len(&self) -> usize {
        self.images.len()
    }

    /// Never true: a stack has at least [`MIN_IMAGES`] images.
    pub fn is_empty(&self) -> bool {
        self.images.is_empty()
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.images[0].width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.images[0].height
    }

    /// The images as decoded.
    pub fn images(&self) -> &[StackImage] {
        &self.images
    }

    /// Says anew how the samples of one image relate to light.
    ///
    /// # Panics
    /// There is no such image.
    pub fn set_transfer(&mut self, image: usize, transfer: Transfer) {
        self.images[image].transfer = transfer;
    }

    /// Writes a rectangle of one image as linear RGB planes into `out`.
    ///
    /// # Shapes
    /// `out`: `[3, rect.height, rect.width]`, row-major. Full scale is 1; grey fills all planes.
    ///
    /// # Panics
    /// `rect` or `out` does not fit: a mistake of the caller, never of a file.
    pub fn linear_tile(&self, image: usize, rect: Rect, out: &mut [f32]) {
        assert!(rect.x + rect.width <= self.width() && rect.y + rect.height <= self.height());
        assert_eq!(out.len(), 3 * rect.area());
        let image = &self.images[image];
        match &image.samples {
            Samples::U8(samples) => match image.transfer {
                Transfer::Linear => {
                    copy_tile(image, samples, rect, out, |code| f32::from(code) / 255.0);
                }
                Transfer::Srgb => {
                    copy_tile(image, samples, rect, out, |code| {
                        self.srgb8[usize::from(code)]
                    });
                }
            },
            Samples::U16(samples) => copy_tile(image, samples, rect, out, |code| {
                image.transfer.decode(f32::from(code) / 65535.0)
            }),
            Samples::F32(samples) => copy_tile(image, samples, rect, out, |value| value),
        }
    }

    /// Linear RGB of single pixels of one image, one after the other.
    ///
    /// # Shapes
    /// `pixels`: positions `y * width + x`; `out`: `[pixels, 3]`.
    ///
    /// # Panics
    /// A position lies outside the image, or `out` has another length.
    pub fn linear_pixels(&self, image: usize, pixels: &[usize], out: &mut [[f32; 3]]) {
        assert_eq!(out.len(), pixels.len());
        let image = &self.images[image];
        match &image.samples {
            Samples::U8(samples) => match image.transfer {
                Transfer::Linear => {
                    copy_pixels(image, samples, pixels, out, |code| f32::from(code) / 255.0);
                }
                Transfer::Srgb => {
                    copy_pixels(image, samples, pixels, out, |code| {
                        self.srgb8[usize::from(code)]
                    });
                }
            },
            Samples::U16(samples) => copy_pixels(image, samples, pixels, out, |code| {
                image.transfer.decode(f32::from(code) / 65535.0)
            }),
            Samples::F32(samples) => copy_pixels(image, samples, pixels, out, |value| value),
        }
    }

    /// The largest linear RGB value of one pixel over all images, for every pixel.
    ///
    /// # Shapes
    /// `[height, width]`, row-major.
    pub fn brightest(&self) -> Vec<f32> {
        let rect = Rect::whole(self.width(), self.height());
        let mut tile = vec![0.0; 3 * rect.area()];
        let mut brightest = vec![0.0f32; rect.area()];
        for image in 0..self.len() {
            self.linear_tile(image, rect, &mut tile);
            for plane in tile.chunks_exact(rect.area()) {
                for (best, &value) in brightest.iter_mut().zip(plane) {
                    *best = best.max(value);
                }
            }
        }
        brightest
    }

    /// Checks that the mask fits and that some light falls inside it.
    ///
    /// # Errors
    /// [`CoreError::MaskSize`], [`CoreError::EmptyMask`] or [`CoreError::AllBlack`].
    pub fn check_mask(&self, mask: &Mask, name: &str) -> Result<(), CoreError> {
        if (mask.width(), mask.height()) != (self.width(), self.height()) {
            return Err(CoreError::MaskSize {
                name: name.to_owned(),
                found_width: mask.width(),
                found_height: mask.height(),
                expected_width: self.width(),
                expected_height: self.height(),
            });
        }
        if mask.count() == 0 {
            return Err(CoreError::EmptyMask {
                name: name.to_owned(),
            });
        }
        let lit = self
            .brightest()
            .iter()
            .zip(mask.inside())
            .any(|(&value, &inside)| inside && value > 0.0);
        if !lit {
            return Err(CoreError::AllBlack { images: self.len() });
        }
        Ok(())
    }
}

/// Positions of `count` evenly spaced items among `total`, in order, the first included; all when `count` is larger.
pub fn evenly_spaced_indices(total: usize, count: usize) -> Vec<usize> {
    let count = count.min(total);
    (0..count).map(|k| k * total / count).collect()
}

fn check_image(image: &StackImage, first: &StackImage) -> Result<(), CoreError> {
    let name = || image.name.clone();
    if (image.width, image.height) != (first.width, first.height) {
        return Err(CoreError::SizeMismatch {
            name: name(),
            found_width: image.width,
            found_height: image.height,
            expected_width: first.width,
            expected_height: first.height,
        });
    }
    if image.width < MIN_SIDE || image.height < MIN_SIDE {
        return Err(CoreError::TooSmall {
            name: name(),
            width: image.width,
            height: image.height,
            expected: MIN_SIDE,
        });
    }
    let expected = image.width * image.height * image.channels;
    if image.samples.len() != expected || !matches!(image.channels, 1 | 3) {
        return Err(CoreError::SampleCount {
            name: name(),
            found: image.samples.len(),
            expected,
        });
    }
    if let Samples::F32(samples) = &image.samples
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

#[cfg(test)]
mod tests {
    use super::*;

    fn image(name: &str, samples: Samples, channels: usize) -> StackImage {
        StackImage {
            name: name.into(),
            width: 5,
            height: 4,
            channels,
            samples,
            transfer: Transfer::Linear,
        }
    }

    #[test]
    fn tiles_are_planar_and_linear() {
        let rgb: Vec<u8> = (0..60).collect();
        let grey: Vec<u16> = (0..20).map(|k| k * 1000).collect();
        let float: Vec<f32> = (0..20).map(|k| k as f32 - 3.0).collect();
        let mut srgb = image("c", Samples::U8((0..60).map(|k| k * 4).collect()), 3);
        srgb.transfer = Transfer::Srgb;
        let stack = ImageStack::new(vec![
            image("a", Samples::U8(rgb), 3),
            image("b", Samples::U16(grey), 1),
            image("d", Samples::F32(float), 1),
            srgb,
        ])
        .unwrap();
        let rect = Rect {
            x: 1,
            y: 2,
            width: 3,
            height: 2,
        };
        let mut tile = vec![0.0; 18];
        stack.linear_tile(0, rect, &mut tile);
        // Pixel (x, y) = (2, 3), green: sample (3 * 5 + 2) * 3 + 1 = 52.
        assert_eq!(tile[6 + 3 + 1], 52.0 / 255.0);
        stack.linear_tile(1, rect, &mut tile);
        assert_eq!(tile[0], 11_000.0 / 65_535.0);
        assert_eq!(tile[0], tile[12]);
        let mut pixels = [[0.0; 3]; 2];
        stack.linear_pixels(1, &[11, 0], &mut pixels);
        assert_eq!(pixels, [[11_000.0 / 65_535.0; 3], [0.0; 3]]);
        stack.linear_tile(2, Rect::whole(5, 4), &mut vec![0.0; 60]);
        stack.linear_tile(3, rect, &mut tile);
        assert!((tile[10] - Transfer::Srgb.decode(208.0 / 255.0)).abs() < 1e-6);
    }

    #[test]
    fn bad_images_are_named() {
        let good = || image("good", Samples::U8(vec![1; 20]), 1);
        let mut wide = good();
        wide.width = 6;
        wide.name = "wide".into();
        let error = ImageStack::new(vec![good(), wide]).unwrap_err();
        assert!(error.to_string().contains("wide: 6x4"), "{error}");
        let error = ImageStack::new(vec![good(), good()]).unwrap_err();
        assert!(matches!(error, CoreError::TooFewImages { found: 2, .. }));
        let error = ImageStack::new(vec![]).unwrap_err();
        assert!(matches!(error, CoreError::TooFewImages { found: 0, .. }));
        let mut nan = vec![0.0; 20];
        nan[7] = f32::NAN;
        let error = ImageStack::new(vec![image("n.exr", Samples::F32(nan), 1)]).unwrap_err();
        assert!(
            error.to_string().contains("n.exr: sample 7 is NaN"),
            "{error}"
        );
        let short = image("s", Samples::U8(vec![1; 19]), 1);
        assert!(matches!(
            ImageStack::new(vec![short]),
            Err(CoreError::SampleCount { found: 19, .. })
        ));
    }

    #[test]
    fn evenly_spaced_picks_in_order() {
        assert_eq!(
            evenly_spaced_indices(96, 8),
            [0, 12, 24, 36, 48, 60, 72, 84]
        );
        assert_eq!(evenly_spaced_indices(5, 9), [0, 1, 2, 3, 4]);
        assert_eq!(evenly_spaced_indices(10, 3), [0, 3, 6]);
    }
}
