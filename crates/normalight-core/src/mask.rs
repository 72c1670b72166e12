use crate::{ImageStack, Rect};

/// Which pixels belong to the object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    width: usize,
    height: usize,
    inside: Vec<bool>,
}

/// Where a mask came from, to be told to the user.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MaskSource {
    /// A file, by name.
    File(String),
    /// The transparency of the first image.
    Alpha,
    /// Guessed from the brightest value over the images.
    Guessed,
    /// The whole frame, as asked.
    WholeFrame,
}

impl Mask {
    /// A mask from one flag per pixel, rows from the top.
    ///
    /// # Panics
    /// `inside` has not width * height entries.
    pub fn new(width: usize, height: usize, inside: Vec<bool>) -> Self {
        assert_eq!(inside.len(), width * height);
        Self {
            width,
            height,
            inside,
        }
    }

    /// Every pixel belongs to the object.
    pub fn whole(width: usize, height: usize) -> Self {
        Self::new(width, height, vec![true; width * height])
    }

    /// A first guess where no mask is given: pixels that some light brightens (Otsu's threshold on
    /// the square root of the brightest value over all images), the largest connected part of
    /// them, holes filled.
    ///
    /// The square root spreads the dark values, where object and background part.
    pub fn guess(stack: &ImageStack) -> Self {
        let roots: Vec<f32> = stack.brightest().iter().map(|value| value.sqrt()).collect();
        let threshold = otsu_threshold(&roots);
        let inside = roots.iter().map(|&value| value > threshold).collect();
        Self::new(stack.width(), stack.height(), inside)
            .largest_component()
            .holes_filled()
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// One flag per pixel, rows from the top.
    pub fn inside(&self) -> &[bool] {
        &self.inside
    }

    /// Number of pixels of the object.
    pub fn count(&self) -> usize {
        self.inside.iter().filter(|&&inside| inside).count()
    }

    /// Smallest rectangle around the object; `None` for an empty mask.
    pub fn bounding_box(&self) -> Option<Rect> {
        let (mut left, mut right) = (usize::MAX, 0);
        let (mut top, mut bottom) = (usize::MAX, 0);
        for (y, row) in self.inside.chunks_exact(self.width).enumerate() {
            let Some(first) = row.iter().position(|&inside| inside) else {
                continue;
            };
            let last = row.iter().rposition(|&inside| inside).unwrap_or(first);
            left = left.min(first);
            right = right.max(last);
            top = top.min(y);
            bottom = y;
        }
        (left != usize::MAX).then(|| Rect {
            x: left,
            y: top,
            width: right - left + 1,
            height: bottom - top + 1,
        })
    }

    /// Only the largest part whose pixels touch side by side.
    pub fn largest_component(&self) -> Self {
        let (labels, sizes) = self.components(true);
        let largest = (1..sizes.len()).max_by_key(|&label| sizes[label]);
        let inside = labels
            .iter()
            .map(|&label| Some(label) == largest && label != 0)
            .collect();
        Self::new(self.width, self.height, inside)
    }

    /// Outside regions that do not reach the frame's edge become inside.
    pub fn holes_filled(&self) -> Self {
        let (labels, sizes) = self.components(false);
        let mut open = vec![false; sizes.len()];
        for (index, &label) in labels.iter().enumerate() {
            let (x, y) = (index % self.width, index / self.width);
            if x == 0 || y == 0 || x + 1 == self.width || y + 1 == self.height {
                open[label] = true;
            }
        }
        let inside = labels
            .iter()
            .map(|&label| label == 0 || !open[label])
            .collect();
        Self::new(self.width, self.height, inside)
    }

    /// Labels the 4-connected parts whose flag is `value` from 1 upwards; other pixels get 0.
    fn components(&self, value: bool) -> (Vec<usize>, Vec<usize>) {
        let mut labels = vec![0; self.inside.len()];
        let mut sizes = vec![0];
        let mut stack = Vec::new();
        for start in 0..self.inside.len() {
            if self.inside[start] != value || labels[start] != 0 {
                continue;
            }
            let label = sizes.len();
            sizes.push(0);
            labels[start] = label;
            stack.push(start);
            while let Some(index) = stack.pop() {
                sizes[label] += 1;
                let (x, y) = (index % self.width, index / self.width);
                let neighbours = [
                    (x > 0).then(|| index - 1),
                    (x + 1 < self.width).then_some(index + 1),
                    (y > 0).then(|| index - self.width),
                    (y + 1 < self.height).then_some(index + self.width),
                ];
                for next in neighbours.into_iter().flatten() {
                    if self.inside[next] == value && labels[next] == 0 {
                        labels[next] = label;
                        stack.push(next);
                    }
                }
            }
        }
        (labels, sizes)
    }
}

/// Threshold that parts values best into two classes (Otsu 1979), on 256 bins of their range.
fn otsu_threshold(values: &[f32]) -> f32 {
    let (low, high) = values
        .iter()
        .fold((f32::MAX, f32::MIN), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
    if high <= low {
        // One value only: nothing to part, so everything lit counts as object.
        return if high > 0.0 { low - 1.0 } else { high };
    }
    let mut histogram = [0usize; 256];
    let scale = 255.0 / (high - low);
    for &value in values {
        histogram[((value - low) * scale) as usize] += 1;
    }
    let total = values.len() as f64;
    let sum: f64 = (0..256).map(|bin| bin as f64 * histogram[bin] as f64).sum();
    let (mut below, mut sum_below) = (0.0, 0.0);
    let (mut best_bin, mut best_spread) = (0, -1.0);
    for (bin, &count) in histogram.iter().enumerate().take(255) {
        below += count as f64;
        sum_below += bin as f64 * count as f64;
        let above = total - below;
        if below == 0.0 || above == 0.0 {
            continue;
        }
        let difference = sum_below / below - (sum - sum_below) / above;
        let spread = below * above * difference * difference;
        if spread > best_spread {
            (best_bin, best_spread) = (bin, spread);
        }
    }
    low + (best_bin as f32 + 1.0) / scale
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mask(rows: &[&str]) -> Mask {
        let inside = rows
            .iter()
            .flat_map(|row| row.bytes().map(|byte| byte == b'#'))
            .collect();
        Mask::new(rows[0].len(), rows.len(), inside)
    }

    #[test]
    fn largest_part_without_holes() {
        let found = mask(&["##....", "......", ".####.", ".#..#.", ".####.", ".....#"])
            .largest_component()
            .holes_filled();
        let expected = mask(&["......", "......", ".####.", ".####.", ".####.", "......"]);
        assert_eq!(found, expected);
        assert_eq!(
            found.bounding_box(),
            Some(Rect {
                x: 1,
                y: 2,
                width: 4,
                height: 3
            })
        );
        assert_eq!(mask(&["...", "..."]).bounding_box(), None);
        assert_eq!(mask(&["...", "..."]).largest_component().count(), 0);
    }

    #[test]
    fn otsu_parts_two_groups() {
        let mut values = vec![0.1; 700];
        values.extend(vec![0.8; 300]);
        let threshold = otsu_threshold(&values);
        assert!(threshold > 0.1 && threshold < 0.8, "{threshold}");
        assert!(otsu_threshold(&[0.0, 0.0]) >= 0.0);
        assert!(otsu_threshold(&[0.5, 0.5]) < 0.5);
    }
}
