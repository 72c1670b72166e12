//! Surfaces behind each other at one pixel.

/// What a ray of the camera passes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layer {
    pub(super) pixel: u32,
    pub(super) depth: f32,
    /// Whether the outside is towards the camera.
    pub(super) facing: bool,
}

/// Depth at which each pixel's ray leaves what it enters at its first layer: where as many layers face one
/// way as the other, which for solids within each other is the end of all. An open sheet has no such
/// place: its far side is its near side.
///
/// Negative infinity where nothing is. `[area]`
pub(super) fn far_side(layers: Vec<Layer>, area: usize) -> Vec<f32> {
    // Sorted by pixel by counting.
    let mut ends = vec![0u32; area + 1];
    for layer in &layers {
        ends[layer.pixel as usize + 1] += 1;
    }
    for pixel in 0..area {
        ends[pixel + 1] += ends[pixel];
    }
    let mut sorted = vec![(0.0f32, false); layers.len()];
    let mut next = ends.clone();
    for layer in &layers {
        let place = &mut next[layer.pixel as usize];
        sorted[*place as usize] = (layer.depth, layer.facing);
        *place += 1;
    }
    let of_pixel = |pixel: usize| ends[pixel] as usize..ends[pixel + 1] as usize;
    (0..area)
        .map(|pixel| leaves(&mut sorted[of_pixel(pixel)]))
        .collect()
}

fn leaves(layers: &mut [(f32, bool)]) -> f32 {
    layers.sort_unstable_by(|one, other| other.0.total_cmp(&one.0));
    let Some(&(near, outside)) = layers.first() else {
        return f32::NEG_INFINITY;
    };
    let mut entered = 0;
    let mut before = None;
    for &layer in layers.iter() {
        // A ray through the side of two triangles meets both.
        if before == Some(layer) {
            continue;
        }
        before = Some(layer);
        entered += if layer.1 == outside { 1 } else { -1 };
        if entered == 0 {
            return layer.0;
        }
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_end_where_the_last_one_does_and_sheets_where_they_begin() {
        let far = |layers: &[(f32, bool)]| {
            let layers = layers.iter().map(|&(depth, facing)| Layer {
                pixel: 1,
                depth,
                facing,
            });
            far_side(layers.collect(), 3)
        };
        let none = f32::NEG_INFINITY;
        // A solid, in any order; one in front of another; one within another; either turned inside out.
        assert_eq!(far(&[(1.0, false), (2.0, true)]), [none, 1.0, none]);
        let row = [(1.0, false), (4.0, true), (2.0, true), (3.0, false)];
        assert_eq!(far(&row)[1], 3.0);
        let nested = [(1.0, false), (4.0, true), (2.0, false), (3.0, true)];
        assert_eq!(far(&nested)[1], 1.0);
        assert_eq!(far(&[(1.0, true), (2.0, false)])[1], 1.0);
        // A sheet, alone and over another; the side of two triangles of one.
        assert_eq!(far(&[(2.0, true)])[1], 2.0);
        assert_eq!(far(&[(2.0, true), (1.0, true)])[1], 2.0);
        assert_eq!(far(&[(2.0, true), (2.0, true), (1.0, false)])[1], 1.0);
    }
}
