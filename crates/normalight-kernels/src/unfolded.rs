use crate::geometry::Geometry;
use std::ops::Range;

/// Copies what each output pixel of some rows sees: `[taps, rows * out_width]`, zero outside.
pub(crate) fn unfold(geometry: &Geometry, image: &[f32], rows: Range<usize>, out: &mut [f32]) {
    let width = geometry.out_width();
    for_each_line(geometry, rows, |line| {
        let target = &mut out[line.unfolded..line.unfolded + width];
        let Some(start) = line.source else {
            target.fill(0.0);
            return;
        };
        let Range { start: first, end } = line.columns;
        target[..first].fill(0.0);
        target[end..].fill(0.0);
        let source = &image[start..];
        if geometry.stride == 1 {
            target[first..end].copy_from_slice(&source[..end - first]);
        } else {
            let source = source.iter().step_by(geometry.stride);
            for (value, source) in target[first..end].iter_mut().zip(source) {
                *value = *source;
            }
        }
    });
}

/// The transpose of [`unfold`]: adds every value back to the pixel it was copied from.
pub(crate) fn fold(geometry: &Geometry, unfolded: &[f32], rows: Range<usize>, image: &mut [f32]) {
    for_each_line(geometry, rows, |line| {
        let Some(start) = line.source else { return };
        let Range { start: first, end } = line.columns;
        let source = &unfolded[line.unfolded + first..line.unfolded + end];
        let target = &mut image[start..];
        if geometry.stride == 1 {
            for (value, source) in target.iter_mut().zip(source) {
                *value += source;
            }
        } else {
            let target = target.iter_mut().step_by(geometry.stride);
            for (value, source) in target.zip(source) {
                *value += source;
            }
        }
    });
}

/// One row of output pixels seen through one tap.
struct Line {
    /// Where it starts in the unfolded block.
    unfolded: usize,
    /// Where its first inside pixel is in the image; `None` when the whole line lies outside.
    source: Option<usize>,
    /// Output columns that lie inside.
    columns: Range<usize>,
}

fn for_each_line(geometry: &Geometry, rows: Range<usize>, mut visit: impl FnMut(Line)) {
    let width = geometry.out_width();
    let padding = (geometry.size / 2) as isize;
    let mut unfolded = 0;
    for channel in 0..geometry.channels_in {
        for tap_y in 0..geometry.size {
            for tap_x in 0..geometry.size {
                let shift = tap_x as isize - padding;
                let columns = geometry.columns(shift);
                for row in rows.clone() {
                    let y = (row * geometry.stride) as isize + tap_y as isize - padding;
                    let inside = (0..geometry.height as isize).contains(&y) && !columns.is_empty();
                    let source = inside.then(|| {
                        let x = (columns.start * geometry.stride) as isize + shift;
                        (channel * geometry.height + y as usize) * geometry.width + x as usize
                    });
                    visit(Line {
                        unfolded,
                        source,
                        columns: columns.clone(),
                    });
                    unfolded += width;
                }
            }
        }
    }
}
