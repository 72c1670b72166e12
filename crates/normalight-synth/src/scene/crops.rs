use crate::random::Random;
use crate::shapes::View;

/// Windows of a picture and how much of the object each shows.
pub(crate) struct Crops {
    side: usize,
    size: usize,
    /// Visible pixels above and left of each corner of the grid.
    ///
    /// `[side + 1, side + 1]`
    sums: Vec<u32>,
}

impl Crops {
    /// `size`: side of the windows in pixels, at most that of the picture.
    pub(crate) fn new(view: &View, size: usize) -> Self {
        let side = view.window.width;
        let stride = side + 1;
        let mut sums = vec![0; stride * stride];
        for row in 0..side {
            let mut along = 0;
            for column in 0..side {
                along += u32::from(view.is_inside(row * side + column));
                sums[(row + 1) * stride + column + 1] = sums[row * stride + column + 1] + along;
            }
        }
        Self { side, size, sums }
    }

    pub(crate) fn size(&self) -> usize {
        self.size
    }

    /// Largest share of a window that can be object.
    pub(crate) fn best_cover(&self) -> f32 {
        let (row, column) = self.best();
        self.cover(row, column)
    }

    /// A random window with at least `cover` of it object, or else the fullest one: (row, column).
    pub(crate) fn draw(&self, random: &mut Random, cover: f32) -> (usize, usize) {
        let places = self.side - self.size + 1;
        for _ in 0..24 {
            let (row, column) = (random.below(places), random.below(places));
            if self.cover(row, column) >= cover {
                return (row, column);
            }
        }
        self.best()
    }

    fn best(&self) -> (usize, usize) {
        let places = 0..=self.side - self.size;
        let all = places
            .clone()
            .flat_map(|row| places.clone().map(move |column| (row, column)));
        all.max_by_key(|&(row, column)| self.count(row, column))
            .unwrap_or((0, 0))
    }

    fn cover(&self, row: usize, column: usize) -> f32 {
        self.count(row, column) as f32 / (self.size * self.size) as f32
    }

    fn count(&self, row: usize, column: usize) -> u32 {
        let stride = self.side + 1;
        let sum = |row: usize, column: usize| self.sums[row * stride + column];
        let (bottom, right) = (row + self.size, column + self.size);
        sum(bottom, right) + sum(row, column) - sum(row, right) - sum(bottom, column)
    }
}
