use super::Projection;
use crate::{Mask, Vec3};

/// The shape of an object as the height of each pixel.
///
/// Heights are in pixels (one is the side of a pixel in the middle of the object), grow towards the
/// camera and have no known zero: it is the mean over each connected part of the mask. With a
/// perspective camera the scale of each part is unknown, too: the geometric mean of its distances is
/// taken to be the focal length, and heights are measured from there.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMap {
    pub(super) mask: Mask,
    pub(super) projection: Projection,
    pub(super) heights: Vec<f32>,
    pub(super) breaks: Vec<Breaks>,
    pub(super) parts: usize,
    pub(super) missing: usize,
    pub(super) steep: usize,
}

/// Where the surface is torn beside a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Breaks {
    pub(super) right: bool,
    pub(super) below: bool,
}

impl DepthMap {
    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.mask.width()
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.mask.height()
    }

    /// The pixels that have a height.
    pub fn mask(&self) -> &Mask {
        &self.mask
    }

    /// How the camera saw the object.
    pub fn projection(&self) -> Projection {
        self.projection
    }

    /// One height per pixel, rows from the top, in pixels; zero outside the mask.
    pub fn heights(&self) -> &[f32] {
        &self.heights
    }

    /// Number of connected parts of the mask (side by side), each with a zero of its own.
    pub fn parts(&self) -> usize {
        self.parts
    }

    /// Pixels of the mask that had no normal and are filled in from their neighbours.
    pub fn missing(&self) -> usize {
        self.missing
    }

    /// Pixels whose normals lie along the line of sight's rim or point away from the camera, which no
    /// visible surface does; filled in as well.
    pub fn steep(&self) -> usize {
        self.steep
    }

    /// Whether the surface is torn between a pixel and the one to its right.
    pub fn breaks_right(&self, pixel: usize) -> bool {
        self.breaks[pixel].right
    }

    /// Whether the surface is torn between a pixel and the one below it.
    pub fn breaks_below(&self, pixel: usize) -> bool {
        self.breaks[pixel].below
    }

    /// Share (0..=1) of neighbouring pixels of the mask between which the surface is torn.
    pub fn torn(&self) -> f32 {
        let (mut torn, mut all) = (0usize, 0usize);
        let (width, inside) = (self.width(), self.mask.inside());
        for pixel in self.mask.pixels() {
            if pixel % width + 1 < width && inside[pixel + 1] {
                all += 1;
                torn += usize::from(self.breaks[pixel].right);
            }
            if inside.get(pixel + width) == Some(&true) {
                all += 1;
                torn += usize::from(self.breaks[pixel].below);
            }
        }
        torn as f32 / all.max(1) as f32
    }

    /// Lowest and highest height; zeros for an empty map.
    pub fn range(&self) -> (f32, f32) {
        let pixels = self.mask.pixels();
        let heights = pixels.iter().map(|&pixel| self.heights[pixel]);
        let (low, high) = heights.fold((f32::MAX, f32::MIN), |(low, high), height| {
            (low.min(height), high.max(height))
        });
        if low > high { (0.0, 0.0) } else { (low, high) }
    }

    /// Where the middle of a pixel lies: x right, y up, z to the camera, in pixels, from the middle of
    /// the map. A perspective camera stands at z = focal length.
    pub fn position(&self, pixel: usize) -> Vec3 {
        let height = self.heights[pixel];
        let offset = centred(pixel, self.width(), self.height());
        let scale = match self.projection {
            Projection::Orthographic => 1.0,
            Projection::Perspective { focal } => (focal - height) / focal,
        };
        Vec3::new(offset[0] * scale, offset[1] * scale, height)
    }

    /// The same map with other heights, in the same order; zero is kept outside the mask.
    pub(crate) fn with_heights(mut self, heights: Vec<f32>) -> Self {
        assert_eq!(heights.len(), self.heights.len());
        self.heights = heights;
        for (height, &inside) in self.heights.iter_mut().zip(self.mask.inside()) {
            if !inside {
                *height = 0.0;
            }
        }
        self
    }
}

/// The middle of a pixel from the middle of a map: right and up, in pixels.
pub(super) fn centred(pixel: usize, width: usize, height: usize) -> [f32; 2] {
    let (column, row) = ((pixel % width) as f32, (pixel / width) as f32);
    [
        column + 0.5 - width as f32 / 2.0,
        height as f32 / 2.0 - row - 0.5,
    ]
}
