use super::Mask;
use std::collections::VecDeque;

impl Mask {
    /// For every pixel one of the nearest pixels inside (counted in steps to the side and up or down), which
    /// is itself for those inside; `None` for an empty mask. What is painted outside an object is taken from
    /// there, so that smaller copies of an image do not mix its edge with a foreign colour.
    ///
    /// # Shapes
    /// `[height, width]`, rows from the top.
    pub fn nearest_inside(&self) -> Option<Vec<u32>> {
        const UNKNOWN: u32 = u32::MAX;
        let (width, height) = (self.width, self.height);
        let mut nearest = vec![UNKNOWN; self.inside.len()];
        let mut front = VecDeque::new();
        for pixel in self.pixels() {
            nearest[pixel] = pixel as u32;
            front.push_back(pixel);
        }
        if front.is_empty() {
            return None;
        }
        while let Some(pixel) = front.pop_front() {
            let (x, y) = (pixel % width, pixel / width);
            let neighbours = [
                (x > 0).then(|| pixel - 1),
                (x + 1 < width).then_some(pixel + 1),
                (y > 0).then(|| pixel - width),
                (y + 1 < height).then_some(pixel + width),
            ];
            for next in neighbours.into_iter().flatten() {
                if nearest[next] == UNKNOWN {
                    nearest[next] = nearest[pixel];
                    front.push_back(next);
                }
            }
        }
        Some(nearest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_is_as_near_as_by_trying_all() {
        let (width, height) = (23, 17);
        let inside: Vec<bool> = (0..width * height).map(|k| k * k % 31 == 4).collect();
        let mask = Mask::new(width, height, inside);
        let steps = |one: usize, other: usize| {
            (one % width).abs_diff(other % width) + (one / width).abs_diff(other / width)
        };
        let nearest = mask.nearest_inside().unwrap();
        for (pixel, &found) in nearest.iter().enumerate() {
            assert!(mask.inside()[found as usize]);
            let least = mask
                .pixels()
                .into_iter()
                .map(|other| steps(pixel, other))
                .min();
            assert_eq!(Some(steps(pixel, found as usize)), least);
        }
        assert_eq!(Mask::new(3, 1, vec![false; 3]).nearest_inside(), None);
    }
}
