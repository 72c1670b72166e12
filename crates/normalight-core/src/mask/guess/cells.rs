//! Squares of pixels, and the light that the photographs show in them.
use crate::{ImageStack, on_all_cores};

/// Samples along each side of a large cell: enough against noise and the camera's mosaic, and few
/// enough that large photographs need not be read whole.
const POINTS: usize = 3;
/// Cells that one core looks at, one image after the other.
pub(super) const PART: usize = 4096;

/// The frame in square cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Side of a cell in pixels.
    pub(super) step: usize,
    /// Cells in a row.
    pub(super) width: usize,
    /// Rows of cells.
    pub(super) height: usize,
    frame: [usize; 2],
}

impl Grid {
    pub(super) fn new(width: usize, height: usize, step: usize) -> Self {
        Self {
            step,
            width: width.div_ceil(step),
            height: height.div_ceil(step),
            frame: [width, height],
        }
    }

    /// Number of cells.
    pub(super) fn len(&self) -> usize {
        self.width * self.height
    }

    /// Centre of a cell in the frame, -1..=1 along each side.
    pub(super) fn centre(&self, cell: usize) -> [f32; 2] {
        let along = |index: usize, side: usize| {
            2.0 * (index * self.step) as f32 / side as f32 + self.step as f32 / side as f32 - 1.0
        };
        [
            along(cell % self.width, self.frame[0]),
            along(cell / self.width, self.frame[1]),
        ]
    }

    /// The cell of another grid that holds the middle of a cell of this one.
    pub(super) fn parent(&self, cell: usize, other: &Self) -> usize {
        let within = |index: usize, side: usize| {
            (index * self.step + self.step / 2).min(side - 1) / other.step
        };
        let x = within(cell % self.width, self.frame[0]);
        let y = within(cell / self.width, self.frame[1]);
        y * other.width + x
    }

    /// Positions of the pixels that are looked at in a cell.
    fn pixels(&self, cell: usize) -> impl Iterator<Item = usize> {
        let points = self.points();
        let (step, [width, height]) = (self.step, self.frame);
        let (x, y) = (cell % self.width * step, cell / self.width * step);
        let offset = move |point: usize| (2 * point + 1) * step / (2 * points);
        (0..points * points).map(move |point| {
            let x = (x + offset(point % points)).min(width - 1);
            let y = (y + offset(point / points)).min(height - 1);
            y * width + x
        })
    }

    fn points(&self) -> usize {
        self.step.min(POINTS)
    }
}

/// The light of some cells.
pub(super) struct Cells {
    pub(super) grid: Grid,
    /// Their positions `y * grid.width + x`, ascending.
    pub(super) places: Vec<usize>,
    /// Number of images.
    pub(super) images: usize,
    /// Linear brightness, the mean of the colours: `[cells, images]`.
    pub(super) light: Vec<f32>,
    /// Mean linear RGB over the images.
    pub(super) colours: Vec<[f32; 3]>,
}

impl Cells {
    /// Looks at cells of a grid in some images of a stack.
    pub(super) fn new(
        stack: &ImageStack,
        images: &[usize],
        grid: Grid,
        places: Vec<usize>,
    ) -> Self {
        let (count, points) = (images.len(), grid.points() * grid.points());
        let parts: Vec<&[usize]> = places.chunks(PART).collect();
        let looked = on_all_cores(parts.len(), |part| {
            let cells = parts[part];
            let pixels: Vec<usize> = cells.iter().flat_map(|&cell| grid.pixels(cell)).collect();
            let mut samples = vec![[0.0; 3]; pixels.len()];
            let mut light = vec![0.0; cells.len() * count];
            let mut colours = vec![[0.0; 3]; cells.len()];
            for (k, &image) in images.iter().enumerate() {
                stack.linear_pixels(image, &pixels, &mut samples);
                for (cell, samples) in samples.chunks_exact(points).enumerate() {
                    for channel in 0..3 {
                        let sum: f32 = samples.iter().map(|sample| sample[channel]).sum();
                        let mean = sum / points as f32;
                        light[cell * count + k] += mean / 3.0;
                        colours[cell][channel] += mean / count as f32;
                    }
                }
            }
            (light, colours)
        });
        let (mut light, mut colours) = (Vec::new(), Vec::new());
        for (more_light, more_colours) in looked {
            light.extend(more_light);
            colours.extend(more_colours);
        }
        Self {
            grid,
            places,
            images: count,
            light,
            colours,
        }
    }

    /// Number of cells.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }

    /// The light of one cell in all images.
    pub(super) fn light(&self, cell: usize) -> &[f32] {
        &self.light[cell * self.images..(cell + 1) * self.images]
    }

    /// Pairs of cells side by side, by their indices here.
    pub(super) fn neighbours(&self) -> Vec<[usize; 2]> {
        let mut pairs = Vec::with_capacity(2 * self.len());
        let mut below = 0;
        for (index, &place) in self.places.iter().enumerate() {
            let right = index + 1;
            if place % self.grid.width + 1 < self.grid.width
                && self.places.get(right) == Some(&(place + 1))
            {
                pairs.push([index, right]);
            }
            while below < self.len() && self.places[below] < place + self.grid.width {
                below += 1;
            }
            if self.places.get(below) == Some(&(place + self.grid.width)) {
                pairs.push([index, below]);
            }
        }
        pairs
    }
}
