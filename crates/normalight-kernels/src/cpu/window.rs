//! Rectangles of an image that may reach beyond it: copied out with zeros around, and added back.
use crate::cpu::geometry::Geometry;
use std::ops::Range;

/// Rows and columns of the (zoomed) input that a computation sees.
#[derive(Clone, Copy)]
pub(crate) struct Window {
    pub(crate) first_row: isize,
    pub(crate) rows: usize,
    pub(crate) first_column: isize,
    pub(crate) columns: usize,
}

impl Window {
    pub(crate) fn floats(&self, channels: usize) -> usize {
        self.rows * self.columns * channels
    }

    /// Window columns that lie inside an image of this width.
    fn inside(&self, width: usize) -> Range<usize> {
        let first = (-self.first_column).clamp(0, self.columns as isize) as usize;
        let end = (width as isize - self.first_column).clamp(0, self.columns as isize) as usize;
        first.min(end)..end
    }

    /// Row of the image behind a window's row, if there is one.
    fn row(&self, row: usize, height: usize) -> Option<usize> {
        let row = self.first_row + row as isize;
        (0..height as isize).contains(&row).then_some(row as usize)
    }
}

/// Copies what the window sees of an image; zero outside.
///
/// # Shapes
/// - image: `[stored height, stored width, channels]`
/// - out: `[rows, columns, channels]` of the window
pub(crate) fn copy_window(geometry: &Geometry, window: Window, image: &[f32], out: &mut [f32]) {
    let channels = geometry.channels_in;
    let inside = window.inside(geometry.width());
    let stride = geometry.stored_width * channels;
    let out = out.chunks_exact_mut(window.columns * channels);
    for (row, line) in out.take(window.rows).enumerate() {
        let Some(y) = window.row(row, geometry.height()) else {
            line.fill(0.0);
            continue;
        };
        let source = &image[y / geometry.zoom * stride..][..stride];
        let (start, end) = (inside.start * channels, inside.end * channels);
        line[..start].fill(0.0);
        line[end..].fill(0.0);
        let target = &mut line[start..end];
        let first = (window.first_column + inside.start as isize) as usize;
        if geometry.zoom == 1 {
            let from = first * channels;
            target.copy_from_slice(&source[from..from + target.len()]);
        } else {
            for (x, pixel) in target.chunks_exact_mut(channels).enumerate() {
                let from = (first + x) / geometry.zoom * channels;
                pixel.copy_from_slice(&source[from..from + channels]);
            }
        }
    }
}

/// The transpose of [`copy_window`]: adds every value to the pixel that it was copied from.
pub(crate) fn add_window(geometry: &Geometry, window: Window, values: &[f32], image: &mut [f32]) {
    let channels = geometry.channels_in;
    let inside = window.inside(geometry.width());
    let stride = geometry.stored_width * channels;
    let lines = values.chunks_exact(window.columns * channels);
    pulp::Arch::new().dispatch(|| {
        for (row, line) in lines.take(window.rows).enumerate() {
            let Some(y) = window.row(row, geometry.height()) else {
                continue;
            };
            let target = &mut image[y / geometry.zoom * stride..][..stride];
            let source = &line[inside.start * channels..inside.end * channels];
            let first = (window.first_column + inside.start as isize) as usize;
            if geometry.zoom == 1 {
                add(&mut target[first * channels..], source);
            } else {
                for (x, pixel) in source.chunks_exact(channels).enumerate() {
                    let to = (first + x) / geometry.zoom * channels;
                    add(&mut target[to..to + channels], pixel);
                }
            }
        }
    });
}

#[inline(always)]
pub(crate) fn add(target: &mut [f32], source: &[f32]) {
    for (sum, value) in target.iter_mut().zip(source) {
        *sum += value;
    }
}
