mod image;
mod light;

pub use image::{Samples, StackImage};

use crate::{CoreError, Mask, Rect, Transfer};

/// Fewest photographs that photometric stereo works with.
pub const MIN_IMAGES: usize = 3;

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
            image.check(&images[0])?;
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

    /// The images again, with what was said of them.
    pub fn into_images(self) -> Vec<StackImage> {
        self.images
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
        self.images[image].linear_tile(&self.srgb8, rect, out);
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
        self.images[image].linear_pixels(&self.srgb8, pixels, out);
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

    /// Whether any of some pixels shows light in any image; stops at the first.
    fn is_lit(&self, pixels: &[usize]) -> bool {
        let mut light = vec![[0.0; 3]; 4096];
        pixels.chunks(light.len()).any(|pixels| {
            let light = &mut light[..pixels.len()];
            (0..self.len()).any(|image| {
                self.linear_pixels(image, pixels, light);
                light.iter().flatten().any(|&value| value > 0.0)
            })
        })
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
        if !self.is_lit(&mask.pixels()) {
            return Err(CoreError::AllBlack { images: self.len() });
        }
        Ok(())
    }
}

/// Positions of `total` photographs in an order of which every stretch has lights from all sides.
///
/// Lamps often go round, or along rows: every so-manieth photograph of such a series could be lit from one column of
/// lamps only. Steps of the golden ratio, which is further from every fraction than any other number, fall in with no
/// period.
pub fn spread_order(total: usize) -> Vec<usize> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let place = |image: usize| (image as f64 * GOLDEN).fract();
    let mut order: Vec<usize> = (0..total).collect();
    order.sort_by(|&a, &b| place(a).total_cmp(&place(b)));
    order
}

/// Positions of `count` among `total` photographs, in order, whose lights come from all sides, see [`spread_order`]; the
/// first is included; all when `count` is larger.
pub fn spread_indices(total: usize, count: usize) -> Vec<usize> {
    let mut chosen = spread_order(total);
    chosen.truncate(count);
    chosen.sort_unstable();
    chosen
}

/// Positions of `count` evenly spaced items among `total`, in order, the first included; all when `count` is larger.
pub fn evenly_spaced_indices(total: usize, count: usize) -> Vec<usize> {
    let count = count.min(total);
    (0..count).map(|k| k * total / count).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_falls_in_with_no_row_of_lamps() {
        for total in [48, 96, 120] {
            for count in [6, 8, 12, 16, 24] {
                let chosen = spread_indices(total, count);
                assert!(chosen.len() == count && chosen[0] == 0);
                assert!(chosen.is_sorted_by(|a, b| a < b) && chosen[count - 1] < total);
                // No stretch of the series is left out.
                let gaps = chosen.windows(2).map(|pair| pair[1] - pair[0]);
                let widest = gaps.chain([total - chosen[count - 1]]).max().unwrap();
                assert!(widest * count <= 3 * total, "{count} of {total}: {widest}");
                for period in 3..=12 {
                    let mut seen = vec![0; period];
                    for index in &chosen {
                        seen[index % period] += 1;
                    }
                    // Evenly spaced ones may all fall on one column.
                    let most = seen.iter().max().unwrap();
                    assert!(
                        most * 2 <= count + 1,
                        "{count} of {total}, {period}: {seen:?}"
                    );
                }
            }
        }
        assert_eq!(spread_indices(5, 9), [0, 1, 2, 3, 4]);
    }

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
