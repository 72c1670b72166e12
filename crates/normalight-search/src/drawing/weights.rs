//! The weights of a relaxed cell over the steps of a search.
use super::{
    FAINT_INK, FONT_SIZE, FRAME, HEADER, INK, MARGIN, colour, input_name, page, rounded,
    short_name, text, text_width,
};
use normalight_model::{CellWeights, SearchSpace};
use svg::node::element::{Circle, Definitions, Group, Line, Path, Polyline, Rectangle, Use};

/// One panel's area, and the distance to the next.
const WIDTH: f64 = 150.0;
const HEIGHT: f64 = 80.0;
const PITCH: (f64, f64) = (172.0, 116.0);
/// Left of the first column, for the scale.
const SCALE: f64 = 26.0;
/// Between title and panels, for the legend.
const LEGEND: f64 = 38.0;
/// A line has no more points than these, and all together no more than these bytes of text.
const MOST_POINTS: usize = 200;
const MOST_BYTES: usize = 200_000;
const BYTES_OF_POINT: usize = 11;
const SHARE: &str = "#8c949d";

/// The weights of a relaxed cell over the steps of a search, as SVG: a row of panels for every node, one for each of its
/// inputs; from left to right the steps, from bottom to top 0 to 1.
///
/// `history` is (step, weights) by increasing step; weights that are not finite are left out.
pub(crate) fn weights_svg(
    title: &str,
    space: &SearchSpace,
    history: &[(usize, CellWeights)],
) -> Vec<u8> {
    let shares = has_shares(space, history);
    let edges: Vec<(usize, usize)> = space.edges().collect();
    let lines = edges.len() * (space.operations.len() + usize::from(shares));
    let most = MOST_BYTES / BYTES_OF_POINT / lines.max(1);
    let history = thinned(history, most.clamp(2, MOST_POINTS));

    let top = HEADER + LEGEND;
    let (legend, legend_end) = legend(space, shares);
    let panels_end = MARGIN + SCALE + space.nodes as f64 * PITCH.0 + WIDTH;
    let width = panels_end.max(legend_end) + MARGIN;
    let height = top + space.nodes as f64 * PITCH.1;
    let mut document = page(title, width, height)
        .add(Definitions::new().add(grid()))
        .add(legend);
    for (row, &(node, from)) in edges.iter().enumerate() {
        let corner = (
            MARGIN + SCALE + from as f64 * PITCH.0,
            top + node as f64 * PITCH.1,
        );
        let mut panel = Group::new()
            .set("class", "panel")
            .set("transform", format!("translate({} {})", corner.0, corner.1))
            .set("fill", "none")
            .set("stroke-width", 1.6)
            .set("stroke-linejoin", "round")
            .add(Use::new().set("href", "#normalight-panel"))
            .add(
                text(0.0, -6.0, &format!("node {node} from {}", input_name(from))).set("fill", INK),
            );
        if shares {
            let share = |weights: &CellWeights| weights.edges.get(row).copied();
            panel = curve(panel, &history, SHARE, Some("4 3"), share);
        }
        for (column, operation) in space.operations.iter().enumerate() {
            let weight = |weights: &CellWeights| {
                let edge = weights.operations.get(row)?;
                edge.get(column).copied()
            };
            panel = curve(panel, &history, colour(*operation), None, weight);
        }
        document = document.add(panel);
    }
    document
        .add(scales(space.nodes, top, &history))
        .to_string()
        .into_bytes()
}

/// Whether edges have weights of their own, other than equal shares for all of a node.
fn has_shares(space: &SearchSpace, history: &[(usize, CellWeights)]) -> bool {
    history.iter().any(|(_, weights)| {
        let mut edges = weights.edges.iter().zip(space.edges());
        edges.any(|(share, (node, _))| (share - 1.0 / (node + 2) as f32).abs() > 1e-4)
    })
}

/// At most so many points, evenly spread, the first and the last among them.
fn thinned(history: &[(usize, CellWeights)], most: usize) -> Vec<&(usize, CellWeights)> {
    let count = history.len().min(most);
    let last = history.len().saturating_sub(1);
    (0..count)
        .map(|index| &history[index * last / (count - 1).max(1)])
        .collect()
}

/// Adds one number over all steps to a panel; a dot if there is one step only.
fn curve(
    panel: Group,
    history: &[&(usize, CellWeights)],
    colour: &str,
    dashes: Option<&str>,
    value: impl Fn(&CellWeights) -> Option<f32>,
) -> Group {
    let (Some((first, _)), Some((last, _))) = (history.first(), history.last()) else {
        return panel;
    };
    let span = last.saturating_sub(*first).max(1) as f64;
    let place = |step: usize, value: f32| {
        let x = WIDTH * step.saturating_sub(*first) as f64 / span;
        let y = HEIGHT * (1.0 - f64::from(value.clamp(0.0, 1.0)));
        (rounded(x), rounded(y))
    };
    let points: Vec<(f64, f64)> = history
        .iter()
        .filter_map(|(step, weights)| Some((*step, value(weights)?)))
        .filter(|(_, value)| value.is_finite())
        .map(|(step, value)| place(step, value))
        .collect();
    if let [(x, y)] = points[..] {
        let dot = Circle::new().set("cx", x).set("cy", y).set("r", 3);
        return panel.add(dot.set("fill", colour));
    }
    let points: Vec<String> = points.iter().map(|(x, y)| format!("{x},{y}")).collect();
    let mut line = Polyline::new()
        .set("points", points.join(" "))
        .set("stroke", colour);
    if let Some(dashes) = dashes {
        line = line.set("stroke-dasharray", dashes);
    }
    panel.add(line)
}

/// What all panels share: the area, and lines at 0, a half and 1.
fn grid() -> Group {
    let area = Rectangle::new()
        .set("width", WIDTH)
        .set("height", HEIGHT)
        .set("fill", "#ffffff")
        .set("stroke", FRAME)
        .set("stroke-width", 1);
    let half = Line::new()
        .set("x2", WIDTH)
        .set("y1", HEIGHT / 2.0)
        .set("y2", HEIGHT / 2.0)
        .set("stroke", FRAME)
        .set("stroke-width", 1);
    Group::new()
        .set("id", "normalight-panel")
        .add(area)
        .add(half)
}

/// Names of all lines, in one row, and where it ends.
fn legend(space: &SearchSpace, shares: bool) -> (Group, f64) {
    let operations = space.operations.iter();
    let entries = operations
        .map(|one| (colour(*one), short_name(*one), None))
        .chain(shares.then_some((SHARE, "share of the edge", Some("4 3"))));
    let mut x = MARGIN + SCALE;
    let y = HEADER + 4.0;
    let mut group = Group::new().set("class", "legend");
    for (colour, name, dashes) in entries {
        let mut line = Path::new()
            .set("d", format!("M{x} {}h22", y - 4.0))
            .set("stroke", colour)
            .set("stroke-width", 3);
        if let Some(dashes) = dashes {
            line = line.set("stroke-dasharray", dashes).set("stroke-width", 2);
        }
        group = group.add(line).add(text(x + 28.0, y, name));
        x = (x + 28.0 + text_width(name, FONT_SIZE) + 18.0).round();
    }
    (group, x)
}

/// Numbers at the sides: weights at every row, steps below the last.
fn scales(nodes: usize, top: f64, history: &[&(usize, CellWeights)]) -> Group {
    let mut group = Group::new()
        .set("class", "scales")
        .set("fill", FAINT_INK)
        .set("font-size", 10.5);
    let left = MARGIN + SCALE;
    for node in 0..nodes {
        for (share, name) in [(0.0, "1"), (0.5, "0.5"), (1.0, "0")] {
            let y = top + node as f64 * PITCH.1 + HEIGHT * share + 3.5;
            group = group.add(text(left - 6.0, y, name).set("text-anchor", "end"));
        }
    }
    let y = top + (nodes.max(1) - 1) as f64 * PITCH.1 + HEIGHT + 15.0;
    let ends = match history {
        [] => vec![],
        [(only, _)] => vec![(0.0, "start", format!("step {only}"))],
        [(first, _), .., (last, _)] => vec![
            (0.0, "start", format!("step {first}")),
            (WIDTH, "end", last.to_string()),
        ],
    };
    for from in 0..=nodes {
        for (x, anchor, step) in &ends {
            let x = left + from as f64 * PITCH.0 + x;
            group = group.add(text(x, y, step).set("text-anchor", *anchor));
        }
    }
    group
}

#[cfg(test)]
mod tests;
