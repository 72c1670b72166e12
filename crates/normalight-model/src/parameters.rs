//! Closed-form parameter counts, written independently of the layers so that tests can compare.

use crate::{
    Cell, LightArchitecture, LightBody, NormalArchitecture, NormalBody, Operation, Upsampling,
};

/// Number of trainable parameters of a light calibration network, batch norm included.
pub fn light_parameters(architecture: &LightArchitecture) -> usize {
    let bins = &architecture.bins;
    let classes = bins.azimuth + bins.elevation + bins.intensity.count;
    match &architecture.body {
        LightBody::Plain(plain) => {
            let [a, b, c] = plain.widths;
            let features = conv(4, a) + conv(a, b) + conv(b, b) + conv(b, c) + conv(c, c);
            let classifier = conv(2 * c, c) + 2 * conv(c, c);
            let side = architecture.input_size / 32;
            features
                + classifier
                + dense(c * side * side, plain.hidden)
                + dense(plain.hidden, classes)
        }
        LightBody::Cells(cells) => {
            let c = cells.width;
            let genotype = &cells.genotype;
            let features = feature_block(&genotype.feature_normal, &genotype.feature_reduction, c);
            let channels = genotype.feature_normal.nodes.len() * 4 * c;
            let classifier = cell_row(
                &[
                    (&genotype.classifier_normal, false),
                    (&genotype.classifier_reduction, true),
                ],
                c,
            );
            let after = genotype.classifier_reduction.nodes.len() * 2 * c;
            let stride: usize = cells.stem_strides.iter().product();
            let side = (architecture.input_size / stride).div_ceil(16);
            conv(4, 2 * c)
                + conv(2 * c, 3 * c)
                + features
                + conv(2 * channels, 4 * c)
                + conv(4 * c, 3 * c)
                + classifier
                + conv(after, 4 * c)
                + conv(4 * c, 4 * c)
                + dense(4 * c * side * side, cells.hidden)
                + dense(cells.hidden, classes)
        }
    }
}

/// Number of trainable parameters of a normal estimation network, batch norm included.
pub fn normal_parameters(architecture: &NormalArchitecture) -> usize {
    let inputs = architecture.input_channels();
    match &architecture.body {
        NormalBody::Plain(plain) => {
            let [a, b, c] = plain.widths;
            conv(inputs, a)
                + conv(a, b)
                + conv(b, b)
                + conv(b, c)
                + conv(c, c)
                + conv(c, b)
                + 3 * conv(b, b)
                + conv(b, plain.head)
                + conv(plain.head, 3)
        }
        NormalBody::Cells(cells) => {
            let c = cells.width;
            let genotype = &cells.genotype;
            let up = |from: usize, to: usize| match cells.upsampling {
                Upsampling::Transposed => 16 * from * to + to,
                Upsampling::Nearest => conv(from, to),
            };
            let regressor = &genotype.regressor_normal;
            conv(inputs, 2 * c)
                + conv(2 * c, 3 * c)
                + feature_block(&genotype.feature_normal, &genotype.feature_reduction, c)
                + up(genotype.feature_normal.nodes.len() * 4 * c, 4 * c)
                + conv(4 * c, 4 * c)
                + (cells.fused_convolutions - 1) * conv(4 * c, 4 * c)
                + conv(4 * c, 3 * c)
                + cell_row(&[(regressor, false); 3], c)
                + up(regressor.nodes.len() * c, 2 * c)
                + conv(2 * c, 3)
        }
    }
}

/// Parameters of the cells N R N R N on a stem of 3C channels.
fn feature_block(normal: &Cell, reduction: &Cell, width: usize) -> usize {
    let cells = [
        (normal, false),
        (reduction, true),
        (normal, false),
        (reduction, true),
        (normal, false),
    ];
    cell_row(&cells, width)
}

/// Parameters of a row of cells on a stem of 3C channels.
fn cell_row(cells: &[(&Cell, bool)], width: usize) -> usize {
    let mut width = width;
    let (mut before_last, mut last) = (3 * width, 3 * width);
    let mut total = 0;
    for &(cell, is_reduction) in cells {
        if is_reduction {
            width *= 2;
        }
        // Both preprocessings: a 1x1 convolution (or two half ones) and 2C of batch norm.
        total += (before_last + last) * width + 4 * width;
        for edge in cell.nodes.iter().flatten() {
            let strided = is_reduction && edge.from < 2;
            total += operation(edge.operation, width, strided);
        }
        (before_last, last) = (last, cell.nodes.len() * width);
    }
    total
}

fn operation(operation: Operation, width: usize, strided: bool) -> usize {
    let separable = |kernel: usize| 2 * (kernel * kernel * width + width * width + 2 * width);
    match operation {
        Operation::Separable1 => separable(1),
        Operation::Separable3 => separable(3),
        Operation::Separable5 => separable(5),
        Operation::Skip if strided => width * width + 2 * width,
        Operation::Skip | Operation::Zero => 0,
    }
}

/// A 3x3 convolution with bias.
fn conv(from: usize, to: usize) -> usize {
    9 * from * to + to
}

fn dense(from: usize, to: usize) -> usize {
    from * to + to
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellNormal, PlainNormal, paper_genotypes};

    #[test]
    fn published_and_measured_counts() {
        assert_eq!(light_parameters(&LightArchitecture::plain()), 262_316);
        assert_eq!(normal_parameters(&NormalArchitecture::plain()), 126_515);
        let wide = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Plain(PlainNormal {
                widths: [32, 64, 128],
                head: 32,
            }),
        };
        assert_eq!(normal_parameters(&wide), 482_531);
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
            assert_eq!(normal_parameters(&cells), expected);
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
            let count = feature_block(&light.feature_normal, &light.feature_reduction, width);
            assert_eq!(thousands(count), features);
            let cells = [
                (&light.classifier_normal, false),
                (&light.classifier_reduction, true),
            ];
            assert_eq!(thousands(cell_row(&cells, width)), classifier);
            let count = feature_block(&normal.feature_normal, &normal.feature_reduction, width);
            assert_eq!(thousands(count), normal_features);
            let cells = [(&normal.regressor_normal, false); 3];
            assert_eq!(thousands(cell_row(&cells, width)), regressor);
        }
    }
}
