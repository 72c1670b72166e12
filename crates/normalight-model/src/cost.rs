//! Closed-form parameter and operation counts, written independently of the layers so that tests can compare.

use crate::cell_site::{CellSite, light_cell_sites, normal_cell_sites};
use crate::{
    Cell, LightArchitecture, LightBody, NormalArchitecture, NormalBody, Operation, Upsampling,
};
use std::iter::Sum;
use std::ops::{Add, Mul};

/// What a network costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NetworkCost {
    /// Trainable parameters, batch norm included.
    pub parameters: usize,
    /// Multiply-adds of convolutions and fully connected layers for every image of a stack.
    pub per_image: u64,
    /// Multiply-adds once for a stack.
    pub per_stack: u64,
}

impl NetworkCost {
    /// Multiply-adds for a stack of that many images.
    pub fn multiply_adds(&self, images: usize) -> u64 {
        self.per_image * images as u64 + self.per_stack
    }
}

/// What a light calibration network costs at its own input size.
pub fn light_cost(architecture: &LightArchitecture) -> NetworkCost {
    let bins = &architecture.bins;
    let classes = bins.classes();
    let area = architecture.input_size * architecture.input_size;
    let cost = match &architecture.body {
        LightBody::Plain(plain) => {
            let [a, b, c] = plain.widths;
            let side = architecture.input_size / 32;
            conv(4, a, area / 4)
                + conv(a, b, area / 16)
                + conv(b, b, area / 16)
                + conv(b, c, area / 64)
                + conv(c, c, area / 64)
                + conv(2 * c, c, area / 64)
                + conv(c, c, area / 256)
                + conv(c, c, area / 1024)
                + dense(c * side * side, plain.hidden)
                + dense(plain.hidden, classes)
        }
        LightBody::Cells(cells) => {
            let c = cells.width;
            let genotype = &cells.genotype;
            let [first, second] = cells.stem_strides.map(|stride| stride * stride);
            let stem = area / (first * second);
            let [features, classifier] = light_cell_sites(cells, area);
            let channels = last_channels(&features, &genotype.cells());
            let after = last_channels(&classifier, &genotype.cells());
            let stride: usize = cells.stem_strides.iter().product();
            let side = (architecture.input_size / stride).div_ceil(4 << cells.reductions);
            let fused = stem >> (2 * cells.reductions);
            conv(4, 2 * c, area / first)
                + conv(2 * c, 3 * c, stem)
                + cell_row(&features, &genotype.cells())
                + conv(2 * channels, 4 * c, fused)
                + conv(4 * c, 3 * c, fused)
                + cell_row(&classifier, &genotype.cells())
                + conv(after, 4 * c, side * side)
                + conv(4 * c, 4 * c, side * side)
                + dense(4 * c * side * side, cells.hidden)
                + dense(cells.hidden, classes)
        }
    };
    // Every image is classified against the maximum, so nothing is done once for a stack.
    NetworkCost {
        parameters: cost.parameters,
        per_image: cost.multiply_adds,
        per_stack: 0,
    }
}

/// What a normal estimation network costs for images of that many pixels.
pub fn normal_cost(architecture: &NormalArchitecture, area: usize) -> NetworkCost {
    let inputs = architecture.input_channels();
    let (per_image, per_stack) = match &architecture.body {
        NormalBody::Plain(plain) => {
            let [a, b, c] = plain.widths;
            let features = conv(inputs, a, area)
                + conv(a, b, area / 4)
                + conv(b, b, area / 4)
                + conv(b, c, area / 16)
                + conv(c, c, area / 16) * (1 + plain.residuals)
                + conv(c, b, area / 4)
                + conv(b, b, area / 4);
            let (head, pixel) = (plain.head, plain.pixel_branch);
            let joined = head + 2 * pixel;
            let fused = conv(b, b, area / 4) * 2 + conv(b, head, area) + conv(joined, 3, area);
            if pixel == 0 {
                (features, fused)
            } else {
                let layers = biased(inputs, pixel, area) + biased(pixel, pixel, area);
                (features + layers, fused + conv(joined, head, area))
            }
        }
        NormalBody::Cells(cells) => {
            let c = cells.width;
            let genotype = &cells.genotype;
            let [first, second] = cells.stem_strides.map(|stride| stride * stride);
            let stem = area / (first * second);
            let up = |from: usize, to: usize, area: usize| match cells.upsampling {
                Upsampling::Transposed => Cost {
                    parameters: 16 * from * to + to,
                    multiply_adds: (4 * from * to * area) as u64,
                },
                Upsampling::Nearest => conv(from, to, area),
            };
            let [features, regressor] = normal_cell_sites(cells, area);
            let channels = last_channels(&features, &genotype.cells());
            let half = area / 4;
            let first_up = match cells.doublings() {
                0 => conv(channels, 4 * c, half),
                1 => up(channels, 4 * c, half),
                // The next layer doubles the size once more.
                _ => up(channels, 4 * c, half / 4),
            };
            let images = conv(inputs, 2 * c, area / first)
                + conv(2 * c, 3 * c, stem)
                + cell_row(&features, &genotype.cells())
                + first_up
                + conv(4 * c, 4 * c, half);
            let fused = conv(4 * c, 4 * c, half) * (cells.fused_convolutions - 1)
                + conv(4 * c, 3 * c, half)
                + cell_row(&regressor, &genotype.cells())
                + up(last_channels(&regressor, &genotype.cells()), 2 * c, area)
                + conv(2 * c, 3, area);
            (images, fused)
        }
    };
    NetworkCost {
        parameters: per_image.parameters + per_stack.parameters,
        per_image: per_image.multiply_adds,
        per_stack: per_stack.multiply_adds,
    }
}

/// What some layers cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Trainable parameters, batch norm included.
    pub parameters: usize,
    /// Multiply-adds of convolutions and fully connected layers.
    pub multiply_adds: u64,
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            parameters: self.parameters + other.parameters,
            multiply_adds: self.multiply_adds + other.multiply_adds,
        }
    }
}

impl Mul<usize> for Cost {
    type Output = Self;

    fn mul(self, count: usize) -> Self {
        Self {
            parameters: self.parameters * count,
            multiply_adds: self.multiply_adds * count as u64,
        }
    }
}

impl Sum for Cost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::default(), Self::add)
    }
}

/// Channels that a row of cells leaves.
fn last_channels(row: &[CellSite], cells: &[&Cell]) -> usize {
    row.last()
        .map_or(0, |last| cells[last.cell].nodes.len() * last.width)
}

/// A row of cells on a stem of three times their first width.
fn cell_row(row: &[CellSite], cells: &[&Cell]) -> Cost {
    let stem = row.first().map_or(0, |first| 3 * first.width);
    let (mut before_last, mut last) = (stem, stem);
    let mut total = Cost::default();
    for place in row {
        let nodes = &cells[place.cell].nodes;
        // Both preprocessings, at the size that comes in: a 1x1 convolution (or two half ones).
        let area = place.input_area();
        total = total + pointwise(before_last, place.width, area);
        total = total + pointwise(last, place.width, area);
        let edges = nodes
            .iter()
            .flatten()
            .map(|edge| operation_cost(edge.operation, place, edge.from));
        total = total + edges.sum();
        (before_last, last) = (last, nodes.len() * place.width);
    }
    total
}

/// What an operation costs on an edge from `from` of a cell that stands there.
pub fn operation_cost(operation: Operation, place: &CellSite, from: usize) -> Cost {
    let strided = place.reduces && from < 2;
    self::operation(operation, place.width, strided, place.area)
}

fn operation(operation: Operation, width: usize, strided: bool, area: usize) -> Cost {
    let separable = |kernel: usize| {
        let depthwise = Cost {
            parameters: kernel * kernel * width,
            multiply_adds: (kernel * kernel * width * area) as u64,
        };
        (depthwise + pointwise(width, width, area)) * 2
    };
    match operation {
        Operation::Separable1 => separable(1),
        Operation::Separable3 => separable(3),
        Operation::Separable5 => separable(5),
        Operation::Convolution3 => Cost {
            parameters: 9 * width * width + 2 * width,
            multiply_adds: (9 * width * width * area) as u64,
        },
        Operation::Skip if strided => pointwise(width, width, area),
        Operation::Skip | Operation::Zero => Cost::default(),
    }
}

/// A 1x1 convolution without bias, and batch norm.
fn pointwise(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: from * to + 2 * to,
        multiply_adds: (from * to * area) as u64,
    }
}

/// A 3x3 convolution with bias and that many output pixels.
fn conv(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: 9 * from * to + to,
        multiply_adds: (9 * from * to * area) as u64,
    }
}

/// A 1x1 convolution with bias and that many output pixels.
fn biased(from: usize, to: usize, area: usize) -> Cost {
    Cost {
        parameters: from * to + to,
        multiply_adds: (from * to * area) as u64,
    }
}

fn dense(from: usize, to: usize) -> Cost {
    Cost {
        parameters: from * to + to,
        multiply_adds: (from * to) as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellLight, CellNormal, PlainNormal, paper_genotypes};

    #[test]
    fn published_and_measured_counts() {
        assert_eq!(light_cost(&LightArchitecture::plain()).parameters, 262_316);
        assert_eq!(
            normal_cost(&NormalArchitecture::plain(), 1024).parameters,
            126_515
        );
        let wide = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Plain(PlainNormal::new([32, 64, 128], 32)),
        };
        assert_eq!(normal_cost(&wide, 1024).parameters, 482_531);
        let paper = paper_genotypes();
        for (width, expected) in [(8, 129_507), (16, 474_435)] {
            let cells = NormalArchitecture {
                mask_channel: false,
                body: NormalBody::Cells(CellNormal {
                    width,
                    stem_strides: [1, 2],
                    reductions: 2,
                    upsampling: Upsampling::Nearest,
                    fused_convolutions: 1,
                    genotype: paper.normal.clone().unwrap(),
                }),
            };
            assert_eq!(normal_cost(&cells, 1024).parameters, expected);
        }
    }

    /// Figures of the searched blocks in thousands, at C = 16, 32 and 48.
    #[test]
    fn searched_blocks() {
        let paper = paper_genotypes();
        let (light, normal) = (paper.light.unwrap(), paper.normal.unwrap());
        let thousands = |count: usize| (count as f64 / 1000.0).round() as usize;
        for (width, features, classifier, normal_features, regressor) in
            [(16, 196, 21, 215, 12), (32, 726, 73, 786, 41)]
        {
            let cells = CellLight {
                width,
                stem_strides: [1, 1],
                reductions: 2,
                hidden: 1,
                genotype: light.clone(),
            };
            let rows = light_cell_sites(&cells, 0).map(|row| cell_row(&row, &light.cells()));
            let count = rows.map(|row| thousands(row.parameters));
            assert_eq!(count, [features, classifier]);
            let cells = CellNormal {
                width,
                stem_strides: [1, 1],
                reductions: 2,
                upsampling: Upsampling::Nearest,
                fused_convolutions: 1,
                genotype: normal.clone(),
            };
            let rows = normal_cell_sites(&cells, 0).map(|row| cell_row(&row, &normal.cells()));
            let count = rows.map(|row| thousands(row.parameters));
            assert_eq!(count, [normal_features, regressor]);
        }
    }

    /// Counted by hand for a plain network at 32x32.
    #[test]
    fn multiply_adds_of_the_plain_network() {
        let cost = normal_cost(&NormalArchitecture::plain(), 32 * 32);
        let convolutions = |sizes: &[[u64; 3]]| -> u64 {
            sizes
                .iter()
                .map(|[from, to, side]| 9 * from * to * side * side)
                .sum()
        };
        let features = convolutions(&[
            [6, 16, 32],
            [16, 32, 16],
            [32, 32, 16],
            [32, 64, 8],
            [64, 64, 8],
            [64, 32, 16],
            [32, 32, 16],
        ]);
        let fused = convolutions(&[[32, 32, 16], [32, 32, 16], [32, 32, 32], [32, 3, 32]]);
        assert_eq!((cost.per_image, cost.per_stack), (features, fused));
        assert_eq!(cost.multiply_adds(10), 10 * features + fused);
    }
}
