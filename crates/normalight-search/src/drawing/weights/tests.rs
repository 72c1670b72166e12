use super::super::parsed::Element;
use super::*;
use normalight_model::Operation;

fn space(nodes: usize) -> SearchSpace {
    SearchSpace {
        nodes,
        ..SearchSpace::default()
    }
}

/// Equal shares, and operations that differ from edge to edge and from step to step.
fn weights(space: &SearchSpace, time: f32) -> CellWeights {
    let count = space.operations.len();
    let row = |edge: usize| -> Vec<f32> {
        let scores = (0..count).map(|one| (time * (one * (edge + 1) % 7) as f32).exp());
        let sum: f32 = scores.clone().sum();
        scores.map(|score| score / sum).collect()
    };
    CellWeights {
        operations: (0..space.edges().count()).map(row).collect(),
        edges: space
            .edges()
            .map(|(node, _)| 1.0 / (node + 2) as f32)
            .collect(),
    }
}

fn history(space: &SearchSpace, count: usize) -> Vec<(usize, CellWeights)> {
    let times = (0..count).map(|step| (step * 10, weights(space, step as f32 / count as f32)));
    times.collect()
}

fn drawn(space: &SearchSpace, history: &[(usize, CellWeights)]) -> Element {
    Element::root(&weights_svg("weights", space, history))
}

#[test]
fn lines_begin_and_end_where_the_weights_do() {
    let space = SearchSpace {
        operations: vec![Operation::Skip, Operation::Convolution3],
        ..space(1)
    };
    let at = |first: f32, second: f32, share: f32| CellWeights {
        operations: vec![vec![first, 1.0 - first], vec![second, 1.0 - second]],
        edges: vec![share, 1.0 - share],
    };
    let history = [
        (100, at(0.5, 0.5, 0.5)),
        (150, at(0.5, f32::NAN, 0.5)),
        (300, at(0.75, 0.0, 0.875)),
    ];
    let drawing = drawn(&space, &history);
    // A panel is 150 wide and 80 high; the dashed share comes first, as it lies below.
    let expected = [
        [
            ("#8c949d", vec![0.0, 40.0, 37.5, 40.0, 150.0, 10.0]),
            ("#009468", vec![0.0, 40.0, 37.5, 40.0, 150.0, 20.0]),
            ("#d55e00", vec![0.0, 40.0, 37.5, 40.0, 150.0, 60.0]),
        ],
        [
            ("#8c949d", vec![0.0, 40.0, 37.5, 40.0, 150.0, 70.0]),
            ("#009468", vec![0.0, 40.0, 150.0, 80.0]),
            ("#d55e00", vec![0.0, 40.0, 150.0, 0.0]),
        ],
    ];
    assert_eq!(drawing.of_class("panel").count(), 2);
    for (panel, lines) in drawing.of_class("panel").zip(expected) {
        let polylines = panel.named("polyline");
        let found: Vec<_> = polylines
            .map(|line| (&line.attributes["stroke"][..], line.numbers("points")))
            .collect();
        assert_eq!(found, lines);
        let dashed = panel
            .named("polyline")
            .map(|one| one.attributes.contains_key("stroke-dasharray"));
        assert_eq!(dashed.collect::<Vec<_>>(), [true, false, false]);
    }
    let steps = drawing.of_class("scales").next().unwrap().named("text");
    let steps: Vec<_> = steps.map(|one| &one.text[..]).collect();
    assert_eq!(steps[3..], ["step 100", "300", "step 100", "300"]);
}

#[test]
fn any_cell_and_any_length_fit() {
    for (nodes, count) in [(1, 0), (1, 1), (2, 2), (4, 700), (9, 150), (16, 1000)] {
        let space = space(nodes);
        let mut history = history(&space, count);
        if nodes == 16 {
            for (_, weights) in &mut history {
                weights.edges[0] = 0.7;
            }
        }
        let bytes = weights_svg("weights", &space, &history);
        assert!(bytes.len() < 300_000, "{} bytes", bytes.len());
        let drawing = Element::root(&bytes);
        assert_eq!(drawing.of_class("panel").count(), space.edges().count());
        let (width, height) = (drawing.number("width"), drawing.number("height"));
        let mut corners = Vec::new();
        for panel in drawing.of_class("panel") {
            let corner = panel.numbers("transform");
            assert!(corner[0] + 150.0 < width && corner[1] + 80.0 < height);
            corners.push(format!("{corner:?}"));
            let lines = 6 + usize::from(nodes == 16);
            let (dots, polylines) = (panel.named("circle"), panel.named("polyline"));
            assert_eq!(dots.count(), if count == 1 { lines } else { 0 });
            assert_eq!(polylines.clone().count(), if count > 1 { lines } else { 0 });
            for line in polylines {
                let points = line.numbers("points");
                assert!(points.len() <= 2 * 200 && points.len() >= 2 * count.min(15));
                assert_eq!((points[0], points[points.len() - 2]), (0.0, 150.0));
            }
        }
        corners.sort();
        corners.dedup();
        assert_eq!(
            corners.len(),
            space.edges().count(),
            "panels lie on each other"
        );
        let legend = drawing.of_class("legend").next().unwrap();
        let ends = legend
            .named("text")
            .map(|one| one.number("x") + one.text.len() as f64 * 7.0);
        assert!(ends.fold(0.0, f64::max) < width);
    }
}

#[test]
fn panels_are_named_and_equal_shares_are_not_drawn() {
    let space = space(2);
    let drawing = drawn(&space, &history(&space, 5));
    let titles = drawing
        .of_class("panel")
        .map(|one| &one.child("text").text[..]);
    assert_eq!(
        titles.collect::<Vec<_>>(),
        [
            "node 0 from c(k-2)",
            "node 0 from c(k-1)",
            "node 1 from c(k-2)",
            "node 1 from c(k-1)",
            "node 1 from node 0",
        ]
    );
    for panel in drawing.of_class("panel") {
        let mut lines = panel.named("polyline");
        assert!(lines.all(|line| !line.attributes.contains_key("stroke-dasharray")));
    }
    let legend = drawing.of_class("legend").next().unwrap();
    let names: Vec<_> = legend.named("text").map(|one| &one.text[..]).collect();
    assert_eq!(
        names,
        ["sep 1x1", "sep 3x3", "sep 5x5", "conv 3x3", "skip", "zero"]
    );
}
