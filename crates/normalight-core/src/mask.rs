mod guess;
mod nearest;

pub use guess::MaskGuess;

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

    /// Without the parts (pixels that touch side by side) that are smaller than a share of the largest.
    pub fn without_small_parts(&self, share: f32) -> Self {
        let (labels, sizes) = self.components(true);
        let largest = sizes[1..].iter().copied().max().unwrap_or(0);
        let inside = labels
            .iter()
            .map(|&label| label != 0 && sizes[label as usize] as f32 >= share * largest as f32)
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
                open[label as usize] = true;
            }
        }
        let inside = labels
            .iter()
            .map(|&label| label == 0 || !open[label as usize])
            .collect();
        Self::new(self.width, self.height, inside)
    }

    /// Labels the 4-connected parts whose flag is `value` from 1 upwards, other pixels get 0; with
    /// the size of each part.
    pub(crate) fn components(&self, value: bool) -> (Vec<u32>, Vec<usize>) {
        let mut labels = vec![0; self.inside.len()];
        let mut sizes = vec![0];
        let mut stack = Vec::new();
        for start in 0..self.inside.len() {
            if self.inside[start] != value || labels[start] != 0 {
                continue;
            }
            let label = sizes.len() as u32;
            sizes.push(0);
            labels[start] = label;
            stack.push(start);
            while let Some(index) = stack.pop() {
                sizes[label as usize] += 1;
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
            .without_small_parts(1.0)
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
        assert_eq!(mask(&["...", "..."]).without_small_parts(1.0).count(), 0);
    }
}
