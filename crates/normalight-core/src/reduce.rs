//! The same object in fewer pixels.
use crate::{CoreError, ImageStack, Mask, NormalMap, Rect, Samples, StackImage, Transfer};
use glam::Vec3;

/// An object with its normals in fewer pixels, see [`reduced`].
#[derive(Debug, Clone)]
pub struct Reduced {
    /// The photographs: floating-point, zero outside the mask.
    pub stack: ImageStack,
    /// Pixels at least half of whose area belongs to the object.
    pub mask: Mask,
    /// Normals of unit length, zero outside the mask.
    pub normals: NormalMap,
}

/// A part of the photographs of an object, and its normals, in `[width, height]` pixels.
///
/// Each new pixel stands for an area of the old ones; it belongs to the object when at least half of its area does.
/// Images and normals are averaged over the object's share of that area, so that no background gets in; normals are
/// brought to unit length again.
///
/// # Errors
/// Those of [`ImageStack::check_mask`] for what goes in and what comes out, so also when nothing of the object is left;
/// [`CoreError::MapSize`] for normals of another size; those of [`ImageStack::new`], for too few new pixels.
///
/// # Panics
/// `part` reaches beyond the photographs: a mistake of the caller.
pub fn reduced(
    stack: &ImageStack,
    mask: &Mask,
    normals: &NormalMap,
    part: Rect,
    [width, height]: [usize; 2],
) -> Result<Reduced, CoreError> {
    stack.check_mask(mask, "mask")?;
    let normals = normals.clone().masked(mask)?;
    let areas = areas(mask, part, [width, height]);
    let inside = areas.iter().map(|area| !area.is_empty()).collect();
    let place = |at: usize| (part.y + at / part.width) * mask.width() + part.x + at % part.width;
    let normal = |area: &Area| -> Vec3 {
        let shares = area.iter();
        shares
            .map(|&(at, share)| normals.normals()[place(at)] * share)
            .sum()
    };
    let reduced: Vec<Vec3> = areas.iter().map(normal).collect();
    let mask = Mask::new(width, height, inside);
    let mut planes = vec![0.0; 3 * part.area()];
    let images = stack.images().iter().enumerate();
    let images = images.map(|(index, image)| {
        stack.linear_tile(index, part, &mut planes);
        StackImage {
            name: image.name.clone(),
            width,
            height,
            channels: image.channels,
            samples: Samples::F32(averages(&planes, image.channels, &areas)),
            transfer: Transfer::Linear,
        }
    });
    let stack = ImageStack::new(images.collect())?;
    stack.check_mask(&mask, "mask")?;
    Ok(Reduced {
        stack,
        mask,
        normals: NormalMap::new(width, height, reduced),
    })
}

/// The object's pixels below a new pixel, as positions in the part, with shares that sum to 1; empty outside the new mask.
type Area = Vec<(usize, f32)>;

fn areas(mask: &Mask, part: Rect, [width, height]: [usize; 2]) -> Vec<Area> {
    let (columns, rows) = (spans(part.width, width), spans(part.height, height));
    let inside = |x: usize, y: usize| mask.inside()[(part.y + y) * mask.width() + part.x + x];
    let pixels = rows
        .iter()
        .flat_map(|rows| columns.iter().map(move |columns| (rows, columns)));
    pixels
        .map(|(rows, columns)| {
            let below = rows
                .iter()
                .flat_map(|&(y, high)| columns.iter().map(move |&(x, wide)| (x, y, high * wide)));
            let kept: Vec<(usize, usize)> = below
                .filter(|&(x, y, _)| inside(x, y))
                .map(|(x, y, area)| (y * part.width + x, area))
                .collect();
            let sum: usize = kept.iter().map(|&(_, area)| area).sum();
            // In the units of the spans, a whole new pixel is as large as the old part.
            if 2 * sum < part.area() {
                return Area::new();
            }
            let share = |(at, area)| (at, area as f32 / sum as f32);
            kept.into_iter().map(share).collect()
        })
        .collect()
}

/// The old places below each of `side` new ones with their lengths, in units of a `side`-th.
fn spans(long: usize, side: usize) -> Vec<Vec<(usize, usize)>> {
    let span = |new: usize| {
        let (start, end) = (new * long, (new + 1) * long);
        let places = start / side..end.div_ceil(side);
        places
            .map(|old| (old, ((old + 1) * side).min(end) - (old * side).max(start)))
            .collect()
    };
    (0..side).map(span).collect()
}

/// # Shapes
/// `planes`: `[3, height, width]`; result: `[areas, channels]`.
fn averages(planes: &[f32], channels: usize, areas: &[Area]) -> Vec<f32> {
    let planes: Vec<&[f32]> = planes
        .chunks_exact(planes.len() / 3)
        .take(channels)
        .collect();
    let average = |area: &Area, plane: &[f32]| -> f32 {
        area.iter()
            .map(|&(pixel, share)| plane[pixel] * share)
            .sum()
    };
    areas
        .iter()
        .flat_map(|area| planes.iter().map(move |plane| average(area, plane)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_cover_everything_once() {
        assert_eq!(spans(4, 2), [vec![(0, 2), (1, 2)], vec![(2, 2), (3, 2)]]);
        assert_eq!(spans(3, 2), [vec![(0, 2), (1, 1)], vec![(1, 1), (2, 2)]]);
        for (long, side) in [(128, 64), (100, 64), (65, 64), (64, 64), (5, 4)] {
            let spans = spans(long, side);
            let mut covered = vec![0; long];
            for span in &spans {
                assert_eq!(span.iter().map(|&(_, part)| part).sum::<usize>(), long);
                span.iter().for_each(|&(old, part)| covered[old] += part);
            }
            assert!(covered.iter().all(|&sum| sum == side));
        }
    }

    #[test]
    fn a_part_is_averaged_over_the_object_alone() {
        // 6 x 4 pixels, of which the part is the right 4 x 4; one of its pixels is no object, and bright.
        let inside: Vec<bool> = (0..24).map(|pixel| pixel != 2).collect();
        let values = (0..24).map(|pixel| if pixel == 2 { 99.0 } else { pixel as f32 });
        let image = |name: &str| StackImage {
            name: name.to_owned(),
            width: 6,
            height: 4,
            channels: 1,
            samples: Samples::F32(values.clone().collect()),
            transfer: Transfer::Linear,
        };
        let stack = ImageStack::new(["a", "b", "c"].map(image).into()).unwrap();
        let normals = NormalMap::new(6, 4, vec![Vec3::Z; 24]);
        let mask = Mask::new(6, 4, inside);
        let part = Rect {
            x: 2,
            y: 0,
            width: 4,
            height: 4,
        };
        let same = reduced(&stack, &mask, &normals, part, [4, 4]).unwrap();
        assert_eq!(same.mask.count(), 15);
        let Samples::F32(found) = &same.stack.images()[0].samples else {
            panic!("floating-point")
        };
        assert_eq!((found[0], found[1], found[15]), (0.0, 3.0, 23.0));
        let wide = reduced(&stack, &mask, &normals, Rect::whole(6, 4), [4, 4]).unwrap();
        let Samples::F32(found) = &wide.stack.images()[0].samples else {
            panic!("floating-point")
        };
        // Each new pixel is one and a half old ones wide: the second is half of pixel 1 and pixel 2, which is no object.
        assert_eq!(wide.mask.count(), 15);
        let expected = [0.5 / 1.5, 0.0, (3.0 + 0.5 * 4.0) / 1.5];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-5, "{found}, not {expected}");
        }
        assert_eq!(wide.normals.normals()[0], Vec3::Z);
    }
}
