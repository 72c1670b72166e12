//! A mask from the photographs alone.
//!
//! The border of the frame shows the background. Each of its surfaces shades over the images in one
//! way whatever is printed on it ([`shading`]), so how a place shades, how bright it is and its colour
//! say which it is ([`evidence`]); neighbours agree unless something parts them ([`walk`]). That is
//! done in large cells first, then along the outline in ever smaller ones ([`segment`]).
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
    /// background, 0 to 1; where the frame cuts the object off nothing says so. 0 where the whole frame was taken.
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
    /// The object, told from its background where no mask is given: by how both shade as the lamp
    /// moves, by brightness and by colour. It may lie before a dark, grey, bright or printed
    /// background, lit by the lamp or by the room, with cast shadows. Holes are filled, parts of less
    /// than a tenth of the largest dropped. Where no object can be told from a background, as in a
    /// relief that fills the frame, the whole frame is taken.
    ///
    /// Mean intersection over union with the true mask of ten rendered objects with cast shadows, 12
    /// images of 384 x 384 pixels each, beside that of a threshold on the brightest value (Otsu):
    ///
    /// | background | this | threshold |
    /// | --- | --- | --- |
    /// | black | 0.98 | 0.99 |
    /// | dark grey | 0.94 | 0.97 |
    /// | grey, as bright as the object | 0.96 | 0.47 |
    /// | bright | 0.96 | 0.15 |
    /// | printed wall | 0.96 | 0.36 |
    /// | printed wall, lamps as near as the frame is wide | 0.77 | 0.31 |
    /// | printed table | 0.93 | 0.32 |
    /// | lit by the room alone | 0.98 | 0.69 |
    ///
    /// It errs where a cast shadow lies in nearly all images, on mirrors, and where the light of near
    /// lamps changes faster over the frame than a polynomial of second degree; [`MaskGuess::certainty`]
    /// is low in most such cases.
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
