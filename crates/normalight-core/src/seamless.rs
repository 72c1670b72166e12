use crate::CoreError;

/// How maps are made to repeat without seams: what lies within the margin at their right and lower edge is
/// faded into the left and upper edge, and cut off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seamless {
    width: usize,
    height: usize,
    margin: [usize; 2],
}

impl Seamless {
    /// For maps of this size, with a margin of an eighth of each side.
    ///
    /// # Errors
    /// [`CoreError::TooSmall`] below 16 pixels.
    pub fn new(width: usize, height: usize) -> Result<Self, CoreError> {
        const LEAST: usize = 16;
        if width.min(height) < LEAST {
            return Err(CoreError::TooSmall {
                name: "a map that shall repeat".to_owned(),
                width,
                height,
                expected: LEAST,
            });
        }
        Ok(Self {
            width,
            height,
            margin: [width / 8, height / 8],
        })
    }

    /// Width and height of what is left.
    pub fn size(&self) -> [usize; 2] {
        [self.width - self.margin[0], self.height - self.margin[1]]
    }

    /// One map whose left edge continues its right edge, and whose upper edge its lower.
    ///
    /// # Panics
    /// `map` has not width * height entries.
    pub fn of<T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>>(
        &self,
        map: &[T],
    ) -> Vec<T> {
        assert_eq!(map.len(), self.width * self.height);
        let [width, height] = self.size();
        let across = |x: usize, y: usize| {
            let at = |x: usize| map[y * self.width + x];
            match fade(x, self.margin[0]) {
                Some(own) => at(x) * own + at(x + width) * (1.0 - own),
                None => at(x),
            }
        };
        let mut out = Vec::with_capacity(width * height);
        for y in 0..height {
            for x in 0..width {
                out.push(match fade(y, self.margin[1]) {
                    Some(own) => across(x, y) * own + across(x, y + height) * (1.0 - own),
                    None => across(x, y),
                });
            }
        }
        out
    }
}

/// The weight of a map's own beginning, which rises from 0 to 1 over the margin.
fn fade(at: usize, margin: usize) -> Option<f32> {
    (at < margin).then(|| {
        let share = (at as f32 + 0.5) / margin as f32;
        share * share * (3.0 - 2.0 * share)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rising map jumps at its seam; the seamless one moves no faster there than anywhere in the margin.
    #[test]
    fn opposite_edges_continue_each_other() {
        let (width, height) = (64, 48);
        let seamless = Seamless::new(width, height).unwrap();
        let map: Vec<f32> = (0..width * height)
            .map(|pixel| (pixel % width) as f32 + 2.0 * (pixel / width) as f32)
            .collect();
        let made = seamless.of(&map);
        let [wide, high] = seamless.size();
        assert_eq!((made.len(), wide, high), (56 * 42, 56, 42));
        let at = |x: usize, y: usize| made[(y % high) * wide + x % wide];
        // 56 over a margin of 8, and 84 over one of 6; a smooth step is at most 1.5 times as steep.
        for y in 0..high {
            for x in 0..wide {
                assert!((at(x + 1, y) - at(x, y)).abs() < 1.5 * 56.0 / 8.0 + 1.0);
                assert!((at(x, y + 1) - at(x, y)).abs() < 1.5 * 84.0 / 6.0 + 2.0);
            }
        }
        // Beyond the margin nothing changes.
        assert_eq!(at(20, 30), map[30 * width + 20]);
        let periodic: Vec<f32> = (0..width * height)
            .map(|pixel| (pixel % 8) as f32)
            .collect();
        let same = seamless.of(&periodic);
        assert!(
            (0..wide * high).all(|pixel| (same[pixel] - (pixel % wide % 8) as f32).abs() < 1e-5)
        );
        assert!(Seamless::new(15, 99).is_err());
    }
}
