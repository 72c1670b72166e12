//! What a network consists of, layer by layer: for drawings.
use crate::cell_site::{CellSite, light_cell_sites, normal_cell_sites};
use crate::cost::last_channels;
use crate::{
    Cell, LayerKind, LightArchitecture, LightBody, LightGenotype, Meeting, NormalArchitecture,
    NormalBody, NormalGenotype, Stage, Upsampling,
};

/// A layer, or a cell, of a network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutlineLayer {
    /// What it is: `3x3`, `reduction cell`, `fully connected`, ...
    pub words: String,
    /// Channels that come out.
    pub channels: usize,
    /// How often the input's size is halved in what comes out; `None` where there are no pixels any more.
    pub halvings: Option<usize>,
}

/// The layers of a network in the order in which it computes them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Outline {
    /// Channels of the input.
    pub inputs: usize,
    /// Layers on every image by itself.
    pub images: Vec<OutlineLayer>,
    /// What then becomes of the images.
    pub meeting: String,
    /// Layers after that.
    pub fused: Vec<OutlineLayer>,
    /// Layers on every pixel of every image by itself, beside the others, which join the last ones.
    pub pixels: Vec<OutlineLayer>,
}

/// A row of layers while it grows.
#[derive(Default)]
struct Row {
    layers: Vec<OutlineLayer>,
    halvings: usize,
}

impl Row {
    fn at(halvings: usize) -> Self {
        Self {
            halvings,
            ..Self::default()
        }
    }

    /// So many layers of a width, the first of which changes the size: 1 halves it, -1 doubles it.
    fn add(&mut self, words: &str, channels: usize, (count, change): (usize, isize)) {
        self.halvings = self.halvings.saturating_add_signed(change);
        let layer = OutlineLayer {
            words: words.to_owned(),
            channels,
            halvings: Some(self.halvings),
        };
        self.layers.extend(std::iter::repeat_n(layer, count));
    }

    fn stages(&mut self, stages: &[Stage], changes: [isize; 2]) {
        for (place, stage) in stages.iter().enumerate() {
            let words = match stage.kind {
                LayerKind::Convolution3 => "3x3",
                LayerKind::Separable3 => "separable 3x3",
                LayerKind::Separable5 => "separable 5x5",
                LayerKind::Pointwise => "1x1",
                LayerKind::Transposed4 => "transposed 4x4",
            };
            let change = changes[usize::from(place > 0)];
            self.add(words, stage.width, (stage.layers, change));
        }
    }

    fn cells(&mut self, sites: &[CellSite], cells: &[&Cell]) {
        for (place, site) in sites.iter().enumerate() {
            let (words, change) = match site.reduces {
                true => ("reduction cell", 1),
                false => ("cell", 0),
            };
            let channels = last_channels(&sites[..=place], cells);
            self.add(words, channels, (1, change));
        }
    }

    fn dense(&mut self, channels: usize) {
        self.layers.push(OutlineLayer {
            words: "fully connected".to_owned(),
            channels,
            halvings: None,
        });
    }
}

impl LightArchitecture {
    /// Its layers.
    pub fn outline(&self) -> Outline {
        let mut images = Row::default();
        let mut fused;
        let hidden = match &self.body {
            LightBody::Plain(plain) => {
                let [a, b, c] = plain.widths;
                for (width, layers) in [(a, 1), (b, 2), (c, 2)] {
                    images.add("3x3", width, (layers, 1));
                }
                fused = Row::at(images.halvings);
                for change in [0, 1, 1] {
                    fused.add("3x3", c, (1, change));
                }
                plain.hidden
            }
            LightBody::Staged(staged) => {
                images.stages(&staged.features, [1; 2]);
                fused = Row::at(images.halvings);
                fused.stages(&staged.classifier, [0, 1]);
                staged.hidden
            }
            LightBody::Cells(cells) => {
                let c = cells.width;
                let chosen = cells.genotype.chosen().map(LightGenotype::cells);
                let chosen = chosen.as_ref().map_or(&[][..], |cells| cells);
                let [features, classifier] = light_cell_sites(cells, 0);
                for (width, stride) in [2 * c, 3 * c].into_iter().zip(cells.stem_strides) {
                    images.add("3x3", width, (1, isize::from(stride == 2)));
                }
                images.cells(&features, chosen);
                fused = Row::at(images.halvings);
                fused.add("3x3", 4 * c, (1, 0));
                fused.add("3x3", 3 * c, (1, 0));
                fused.cells(&classifier, chosen);
                fused.add("3x3", 4 * c, (1, 1));
                fused.add("3x3", 4 * c, (1, 0));
                cells.hidden
            }
        };
        fused.dense(hidden);
        fused.dense(self.bins.classes());
        Outline {
            // Image and mask.
            inputs: 4,
            images: images.layers,
            meeting: "each image beside the maximum of all".to_owned(),
            fused: fused.layers,
            pixels: Vec::new(),
        }
    }
}

impl NormalArchitecture {
    /// Its layers.
    pub fn outline(&self) -> Outline {
        let (mut images, mut pixels) = (Row::default(), Row::default());
        let mut fused;
        let mut meeting = "maximum of all images".to_owned();
        match &self.body {
            NormalBody::Plain(plain) => {
                let [a, b, c] = plain.widths;
                images.add("3x3", a, (1, 0));
                images.add("3x3", b, (2, 1));
                images.add("3x3", c, (2, 1));
                images.add("3x3, added", c, (plain.residuals, 0));
                images.add("3x3", b, (2, -1));
                fused = Row::at(images.halvings);
                fused.add("3x3", b, (2, 0));
                fused.add("3x3", plain.head, (1, -1));
                if plain.pixel_branch > 0 {
                    pixels.add("1x1", plain.pixel_branch, (2, 0));
                    fused.add("3x3", plain.head, (1, 0));
                }
            }
            NormalBody::Staged(staged) => {
                images.stages(&staged.down, [0, 1]);
                images.stages(&staged.up, [-1; 2]);
                let exchanges = (staged.exchanges, 0);
                images.add("exchange, 3x3", staged.meeting_width(), exchanges);
                if staged.meeting == Meeting::MaxMean {
                    meeting = "maximum and mean of all images".to_owned();
                }
                fused = Row::at(images.halvings);
                fused.stages(&staged.fused, [0, -1]);
                if let Some(stage) = staged.pixels {
                    pixels.add("1x1", stage.width, (stage.layers, 0));
                    let head = staged.fused.last().map_or(0, |stage| stage.width);
                    fused.add("3x3", head, (1, 0));
                }
            }
            NormalBody::Cells(cells) => {
                let c = cells.width;
                let chosen = cells.genotype.chosen().map(NormalGenotype::cells);
                let chosen = chosen.as_ref().map_or(&[][..], |cells| cells);
                let up = match cells.upsampling {
                    Upsampling::Transposed => "transposed 4x4",
                    Upsampling::Nearest => "3x3",
                };
                let [features, regressor] = normal_cell_sites(cells, 0);
                for (width, stride) in [2 * c, 3 * c].into_iter().zip(cells.stem_strides) {
                    images.add("3x3", width, (1, isize::from(stride == 2)));
                }
                images.cells(&features, chosen);
                let first = if cells.doublings() == 0 { "3x3" } else { up };
                for doubling in [cells.doublings() > 0, cells.doublings() > 1] {
                    let words = if images.halvings > 1 { first } else { "3x3" };
                    images.add(words, 4 * c, (1, -isize::from(doubling)));
                }
                fused = Row::at(images.halvings);
                fused.add("3x3", 4 * c, (cells.fused_convolutions - 1, 0));
                fused.add("3x3", 3 * c, (1, 0));
                fused.cells(&regressor, chosen);
                fused.add(up, 2 * c, (1, -1));
            }
        }
        fused.add("3x3", 3, (1, 0));
        Outline {
            inputs: self.input_channels(),
            images: images.layers,
            meeting,
            fused: fused.layers,
            pixels: pixels.layers,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellLight, CellNormal};
    use crate::{PixelStage, PlainNormal, StagedNormal, light_cost, normal_cost, paper_genotypes};

    /// Parameters of a row of 3x3 and 1x1 convolutions with bias, as the outline has them.
    fn parameters(mut channels: usize, layers: &[OutlineLayer]) -> usize {
        let mut sum = 0;
        for layer in layers {
            let size = if layer.words == "1x1" { 1 } else { 9 };
            sum += layer.channels * (size * channels + 1);
            channels = layer.channels;
        }
        sum
    }

    /// Counted from what is drawn, as closed forms count it.
    #[test]
    fn outlines_have_as_many_parameters_as_their_networks() {
        let mut plain = PlainNormal::new([12, 20, 28], 16);
        plain.residuals = 2;
        let normal = |body| NormalArchitecture {
            mask_channel: true,
            body,
        };
        let bodies = [
            NormalBody::Plain(plain),
            NormalBody::Staged(StagedNormal {
                down: vec![Stage::plain(8, 2), Stage::plain(12, 1), Stage::plain(20, 3)],
                up: vec![Stage::plain(24, 2)],
                meeting: Meeting::Max,
                exchanges: 0,
                fused: vec![Stage::plain(16, 1), Stage::plain(10, 2)],
                pixels: None,
            }),
        ];
        for body in bodies {
            let architecture = normal(body);
            let outline = architecture.outline();
            let between = outline.images.last().unwrap().channels;
            let found =
                parameters(outline.inputs, &outline.images) + parameters(between, &outline.fused);
            assert_eq!(
                found,
                normal_cost(&architecture, 0).parameters,
                "{outline:?}"
            );
            assert_eq!(outline.fused.last().unwrap().halvings, Some(0));
        }
        let light = LightArchitecture::plain();
        let outline = light.outline();
        let (dense, fused): (Vec<_>, Vec<_>) = outline
            .fused
            .iter()
            .cloned()
            .partition(|layer| layer.halvings.is_none());
        let between = 2 * outline.images.last().unwrap().channels;
        let last = fused.last().unwrap();
        let side = light.input_size >> last.halvings.unwrap();
        let flat = last.channels * side * side;
        let found = parameters(4, &outline.images)
            + parameters(between, &fused)
            + dense[0].channels * (flat + 1)
            + dense[1].channels * (dense[0].channels + 1);
        assert_eq!(found, light_cost(&light).parameters);
    }

    #[test]
    fn sizes_of_cells_and_branches() {
        let paper = paper_genotypes();
        let normal = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Cells(CellNormal {
                width: 8,
                stem_strides: [1, 2],
                reductions: 2,
                upsampling: Upsampling::Nearest,
                fused_convolutions: 1,
                genotype: paper.normal.unwrap().into(),
            }),
        };
        let outline = normal.outline();
        let halvings = |layers: &[OutlineLayer]| -> Vec<Option<usize>> {
            layers.iter().map(|layer| layer.halvings).collect()
        };
        // Two convolutions, N R N R N, two doublings.
        assert_eq!(
            halvings(&outline.images),
            [0, 1, 1, 2, 2, 3, 3, 2, 1].map(Some)
        );
        assert_eq!(halvings(&outline.fused), [1, 1, 1, 1, 0, 0].map(Some));
        assert_eq!(outline.images[5].words, "reduction cell");
        let light = LightArchitecture {
            body: LightBody::Cells(CellLight {
                width: 8,
                stem_strides: [2, 2],
                reductions: 1,
                hidden: 64,
                genotype: paper.light.unwrap().into(),
            }),
            ..LightArchitecture::plain()
        };
        let outline = light.outline();
        assert_eq!(halvings(&outline.images), [1, 2, 2, 3, 3].map(Some));
        assert_eq!(outline.fused.last().unwrap().channels, light.bins.classes());
        let mut plain = PlainNormal::new([8, 8, 8], 4);
        plain.pixel_branch = 6;
        let branch = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Plain(plain),
        };
        let outline = branch.outline();
        assert_eq!(halvings(&outline.pixels), [Some(0); 2]);
        assert_eq!(outline.fused.len(), 5);
        let staged = StagedNormal {
            down: vec![Stage::plain(8, 1)],
            up: Vec::new(),
            meeting: Meeting::MaxMean,
            exchanges: 1,
            fused: vec![Stage::plain(8, 1)],
            pixels: Some(PixelStage {
                width: 4,
                layers: 3,
            }),
        };
        let outline = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Staged(staged),
        }
        .outline();
        assert_eq!((outline.pixels.len(), outline.images.len()), (3, 2));
        assert!(outline.meeting.contains("mean"));
    }
}
