mod guess;
mod nearest;

use crate::Rect;

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

    /// Positions of the pixels inside, row by row.
    pub fn pixels(&self) -> Vec<usize> {
        let all = 0..self.inside.len();
        all.filter(|&pixel| self.inside[pixel]).collect()
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
    pub(crate) fn components(&self, value: bool) -> (Vec<usize>, Vec<usize>) {
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
}
