//! A whole network as a row of boxes: as high as its pictures are, as wide as they have channels.
use super::{FAINT_INK, HEADER, MARGIN, cell_svg, page, rounded, text};
use normalight_model::{
    Architecture, Cell, LightBody, LightGenotype, NormalBody, NormalGenotype, Outline, OutlineLayer,
};
use svg::node::element::{Group, Line, Rectangle, Title};

/// Height of a picture of full size, and of what has no pixels any more.
const FULL: f64 = 128.0;
const LEAST: f64 = 8.0;
const GAP: f64 = 16.0;
/// Space of the line where images meet.
const MEETING: f64 = 40.0;
const LABEL: f64 = 18.0;
const IMAGES: &str = "#41a9e0";
const FUSED: &str = "#0a58a8";
const PIXELS: &str = "#009468";
const INPUT: &str = "#8c949d";

/// Drawings of a network (title, SVG): the whole, then its cells where it has some.
pub fn network_drawings(architecture: &Architecture) -> Vec<(String, Vec<u8>)> {
    let (title, outline, cells) = match architecture {
        Architecture::Light(light) => {
            let chosen = match &light.body {
                LightBody::Cells(cells) => cells.genotype.chosen(),
                _ => None,
            };
            let cells = chosen.map(|chosen| pairs(&LightGenotype::CELLS, &chosen.cells()));
            ("Light calibration network", light.outline(), cells)
        }
        Architecture::Normal(normal) => {
            let chosen = match &normal.body {
                NormalBody::Cells(cells) => cells.genotype.chosen(),
                _ => None,
            };
            let cells = chosen.map(|chosen| pairs(&NormalGenotype::CELLS, &chosen.cells()));
            ("Normal estimation network", normal.outline(), cells)
        }
    };
    let mut drawings = vec![(title.to_owned(), outline_svg(title, &outline))];
    for (name, cell) in cells.into_iter().flatten() {
        let title = format!("{title}: {} cell", name.replace('_', " "));
        let svg = cell_svg(&title, &cell);
        drawings.push((title, svg));
    }
    drawings
}

fn pairs(names: &[&'static str], cells: &[&Cell]) -> Vec<(&'static str, Cell)> {
    let cells = cells.iter().map(|&cell| cell.clone());
    names.iter().copied().zip(cells).collect()
}

fn outline_svg(title: &str, outline: &Outline) -> Vec<u8> {
    let input = OutlineLayer {
        words: "input".to_owned(),
        channels: outline.inputs,
        halvings: Some(0),
    };
    let middle = HEADER + LABEL + FULL / 2.0;
    let mut row = Row {
        x: MARGIN,
        middle,
        group: Group::new(),
    };
    row.layer(&input, INPUT);
    let branch = row.x;
    for layer in &outline.images {
        row.layer(layer, IMAGES);
    }
    row.meeting(&outline.meeting);
    for layer in &outline.fused {
        row.layer(layer, FUSED);
    }
    let (mut right, mut bottom) = (row.x, middle + FULL / 2.0 + 2.0 * LABEL);
    let mut document = vec![row.group];
    if !outline.pixels.is_empty() {
        let mut row = Row {
            x: branch,
            middle: bottom + LABEL + FULL / 2.0,
            group: Group::new(),
        };
        for layer in &outline.pixels {
            row.layer(layer, PIXELS);
        }
        row.words(
            row.x,
            row.middle + 4.0,
            "maximum and mean join the last layers",
            "start",
        );
        (right, bottom) = (
            right.max(row.x + 250.0),
            row.middle + FULL / 2.0 + 2.0 * LABEL,
        );
        document.push(row.group);
    }
    let page = page(title, right + MARGIN, bottom + MARGIN);
    let page = document.into_iter().fold(page, svg::Document::add);
    page.to_string().into_bytes()
}

/// A row of boxes while it grows.
struct Row {
    x: f64,
    /// Height of its middle.
    middle: f64,
    group: Group,
}

impl Row {
    fn layer(&mut self, layer: &OutlineLayer, fill: &str) {
        let height = layer.halvings.map_or(LEAST, |halvings| {
            (FULL / 2.0_f64.powi(halvings as i32)).max(LEAST)
        });
        // Words below need about as much.
        let width = 14.0 + 5.0 * (layer.channels.max(1) as f64).log2();
        let space = width.max(7.0 * longest(&layer.words) as f64);
        let left = self.x + (space - width) / 2.0;
        let size = layer
            .halvings
            .map_or("no pixels".to_owned(), |halvings| match halvings {
                0 => "full size".to_owned(),
                halvings => format!("1/{} of the size", 1 << halvings),
            });
        let title = format!("{}: {} channels, {size}", layer.words, layer.channels);
        let shape = Rectangle::new()
            .set("x", rounded(left))
            .set("y", rounded(self.middle - height / 2.0))
            .set("width", rounded(width))
            .set("height", rounded(height))
            .set("rx", 3)
            .set("fill", fill)
            .add(Title::new(title));
        self.add(shape);
        let centre = self.x + space / 2.0;
        let above = self.middle - height / 2.0 - 6.0;
        self.words(centre, above, &layer.channels.to_string(), "middle");
        for (line, word) in layer.words.split(' ').enumerate() {
            let y = self.middle + height / 2.0 + 15.0 + 13.0 * line as f64;
            self.words(centre, y, word, "middle");
        }
        self.x += space + GAP;
    }

    /// The line where images meet, and what happens there.
    fn meeting(&mut self, words: &str) {
        let x = self.x + (MEETING - GAP) / 2.0;
        let line = Line::new()
            .set("x1", rounded(x))
            .set("x2", rounded(x))
            .set("y1", rounded(self.middle - FULL / 2.0 - 4.0))
            .set("y2", rounded(self.middle + FULL / 2.0 + 2.0 * LABEL))
            .set("stroke", FAINT_INK)
            .set("stroke-dasharray", "4 4");
        self.add(line);
        self.words(
            x + 8.0,
            self.middle + FULL / 2.0 + 2.0 * LABEL - 4.0,
            words,
            "start",
        );
        self.x += MEETING;
    }

    fn words(&mut self, x: f64, y: f64, words: &str, anchor: &str) {
        self.add(text(x, y, words).set("text-anchor", anchor));
    }

    fn add(&mut self, node: impl Into<Box<dyn svg::Node>>) {
        self.group = std::mem::take(&mut self.group).add(node);
    }
}

/// Letters of the longest word.
fn longest(words: &str) -> usize {
    words
        .split(' ')
        .map(|word| word.chars().count())
        .max()
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::super::parsed::Element;
    use super::*;
    use normalight_model::{LightArchitecture, NormalArchitecture, PlainNormal};

    fn boxes(element: &Element) -> usize {
        let titled =
            element.name == "rect" && element.children.iter().any(|one| one.name == "title");
        usize::from(titled) + element.children.iter().map(boxes).sum::<usize>()
    }

    #[test]
    fn every_layer_is_a_box() {
        let mut plain = PlainNormal::new([16, 32, 64], 32);
        plain.pixel_branch = 8;
        let normal = NormalArchitecture {
            mask_channel: false,
            body: NormalBody::Plain(plain),
        };
        let networks = [
            (Architecture::Light(LightArchitecture::plain()), 1 + 5 + 5),
            (Architecture::Normal(normal), 1 + 7 + 5 + 2),
        ];
        for (network, expected) in networks {
            let drawings = network_drawings(&network);
            assert_eq!(drawings.len(), 1);
            assert_eq!(boxes(&Element::root(&drawings[0].1)), expected);
        }
        let paper = normalight_model::paper_genotypes().light.unwrap();
        let cells = normalight_model::CellLight {
            width: 8,
            stem_strides: [1, 2],
            reductions: 2,
            hidden: 16,
            genotype: paper.into(),
        };
        let light = LightArchitecture {
            body: LightBody::Cells(cells),
            ..LightArchitecture::plain()
        };
        let drawings = network_drawings(&Architecture::Light(light));
        assert_eq!(drawings.len(), 1 + LightGenotype::CELLS.len());
        // Input, two convolutions, N R N R N; two convolutions, N R, two convolutions, two fully connected layers.
        assert_eq!(
            boxes(&Element::root(&drawings[0].1)),
            1 + 2 + 5 + 2 + 2 + 2 + 2
        );
    }
}
