//! Pixels of an object on a regular grid, with their neighbours.
use crate::robust::grey_samples;
use crate::{CoreError, ImageStack, Mask, on_all_cores};
use glam::DVec3;

/// About as many pixels are looked at; of larger objects every second, third, ... in rows and columns.
const PIXELS: usize = 32_768;
/// Fewest pixels with four neighbours that say anything about a surface.
pub(super) const FEW: usize = 32;
const NONE: u32 = u32::MAX;

/// Grey values of some pixels in all images.
#[derive(Debug)]
pub(super) struct Sampled {
    images: usize,
    /// `[pixels, images]`.
    samples: Vec<f32>,
    /// Columns and rows of the grid.
    size: [usize; 2],
    /// Column and row of each pixel.
    places: Vec<[usize; 2]>,
    /// Number of the pixel at each place of the grid, row by row.
    numbers: Vec<u32>,
}

impl Sampled {
    /// # Errors
    /// [`CoreError::TooFewPixels`].
    pub fn new(stack: &ImageStack, mask: &Mask) -> Result<Self, CoreError> {
        let stride = ((mask.count() as f64 / PIXELS as f64).sqrt().ceil() as usize).max(1);
        let size = [mask.width(), mask.height()].map(|side| side.div_ceil(stride));
        let mut numbers = vec![NONE; size[0] * size[1]];
        let (mut places, mut pixels) = (Vec::new(), Vec::new());
        for y in 0..size[1] {
            for x in 0..size[0] {
                let pixel = y * stride * mask.width() + x * stride;
                if mask.inside()[pixel] {
                    numbers[y * size[0] + x] = places.len() as u32;
                    places.push([x, y]);
                    pixels.push(pixel);
                }
            }
        }
        let tiles: Vec<&[usize]> = pixels.chunks(2048).collect();
        let samples = on_all_cores(tiles.len(), |tile| {
            grey_samples(stack, tiles[tile], |_| [1.0; 3])
        });
        let sampled = Self {
            images: stack.len(),
            samples: samples.concat(),
            size,
            places,
            numbers,
        };
        let found = sampled.crosses().len();
        if found < FEW {
            return Err(CoreError::TooFewPixels {
                found,
                expected: FEW,
            });
        }
        Ok(sampled)
    }

    pub fn images(&self) -> usize {
        self.images
    }

    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// The values of a pixel in all images.
    pub fn of(&self, pixel: usize) -> &[f32] {
        &self.samples[pixel * self.images..][..self.images]
    }

    /// Share of the images in which a pixel is lit.
    pub fn lit(&self, pixel: usize) -> f32 {
        let lit = self.of(pixel).iter().filter(|&&value| value > 0.0);
        lit.count() as f32 / self.images as f32
    }

    /// How bright each image is, relative to the others: the median over the pixels of the value relative to the pixel's
    /// mean.
    pub fn brightness(&self) -> Vec<f64> {
        let means: Vec<f32> = (0..self.len())
            .map(|pixel| self.of(pixel).iter().sum::<f32>() / self.images as f32)
            .collect();
        let medians = on_all_cores(self.images, |image| {
            let mut shares: Vec<f32> = (0..self.len())
                .filter(|&pixel| means[pixel] > 0.0 && self.of(pixel)[image] > 0.0)
                .map(|pixel| self.of(pixel)[image] / means[pixel])
                .collect();
            f64::from(crate::albedo::quantile_of(&mut shares, 0.5))
        });
        // An image that is black shows no light at all; any number will do.
        medians
            .into_iter()
            .map(|median| if median > 0.0 { median } else { 1.0 })
            .collect()
    }

    /// The pixel some places to the right and below.
    pub fn beside(&self, pixel: usize, right: isize, below: isize) -> Option<usize> {
        let [x, y] = self.places[pixel];
        let x = x.checked_add_signed(right).filter(|&x| x < self.size[0])?;
        let y = y.checked_add_signed(below).filter(|&y| y < self.size[1])?;
        let number = self.numbers[y * self.size[0] + x];
        (number != NONE).then_some(number as usize)
    }

    /// Pixels with those to the left, to the right, above and below.
    pub fn crosses(&self) -> Vec<[usize; 5]> {
        let cross = |pixel: usize| {
            Some([
                pixel,
                self.beside(pixel, -1, 0)?,
                self.beside(pixel, 1, 0)?,
                self.beside(pixel, 0, -1)?,
                self.beside(pixel, 0, 1)?,
            ])
        };
        (0..self.len()).filter_map(cross).collect()
    }

    /// 1 where vectors lean away from the object's middle, -1 where they lean towards it.
    pub fn outwards(&self, vectors: &[DVec3]) -> f64 {
        let sum = |axis: usize| self.places.iter().map(|place| place[axis]).sum::<usize>() as f64;
        let [x, y] = [0, 1].map(|axis| sum(axis) / self.len() as f64);
        let lean = |(place, vector): (&[usize; 2], &DVec3)| {
            let unit = vector.normalize_or_zero();
            unit.x * (place[0] as f64 - x) - unit.y * (place[1] as f64 - y)
        };
        let total: f64 = self.places.iter().zip(vectors).map(lean).sum();
        1f64.copysign(total)
    }
}
