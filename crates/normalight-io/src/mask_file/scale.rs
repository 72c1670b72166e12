//! Masks that were drawn on a smaller or larger copy of the photographs.
use normalight_core::Mask;

/// The mask at another size; `None` where the shapes of the frames differ by more than the rounding
/// of their sides. A pixel is inside where at least half of what it covers is.
pub(super) fn scaled(mask: &Mask, [width, height]: [usize; 2]) -> Option<Mask> {
    let (own_width, own_height) = (mask.width(), mask.height());
    // By less than a pixel of the coarser one.
    let difference = (own_height * width).abs_diff(height * own_width);
    if difference >= width.max(own_width) {
        return None;
    }
    let covered = |place: usize, side: usize, own: usize| {
        let first = place * own / side;
        first..((place + 1) * own / side).max(first + 1)
    };
    let mut inside = Vec::with_capacity(width * height);
    for y in 0..height {
        let rows = covered(y, height, own_height);
        for x in 0..width {
            let columns = covered(x, width, own_width);
            let all = rows.len() * columns.len();
            let lit: usize = rows
                .clone()
                .map(|row| {
                    let row = &mask.inside()[row * own_width..(row + 1) * own_width];
                    row[columns.clone()]
                        .iter()
                        .filter(|&&inside| inside)
                        .count()
                })
                .sum();
            inside.push(2 * lit >= all);
        }
    }
    Some(Mask::new(width, height, inside))
}
