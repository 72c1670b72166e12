//! A mask from the photographs alone.
mod cells;
mod evidence;
mod segment;
mod shading;
mod walk;

use super::Mask;
use crate::{ImageStack, evenly_spaced_indices};
use cells::{Cells, Grid};
use segment::Segmentation;

/// Most images that are looked at.
const IMAGES: usize = 40;
/// Cells along the frame's longer side in the first look.
const SIDE: usize = 256;
/// How much finer each further look is.
const FINER: usize = 4;
/// Less certainty than this, and the whole frame is taken.
const DOUBTFUL: f32 = 0.5;

/// A mask that nobody gave, and how far to trust it.
#[derive(Debug, Clone, PartialEq)]
pub struct MaskGuess {
    /// The pixels taken for the object; the whole frame where no object was told from a background.
    pub mask: Mask,
    /// Share of the object's outline on whose two sides the photographs themselves say object and
    /// background, 0 to 1; 0 where the whole frame was taken.
    pub certainty: f32,
}

impl MaskGuess {
    /// Whether no object was told from a background.
    pub fn is_whole_frame(&self) -> bool {
        self.certainty == 0.0
    }

    fn whole(stack: &ImageStack) -> Self {
        Self {
            mask: Mask::whole(stack.width(), stack.height()),
            certainty: 0.0,
        }
    }
}

impl Mask {
    /// The object, told from its background where no mask is given.
    pub fn guess(stack: &ImageStack) -> MaskGuess {
        let images = evenly_spaced_indices(stack.len(), IMAGES);
        let (width, height) = (stack.width(), stack.height());
        let mut step = width.max(height).div_ceil(SIDE);
        let grid = Grid::new(width, height, step);
        let cells = Cells::new(stack, &images, grid, (0..grid.len()).collect());
        let Some((mut segmentation, certainty)) = Segmentation::new(&cells) else {
            return MaskGuess::whole(stack);
        };
        if certainty < DOUBTFUL {
            return MaskGuess::whole(stack);
        }
        while step > 1 {
            step = step.div_ceil(FINER);
            let grid = Grid::new(width, height, step);
            let (band, known) = segmentation.band(grid);
            let cells = Cells::new(stack, &images, grid, band);
            segmentation.refine(&cells, &known);
        }
        MaskGuess {
            mask: segmentation.into_mask(),
            certainty,
        }
    }
}
