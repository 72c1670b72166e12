use super::super::parsed::Element;
use super::*;
use normalight_model::paper_genotypes;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

fn random_cell(nodes: usize, seed: u64) -> Cell {
    let mut random = Pcg32::new(seed, 0);
    let mut below = |count: usize| random.next_u32() as usize % count;
    let mut edge = |node: usize| Edge {
        operation: Operation::ALL[below(Operation::ALL.len())],
        from: below(node + 2),
    };
    Cell {
        nodes: (0..nodes).map(|node| [edge(node), edge(node)]).collect(),
    }
}

/// The published cells, random ones, and one whose edges are all the same.
fn cells() -> Vec<Cell> {
    let paper = paper_genotypes();
    let (light, normal) = (paper.light.unwrap(), paper.normal.unwrap());
    let mut cells: Vec<Cell> = light.cells().into_iter().cloned().collect();
    cells.extend(normal.cells().into_iter().cloned());
    assert_eq!(cells.len(), 7);
    for nodes in [1, 2, 8, 16] {
        cells.extend((0..6).map(|seed| random_cell(nodes, seed)));
    }
    let same = Edge {
        operation: Operation::Skip,
        from: 0,
    };
    cells.push(Cell {
        nodes: vec![[same; 2]; 3],
    });
    cells
}

fn drawn(cell: &Cell) -> Element {
    Element::root(&cell_svg("a cell", cell))
}

/// Inputs, nodes and the output as `[left, top, right, bottom]`, in the order of `Edge::from`, the output last.
fn boxes(drawing: &Element) -> Vec<[f64; 4]> {
    let mut boxes = Vec::new();
    for (class, first) in [("input", "c(k-2)"), ("node", "0"), ("output", "c(k)")] {
        let names = drawing.of_class(class).map(|one| &one.child("text").text);
        assert_eq!(names.clone().next().unwrap(), first);
        if class == "node" {
            let numbers = names.map(|name| name.parse::<usize>().unwrap());
            assert!(numbers.enumerate().all(|(place, number)| place == number));
        }
        boxes.extend(drawing.of_class(class).map(|one| one.child("rect").sides()));
    }
    boxes
}

/// The boxes that a line joins.
fn ends(edge: &Element, boxes: &[[f64; 4]]) -> (usize, usize) {
    let start = edge.child("path").numbers("d");
    let [_, _, x, y, ..] = edge.child("polygon").numbers("points")[..] else {
        panic!("an arrow head without a tip");
    };
    let at = |x: f64, y: f64, side: usize| {
        let touches = |one: &[f64; 4]| (one[side] - x).abs() < 0.2 && one[1] < y && y < one[3];
        boxes.iter().position(touches).unwrap()
    };
    (at(start[0], start[1], 2), at(x, y, 0))
}

#[test]
fn a_drawing_can_be_read_back() {
    for cell in cells() {
        let drawing = drawn(&cell);
        let boxes = boxes(&drawing);
        assert_eq!(boxes.len(), cell.nodes.len() + 3);
        let mut read: Vec<_> = drawing
            .of_class("edge")
            .map(|edge| {
                let (from, to) = ends(edge, &boxes);
                let name = edge.child("text").text.clone();
                let colour = edge.child("path").attributes["stroke"].clone();
                assert_eq!(colour, edge.child("polygon").attributes["fill"]);
                (to, from, name, colour)
            })
            .collect();
        let mut expected = Vec::new();
        for (node, edge) in cell.nodes.iter().enumerate().flat_map(|(node, edges)| {
            let edges = edges.iter();
            edges.map(move |edge| (node, edge))
        }) {
            let (name, colour) = match edge.operation {
                Operation::Separable1 => ("sep 1x1", "#41a9e0"),
                Operation::Separable3 => ("sep 3x3", "#0a58a8"),
                Operation::Separable5 => ("sep 5x5", "#b0549b"),
                Operation::Convolution3 => ("conv 3x3", "#d55e00"),
                Operation::Skip => ("skip", "#009468"),
                Operation::Zero => ("zero", "#8c949d"),
            };
            expected.push((node + 2, edge.from, name.to_owned(), colour.to_owned()));
        }
        read.sort();
        expected.sort();
        assert_eq!(read, expected);
        let mut concatenated: Vec<_> = drawing
            .of_class("concatenation")
            .map(|edge| ends(edge, &boxes))
            .collect();
        concatenated.sort_unstable();
        let output = cell.nodes.len() + 2;
        let nodes: Vec<_> = (2..output).map(|node| (node, output)).collect();
        assert_eq!(concatenated, nodes);
    }
}

/// Where a label's letters are, if they are wide ones.
fn label(edge: &Element) -> [f64; 4] {
    let text = edge.child("text");
    let size = text.number("font-size");
    let half = text.text.len() as f64 * size * 0.65 / 2.0;
    let (x, y) = (text.number("x"), text.number("y"));
    [x - half, y - 0.8 * size, x + half, y + 0.25 * size]
}

/// Points on a line of cubic curves.
fn sampled(path: &[f64]) -> Vec<(f64, f64)> {
    let points: Vec<_> = path.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    let curves = (0..points.len() - 1)
        .step_by(3)
        .map(|at| &points[at..at + 4]);
    let at = |curve: &[(f64, f64)], t: f64| {
        let s = 1.0 - t;
        let factors = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let sum = |pick: fn(&(f64, f64)) -> f64| -> f64 {
            factors.iter().zip(curve).map(|(a, b)| a * pick(b)).sum()
        };
        (sum(|one| one.0), sum(|one| one.1))
    };
    curves
        .flat_map(|curve| (0..=20).map(move |step| at(curve, f64::from(step) / 20.0)))
        .collect()
}

#[test]
fn nothing_hides_a_label_or_a_box() {
    let overlap =
        |a: &[f64; 4], b: &[f64; 4]| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
    for cell in cells() {
        let drawing = drawn(&cell);
        let labels: Vec<_> = drawing.of_class("edge").map(label).collect();
        let mut areas = labels.clone();
        areas.extend(boxes(&drawing));
        let (width, height) = (drawing.number("width"), drawing.number("height"));
        for (index, one) in areas.iter().enumerate() {
            assert!(one[0] > 0.0 && one[1] > 40.0 && one[2] < width && one[3] < height);
            assert!(
                areas[..index].iter().all(|other| !overlap(one, other)),
                "{cell:?}"
            );
        }
        let edges = drawing
            .of_class("edge")
            .chain(drawing.of_class("concatenation"));
        for (index, edge) in edges.enumerate() {
            for (x, y) in sampled(&edge.child("path").numbers("d")) {
                for (other, area) in areas.iter().enumerate() {
                    let near = [x - 1.0, y - 1.0, x + 1.0, y + 1.0];
                    let own = other == index && index < labels.len();
                    // At its ends a line touches the sides of boxes.
                    let inner = [area[0] + 1.5, area[1], area[2] - 1.5, area[3]];
                    assert!(
                        own || !overlap(&near, &inner),
                        "{cell:?}: {x} {y} in {area:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn two_edges_between_the_same_boxes_are_seen_as_two() {
    let same = Edge {
        operation: Operation::Skip,
        from: 1,
    };
    let cell = Cell {
        nodes: vec![[same; 2]],
    };
    let drawing = drawn(&cell);
    let lines = drawing
        .of_class("edge")
        .map(|edge| sampled(&edge.child("path").numbers("d")));
    let lines: Vec<_> = lines.collect();
    for (a, b) in lines[0].iter().zip(&lines[1]) {
        assert!((a.1 - b.1).abs() > 8.0, "{a:?} {b:?}");
    }
}

#[test]
fn titles_may_hold_anything() {
    let cell = random_cell(1, 0);
    let drawing = Element::root(&cell_svg("<b> & \"c\"\u{1}\n", &cell));
    assert_eq!(drawing.child("text").text, "&lt;b&gt; &amp; \"c\"");
    let long = Element::root(&cell_svg(&"x".repeat(300), &cell));
    assert!(long.number("width") > 300.0 * 9.0);
}
