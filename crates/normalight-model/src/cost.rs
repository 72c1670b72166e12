//! Closed-form parameter and operation counts, written independently of the layers so that tests can compare.

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
    let classes = bins.azimuth + bins.elevation + bins.intensity.count;
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
            let channels = genotype.feature_normal.nodes.len() * 4 * c;
            let classifier = [
                (&genotype.classifier_normal, false),
                (&genotype.classifier_reduction, true),
            ];
            let after = genotype.classifier_reduction.nodes.len() * 2 * c;
            let stride: usize = cells.stem_strides.iter().product();
            let side = (architecture.input_size / stride).div_ceil(16);
            conv(4, 2 * c, area / first)
                + conv(2 * c, 3 * c, stem)
                + feature_block(
                    &genotype.feature_normal,
                    &genotype.feature_reduction,
                    c,
                    stem,
                )
                + conv(2 * channels, 4 * c, stem / 16)
                + conv(4 * c, 3 * c, stem / 16)
                + cell_row(&classifier, c, stem / 16)
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
                + conv(c, c, area / 16)
                + conv(c, b, area / 4)
                + conv(b, b, area / 4);
            let fused =
                conv(b, b, area / 4) * 2 + conv(b, plain.head, area) + conv(plain.head, 3, area);
            (features, fused)
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
            let channels = genotype.feature_normal.nodes.len() * 4 * c;
            let features = conv(inputs, 2 * c, area / first)
                + conv(2 * c, 3 * c, stem)
                + feature_block(
                    &genotype.feature_normal,
                    &genotype.feature_reduction,
                    c,
                    stem,
                )
                + up(channels, 4 * c, stem / 4)
                + conv(4 * c, 4 * c, area / 4);
            let regressor = &genotype.regressor_normal;
            let fused = conv(4 * c, 4 * c, area / 4) * (cells.fused_convolutions - 1)
                + conv(4 * c, 3 * c, area / 4)
                + cell_row(&[(regressor, false); 3], c, area / 4)
                + up(regressor.nodes.len() * c, 2 * c, area)
                + conv(2 * c, 3, area);
            (features, fused)
        }
    };
    NetworkCost {
        parameters: per_image.parameters + per_stack.parameters,
        per_image: per_image.multiply_adds,
        per_stack: per_stack.multiply_adds,
    }
}

/// Of some layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Cost {
    parameters: usize,
    multiply_adds: u64,
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

/// The cells N R N R N on a stem of 3C channels.
fn feature_block(normal: &Cell, reduction: &Cell, width: usize, area: usize) -> Cost {
    let cells = [
        (normal, false),
        (reduction, true),
        (normal, false),
        (reduction, true),
        (normal, false),
    ];
    cell_row(&cells, width, area)
}

/// A row of cells on a stem of 3C channels and that many pixels.
fn cell_row(cells: &[(&Cell, bool)], width: usize, area: usize) -> Cost {
    let (mut width, mut area) = (width, area);
    let (mut before_last, mut last) = (3 * width, 3 * width);
    let mut total = Cost::default();
    for &(cell, is_reduction) in cells {
        // Both preprocessings, at the size that comes in: a 1x1 convolution (or two half ones).
        if is_reduction {
            width *= 2;
        }
        total = total + pointwise(before_last, width, area) + pointwise(last, width, area);
        if is_reduction {
            area /= 4;
        }
        let edges = cell.nodes.iter().flatten().map(|edge| {
            let strided = is_reduction && edge.from < 2;
            operation(edge.operation, width, strided, area)
        });
        total = total + edges.sum();
        (before_last, last) = (last, cell.nodes.len() * width);
    }
    total
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

fn dense(from: usize, to: usize) -> Cost {
    Cost {
        parameters: from * to + to,
        multiply_adds: (from * to) as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellNormal, PlainNormal, paper_genotypes};

    #[test]
    fn published_and_measured_counts() {
        assert_eq!(light_cost(&LightArchitecture::plain()).parameters, 262_316);
        assert_eq!(
            normal_cost(&NormalArchitecture::plain(), 1024).parameters,
            126_515
        );
        let wide = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Plain(PlainNormal {
                widths: [32, 64, 128],
                head: 32,
            }),
        };
        assert_eq!(normal_cost(&wide, 1024).parameters, 482_531);
        let paper = paper_genotypes();
        for (width, expected) in [(8, 129_507), (16, 474_435)] {
            let cells = NormalArchitecture {
                mask_channel: false,
                body: NormalBody::Cells(CellNormal {
                    width,
                    stem_strides: [1, 2],
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
            let count = feature_block(&light.feature_normal, &light.feature_reduction, width, 0);
            assert_eq!(thousands(count.parameters), features);
            let cells = [
                (&light.classifier_normal, false),
                (&light.classifier_reduction, true),
            ];
            assert_eq!(thousands(cell_row(&cells, width, 0).parameters), classifier);
            let count = feature_block(&normal.feature_normal, &normal.feature_reduction, width, 0);
            assert_eq!(thousands(count.parameters), normal_features);
            let cells = [(&normal.regressor_normal, false); 3];
            assert_eq!(thousands(cell_row(&cells, width, 0).parameters), regressor);
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
