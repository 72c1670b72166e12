//! Smaller objects, for a search over architectures.
use super::PublishedObject;
use crate::IoError;
use normalight_core::{
    ImageStack, Light, Mask, NormalMap, Rect, Samples, StackImage, Transfer, Vec3,
};

impl PublishedObject {
    /// The object in a square of `side` pixels.
    ///
    /// Each new pixel stands for an area of the old ones; it belongs to the object when at least
    /// half of its area does. Images and normals are averaged over the object's share of that area,
    /// so that no background gets in; normals are brought to unit length again. Images become
    /// floating-point, zero outside the mask.
    ///
    /// # Errors
    /// [`IoError::SetFormat`] when the object is not square or smaller than asked;
    /// [`IoError::Core`] when nothing of the object is left, or `side` is too small.
    pub fn resized(&self, side: usize) -> Result<Self, IoError> {
        let (width, height) = (self.stack.width(), self.stack.height());
        if width != height || width < side {
            return Err(IoError::SetFormat {
                name: self.entry.to_string(),
                found: format!("{width}x{height} pixels"),
                expected: format!("a square of at least {side}x{side}"),
            });
        }
        let areas = areas(&self.mask, side);
        let inside = areas.iter().map(|area| !area.is_empty()).collect();
        let mask = Mask::new(side, side, inside);
        let old = self.normals.normals();
        let normal = |area: &Area| area.iter().map(|&(pixel, share)| old[pixel] * share).sum();
        let normals: Vec<Vec3> = areas.iter().map(normal).collect();
        let mut planes = vec![0.0; 3 * width * height];
        let whole = Rect::whole(width, height);
        let images = self.stack.images().iter().enumerate();
        let images = images.map(|(index, image)| {
            self.stack.linear_tile(index, whole, &mut planes);
            StackImage {
                name: image.name.clone(),
                width: side,
                height: side,
                channels: image.channels,
                samples: Samples::F32(averages(&planes, image.channels, &areas)),
                transfer: Transfer::Linear,
            }
        });
        let stack = ImageStack::new(images.collect())?;
        stack.check_mask(&mask, &self.entry.to_string())?;
        let lights: Vec<Light> = self.lights.clone();
        Ok(Self {
            entry: self.entry.clone(),
            stack,
            mask,
            normals: NormalMap::new(side, side, normals),
            lights,
        })
    }
}

/// The object's pixels below a new pixel, with shares that sum to 1; empty outside the new mask.
type Area = Vec<(usize, f32)>;

fn areas(mask: &Mask, side: usize) -> Vec<Area> {
    let spans = spans(mask.width(), side);
    let rows = spans
        .iter()
        .flat_map(|rows| spans.iter().map(move |columns| (rows, columns)));
    rows.map(|(rows, columns)| {
        let pixels = rows.iter().flat_map(|&(y, high)| {
            columns
                .iter()
                .map(move |&(x, wide)| (y * mask.width() + x, high * wide))
        });
        let kept: Vec<(usize, usize)> = pixels.filter(|&(pixel, _)| mask.inside()[pixel]).collect();
        let sum: usize = kept.iter().map(|&(_, area)| area).sum();
        // In the units of the spans, a whole new pixel is as long as the old picture.
        if 2 * sum < mask.width() * mask.width() {
            return Area::new();
        }
        let share = |(pixel, area)| (pixel, area as f32 / sum as f32);
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
}
