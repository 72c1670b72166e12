//! Drawing of a directed graph in columns, edges from left to right (Sugiyama et al. 1981).
//!
//! Whatever an edge passes on its way has a place of its own in its column, as the boxes have, so nothing is drawn over
//! anything else. Places are ordered for few crossings, then moved up and down until long edges are straight.

/// Sweeps over all columns; both steps settle much earlier.
const ORDER_SWEEPS: usize = 24;
const MOVE_SWEEPS: usize = 200;

/// What has a place in a column: a box, or an edge on its way.
struct Item {
    column: usize,
    /// Half its height and half the space to its neighbours.
    half: f64,
    is_box: bool,
    y: f64,
    /// Items in the column before and in the one after.
    neighbours: [Vec<usize>; 2],
}

/// Items in columns; links join items of adjacent columns.
pub(super) struct Layers {
    items: Vec<Item>,
    /// Items from top to bottom.
    columns: Vec<Vec<usize>>,
}

impl Layers {
    pub(super) fn new(columns: usize) -> Self {
        Self {
            items: Vec::new(),
            columns: vec![Vec::new(); columns],
        }
    }

    /// Adds an item of this height, space around it included.
    pub(super) fn add(&mut self, column: usize, height: f64, is_box: bool) -> usize {
        let item = self.items.len();
        self.columns[column].push(item);
        self.items.push(Item {
            column,
            half: height / 2.0,
            is_box,
            y: 0.0,
            neighbours: [Vec::new(), Vec::new()],
        });
        item
    }

    /// Joins an item to one in the next column.
    pub(super) fn link(&mut self, from: usize, to: usize) {
        debug_assert_eq!(self.items[from].column + 1, self.items[to].column);
        self.items[from].neighbours[1].push(to);
        self.items[to].neighbours[0].push(from);
    }

    /// Column of an item.
    pub(super) fn column(&self, item: usize) -> usize {
        self.items[item].column
    }

    /// Middle of an item, once arranged; the topmost item begins at 0.
    pub(super) fn y(&self, item: usize) -> f64 {
        self.items[item].y
    }

    /// Places all items and returns the height of the whole.
    pub(super) fn arrange(&mut self) -> f64 {
        self.order();
        for _ in 0..MOVE_SWEEPS {
            for column in (0..self.columns.len()).chain((0..self.columns.len()).rev()) {
                self.settle(column);
            }
        }
        let items = self.items.iter();
        let top = items.clone().map(|item| item.y - item.half);
        let top = top.fold(f64::INFINITY, f64::min);
        let bottom = items.map(|item| item.y + item.half);
        let bottom = bottom.fold(f64::NEG_INFINITY, f64::max);
        for item in &mut self.items {
            item.y -= top;
        }
        bottom - top
    }

    /// Orders each column by the mean place of its items' neighbours, from left to right and back, and keeps the best.
    fn order(&mut self) {
        let mut best = (self.crossings(), self.columns.clone());
        for sweep in 0..ORDER_SWEEPS {
            let side = sweep % 2;
            for step in 1..self.columns.len() {
                let column = if side == 0 {
                    step
                } else {
                    self.columns.len() - step
                };
                self.sort(column, side);
                self.exchange(column);
            }
            let crossings = self.crossings();
            if crossings < best.0 {
                best = (crossings, self.columns.clone());
            }
        }
        self.columns = best.1;
    }

    /// Sorts a column by the neighbours on one side; the first column keeps the order of the cell's inputs.
    fn sort(&mut self, column: usize, side: usize) {
        let places = self.places();
        let mean = |item: usize| {
            let neighbours = &self.items[item].neighbours[side];
            let sum: usize = neighbours.iter().map(|&one| places[one]).sum();
            match neighbours.len() {
                0 => places[item] as f64,
                count => sum as f64 / count as f64,
            }
        };
        let mut items = self.columns[column].clone();
        items.sort_by(|a, b| mean(*a).total_cmp(&mean(*b)));
        self.columns[column] = items;
    }

    /// Exchanges items that lie one above the other as long as that leaves fewer crossings.
    fn exchange(&mut self, column: usize) {
        let places = self.places();
        let crossings = |above: usize, below: usize| -> usize {
            let [above, below] = [above, below].map(|item| &self.items[item].neighbours);
            let sides = above.iter().zip(below);
            sides
                .map(|(above, below)| {
                    let crosses = |one: &usize| {
                        let ends = below.iter();
                        ends.filter(|end| places[**end] < places[*one]).count()
                    };
                    above.iter().map(crosses).sum::<usize>()
                })
                .sum()
        };
        let mut items = self.columns[column].clone();
        for _ in 0..items.len() {
            for first in 1..items.len() {
                let (above, below) = (items[first - 1], items[first]);
                if crossings(below, above) < crossings(above, below) {
                    items.swap(first - 1, first);
                }
            }
        }
        self.columns[column] = items;
    }

    /// Place of every item in its column.
    fn places(&self) -> Vec<usize> {
        let mut places = vec![0; self.items.len()];
        for column in &self.columns {
            for (place, item) in column.iter().enumerate() {
                places[*item] = place;
            }
        }
        places
    }

    /// Pairs of links that cross.
    fn crossings(&self) -> usize {
        let places = self.places();
        let of_column = |column: &Vec<usize>| {
            let links: Vec<usize> = column
                .iter()
                .flat_map(|item| {
                    let mut ends: Vec<_> = self.items[*item].neighbours[1].clone();
                    ends.sort_by_key(|end| places[*end]);
                    ends.into_iter().map(|end| places[end])
                })
                .collect();
            let pairs = (0..links.len()).map(|first| {
                let later = links[first..].iter();
                later.filter(|end| **end < links[first]).count()
            });
            pairs.sum::<usize>()
        };
        self.columns.iter().map(of_column).sum()
    }

    /// Moves a column's items as close to the mean of their neighbours as their heights admit, in their order: least
    /// squares, by merging items into blocks while they press on each other.
    fn settle(&mut self, column: usize) {
        struct Block {
            /// Weighted mean of what its items would like, and their weight.
            wish: f64,
            weight: f64,
            count: usize,
        }
        let mut offsets = Vec::new();
        let mut blocks: Vec<Block> = Vec::new();
        let mut offset = 0.0;
        for &item in &self.columns[column] {
            offset += self.items[item].half;
            offsets.push(offset);
            let (wish, weight) = self.wish(item);
            let mut block = Block {
                wish: wish - offset,
                weight,
                count: 1,
            };
            while let Some(before) = blocks.pop_if(|before| before.wish > block.wish) {
                let weight = before.weight + block.weight;
                block = Block {
                    wish: (before.wish * before.weight + block.wish * block.weight) / weight,
                    weight,
                    count: before.count + block.count,
                };
            }
            blocks.push(block);
            offset += self.items[item].half;
        }
        let starts = blocks
            .iter()
            .flat_map(|block| std::iter::repeat_n(block.wish, block.count));
        for ((item, start), offset) in self.columns[column].iter().zip(starts).zip(offsets) {
            self.items[*item].y = start + offset;
        }
    }

    /// Where an item would like to be, and how much; an edge on its way wants to be straight more than boxes want to be
    /// in the middle.
    fn wish(&self, item: usize) -> (f64, f64) {
        let one = &self.items[item];
        let (mut sum, mut weight) = (0.0, 0.0);
        for neighbour in one.neighbours.iter().flatten() {
            let other = &self.items[*neighbour];
            let strength = match (one.is_box, other.is_box) {
                (true, true) => 1.0,
                (false, false) => 8.0,
                _ => 2.0,
            };
            sum += strength * other.y;
            weight += strength;
        }
        if weight > 0.0 {
            (sum / weight, weight)
        } else {
            (one.y, 1.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_overlaps_and_what_can_be_straight_is() {
        // Two chains whose ends were added the wrong way round, and a third item between them.
        let mut layers = Layers::new(3);
        let heights = [30.0, 10.0, 20.0];
        let first = heights.map(|height| layers.add(0, height, true));
        let mut second = heights.map(|_| layers.add(1, 12.0, false));
        second.reverse();
        let mut third = heights.map(|height| layers.add(2, height, true));
        third.rotate_left(1);
        for chain in 0..3 {
            layers.link(first[chain], second[chain]);
            layers.link(second[chain], third[chain]);
        }
        assert!(layers.crossings() > 0);
        let height = layers.arrange();
        assert_eq!(layers.crossings(), 0);
        for column in &layers.columns {
            for pair in column.windows(2) {
                let [above, below] = [pair[0], pair[1]].map(|item| &layers.items[item]);
                assert!(above.y + above.half <= below.y - below.half + 1e-6);
            }
        }
        for chain in 0..3 {
            let [a, b, c] = [first[chain], second[chain], third[chain]].map(|one| layers.y(one));
            assert!((a - b).abs() < 0.1 && (b - c).abs() < 0.1, "{a} {b} {c}");
        }
        let ends = layers.items.iter().map(|item| item.y + item.half);
        assert!((ends.fold(0.0, f64::max) - height).abs() < 1e-6);
    }
}
