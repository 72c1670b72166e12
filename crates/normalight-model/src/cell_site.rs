//! Where the cells of a network stand.
use crate::{CellLight, CellNormal};

/// One cell of a network: which of the genotype's cells, how wide, how large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CellSite {
    /// Which cell of the genotype, in the order of its `cells()`.
    pub cell: usize,
    /// Whether it halves the size: its edges from the cell inputs then have stride 2.
    pub reduces: bool,
    /// Channels of each node.
    pub width: usize,
    /// Pixels of its output.
    pub area: usize,
    /// Whether it runs for every image, or once for a stack.
    pub per_image: bool,
}

impl CellSite {
    /// Pixels of its inputs.
    pub fn input_area(&self) -> usize {
        self.area * if self.reduces { 4 } else { 1 }
    }
}

/// A row of cells while it grows.
struct Row {
    width: usize,
    area: usize,
    per_image: bool,
    cells: Vec<CellSite>,
}

impl Row {
    fn new(width: usize, area: usize, per_image: bool) -> Self {
        Self {
            width,
            area,
            per_image,
            cells: Vec::new(),
        }
    }

    fn add(&mut self, cell: usize, reduces: bool) {
        if reduces {
            self.width *= 2;
            self.area /= 4;
        }
        self.cells.push(CellSite {
            cell,
            reduces,
            width: self.width,
            area: self.area,
            per_image: self.per_image,
        });
    }
}

/// N, then R N for each reduction: cells 0 and 1 of the genotype.
fn features(width: usize, area: usize, reductions: usize) -> Vec<CellSite> {
    let mut row = Row::new(width, area, true);
    row.add(0, false);
    for _ in 0..reductions {
        row.add(1, true);
        row.add(0, false);
    }
    row.cells
}

fn stem_area(area: usize, strides: [usize; 2]) -> usize {
    area / strides
        .map(|stride| stride * stride)
        .iter()
        .product::<usize>()
}

/// Cells of the features and of the classifier of a light network for views of that many pixels.
pub fn light_cell_sites(cells: &CellLight, area: usize) -> [Vec<CellSite>; 2] {
    let area = stem_area(area, cells.stem_strides);
    let mut classifier = Row::new(cells.width, area >> (2 * cells.reductions), true);
    classifier.add(2, false);
    classifier.add(3, true);
    [
        features(cells.width, area, cells.reductions),
        classifier.cells,
    ]
}

/// Cells of the features and of the regressor of a normal network for images of that many pixels.
pub fn normal_cell_sites(cells: &CellNormal, area: usize) -> [Vec<CellSite>; 2] {
    let mut regressor = Row::new(cells.width, area / 4, false);
    for _ in 0..3 {
        regressor.add(2, false);
    }
    let area = stem_area(area, cells.stem_strides);
    [
        features(cells.width, area, cells.reductions),
        regressor.cells,
    ]
}
