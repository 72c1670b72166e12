//! Small pictures of a stack's shots.
use crate::{ImageStack, Rect, luminance};

/// Most pixels of a shot that are looked at for one pixel of a small picture, along each axis:
/// bounds the time for large photographs.
const SAMPLES: usize = 4;

/// Which part of the frame is looked at, and how many pixels make one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct View {
    pub(super) area: Rect,
    pub(super) step: usize,
}

/// Linear light, `[height, width]`.
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) light: Vec<f32>,
}

impl View {
    pub(super) fn width(&self) -> usize {
        self.area.width / self.step
    }

    pub(super) fn height(&self) -> usize {
        self.area.height / self.step
    }

    /// One shot, with what is `offset` pixels (right, down) from a place shown at the place; beyond
    /// the frame its border is repeated.
    pub(super) fn of(&self, stack: &ImageStack, shot: usize, offset: [i64; 2]) -> Picture {
        let columns = places(
            self.area.x,
            self.width(),
            self.step,
            (offset[0], stack.width()),
        );
        let rows = places(
            self.area.y,
            self.height(),
            self.step,
            (offset[1], stack.height()),
        );
        let per_cell = columns.len() / self.width();
        let mut light = vec![0.0; self.width() * self.height()];
        let mut pixels = vec![0; columns.len()];
        let mut colours = vec![[0.0; 3]; columns.len()];
        for (index, row) in rows.iter().enumerate() {
            for (pixel, column) in pixels.iter_mut().zip(&columns) {
                *pixel = row * stack.width() + column;
            }
            stack.linear_pixels(shot, &pixels, &mut colours);
            let line = index / (rows.len() / self.height()) * self.width();
            for (x, cell) in colours.chunks_exact(per_cell).enumerate() {
                light[line + x] += cell.iter().map(|&rgb| luminance(rgb)).sum::<f32>();
            }
        }
        let taken = (per_cell * (rows.len() / self.height())) as f32;
        light.iter_mut().for_each(|sum| *sum /= taken);
        Picture {
            width: self.width(),
            height: self.height(),
            light,
        }
    }
}

/// Coordinates that are looked at along one axis: the same number for each of `cells`.
fn places(start: usize, cells: usize, step: usize, (offset, size): (i64, usize)) -> Vec<usize> {
    let count = step.min(SAMPLES);
    let all = (0..cells).flat_map(|cell| {
        (0..count).map(move |sample| start + cell * step + (2 * sample + 1) * step / (2 * count))
    });
    let last = size as i64 - 1;
    all.map(|place| (place as i64 + offset).clamp(0, last) as usize)
        .collect()
}
