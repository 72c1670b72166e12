//! Closed-form parameter and operation counts, written independently of the layers so that tests can compare.

mod cells;
mod layers;
mod stages;

pub use cells::operation_cost;
pub use layers::Cost;

use crate::cell_site::{light_cell_sites, normal_cell_sites};
use crate::{
    LightArchitecture, LightBody, LightGenotype, NormalArchitecture, NormalBody, NormalGenotype,
    Upsampling,
};
use cells::cell_row;
pub(crate) use cells::last_channels;
use layers::{biased, conv, dense, transposed};

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

/// What a light calibration network costs at its own input size; cells that are open count nothing.
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
        LightBody::Staged(staged) => {
            let (features, channels, small) =
                stages::row(&staged.features, (4, area), [1; 2], true);
            let before = (2 * channels, small);
            let (classifier, _, _) = stages::row(&staged.classifier, before, [0, 1], false);
            let (_, flat) = staged.last(architecture.input_size);
            features + classifier + dense(flat, staged.hidden) + dense(staged.hidden, classes)
        }
        LightBody::Cells(cells) => {
            let c = cells.width;
            let chosen = cells.genotype.chosen().map(LightGenotype::cells);
            let chosen = chosen.as_ref().map_or(&[][..], |cells| cells);
            let [first, second] = cells.stem_strides.map(|stride| stride * stride);
            let stem = area / (first * second);
            let [features, classifier] = light_cell_sites(cells, area);
            let channels = last_channels(&features, chosen);
            let after = last_channels(&classifier, chosen);
            let stride: usize = cells.stem_strides.iter().product();
            let side = (architecture.input_size / stride).div_ceil(4 << cells.reductions);
            let fused = stem >> (2 * cells.reductions);
            conv(4, 2 * c, area / first)
                + conv(2 * c, 3 * c, stem)
                + cell_row(&features, chosen)
                + conv(2 * channels, 4 * c, fused)
                + conv(4 * c, 3 * c, fused)
                + cell_row(&classifier, chosen)
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

/// What a normal estimation network costs for images of that many pixels; cells that are open count nothing.
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
        NormalBody::Staged(staged) => stages::normal(staged, inputs, area),
        NormalBody::Cells(cells) => {
            let c = cells.width;
            let chosen = cells.genotype.chosen().map(NormalGenotype::cells);
            let chosen = chosen.as_ref().map_or(&[][..], |cells| cells);
            let [first, second] = cells.stem_strides.map(|stride| stride * stride);
            let stem = area / (first * second);
            let up = |from: usize, to: usize, area: usize| match cells.upsampling {
                Upsampling::Transposed => transposed(from, to, area),
                Upsampling::Nearest => conv(from, to, area),
            };
            let [features, regressor] = normal_cell_sites(cells, area);
            let channels = last_channels(&features, chosen);
            let half = area / 4;
            let first_up = match cells.doublings() {
                0 => conv(channels, 4 * c, half),
                1 => up(channels, 4 * c, half),
                // The next layer doubles the size once more.
                _ => up(channels, 4 * c, half / 4),
            };
            let images = conv(inputs, 2 * c, area / first)
                + conv(2 * c, 3 * c, stem)
                + cell_row(&features, chosen)
                + first_up
                + conv(4 * c, 4 * c, half);
            let fused = conv(4 * c, 4 * c, half) * (cells.fused_convolutions - 1)
                + conv(4 * c, 3 * c, half)
                + cell_row(&regressor, chosen)
                + up(last_channels(&regressor, chosen), 2 * c, area)
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
                    genotype: paper.normal.clone().into(),
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
                genotype: light.clone().into(),
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
                genotype: normal.clone().into(),
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
