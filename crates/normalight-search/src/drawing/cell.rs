//! A derived cell as a directed graph.
use super::layers::Layers;
use super::{HEADER, MARGIN, colour, input_name, page, rounded, short_name, text};
use normalight_model::{Cell, Edge, Operation};
use svg::node::element::{Group, Path, Polygon, Rectangle};

/// Columns of boxes and of labels take turns; between them edges may bend and cross.
const BOX_WIDTH: f64 = 44.0;
const INPUT_WIDTH: f64 = 58.0;
const BOX_HEIGHT: f64 = 36.0;
const LABEL_WIDTH: f64 = 62.0;
const LABEL_HEIGHT: f64 = 18.0;
const LABEL_SIZE: f64 = 11.5;
const BEND_WIDTH: f64 = 38.0;
/// Space above and below boxes and labels, and what an edge takes that only passes.
const GAP: f64 = 12.0;
const PASSING_HEIGHT: f64 = 12.0;
/// How far a passing edge may rise from the middle of a column to its side and stay clear of its neighbours.
const PASSING_RISE: f64 = 4.0;
/// Between edges that meet at a box.
const PORT_DISTANCE: f64 = 12.0;
const ARROW: f64 = 8.0;
/// Edges to the output say nothing but that they are there.
const CONCATENATION: &str = "#c3c9d0";

/// An edge from box to box.
struct Route {
    /// Boxes, and what the edge passes between them.
    items: Vec<usize>,
    /// None: to the output.
    operation: Option<Operation>,
}

impl Route {
    /// The item that is its label.
    fn labelled(&self) -> Option<usize> {
        self.operation.map(|_| self.items[self.items.len() - 2])
    }
}

/// One derived cell as SVG.
///
/// The cell is one that [`Cell::validate`] accepts.
pub(crate) fn cell_svg(title: &str, cell: &Cell) -> Vec<u8> {
    let ranks = ranks(cell);
    let output_rank = ranks.iter().max().map_or(1, |rank| rank + 1);
    let mut layers = Layers::new(2 * output_rank);
    let boxes = add_boxes(&mut layers, cell, &ranks, output_rank);
    let routes = add_routes(&mut layers, cell, &boxes);
    let height = layers.arrange();

    let drawing = Drawing {
        columns: columns(output_rank),
        layers,
        routes,
    };
    let right = drawing.columns[2 * output_rank - 1].1 + MARGIN;
    let mut document = page(title, right, HEADER + height + MARGIN);
    for group in drawing.edges() {
        document = document.add(group);
    }
    for (index, &item) in boxes.iter().enumerate() {
        let (class, name, fill, stroke) = match index {
            0 | 1 => ("input", input_name(index), "#d9efd8", "#5b9a5b"),
            _ if index + 1 == boxes.len() => ("output", "c(k)".to_owned(), "#fbeeb8", "#c19c2a"),
            _ => ("node", (index - 2).to_string(), "#d8e6f7", "#5b86bd"),
        };
        let height = box_height(cell, index);
        document = document.add(drawing.boxed(item, height, name, [class, fill, stroke]));
    }
    document.to_string().into_bytes()
}

/// Longest way from the inputs to every input and node.
fn ranks(cell: &Cell) -> Vec<usize> {
    let mut ranks = vec![0, 0];
    for edges in &cell.nodes {
        let before = edges.iter().map(|edge| ranks[edge.from]).max();
        ranks.push(before.unwrap_or(0) + 1);
    }
    ranks
}

/// Left and right end of every column; as nothing is written on edges to the output, it has no labels before it.
fn columns(output_rank: usize) -> Vec<(f64, f64)> {
    let mut left = MARGIN;
    let widths = (0..2 * output_rank).map(|column| match column {
        0 => INPUT_WIDTH,
        _ if column % 2 == 0 || column + 1 == 2 * output_rank => BOX_WIDTH,
        _ => LABEL_WIDTH,
    });
    widths
        .map(|width| {
            let column = (left, left + width);
            left += width + BEND_WIDTH;
            column
        })
        .collect()
}

/// Tall enough for all edges that leave or enter; inputs, nodes and the output are numbered in this order.
fn box_height(cell: &Cell, index: usize) -> f64 {
    let nodes = cell.nodes.len();
    let reading = cell.nodes.iter().flatten();
    let reading = reading.filter(|edge| edge.from == index).count();
    let edges = match index {
        0 | 1 => reading,
        _ if index == nodes + 2 => nodes,
        _ => reading + 1,
    };
    BOX_HEIGHT.max(edges as f64 * PORT_DISTANCE + 4.0)
}

/// Adds inputs, nodes and the output.
fn add_boxes(layers: &mut Layers, cell: &Cell, ranks: &[usize], output_rank: usize) -> Vec<usize> {
    let ranks = ranks.iter().chain([&output_rank]).enumerate();
    ranks
        .map(|(index, &rank)| {
            let column = 2 * rank - usize::from(rank == output_rank);
            layers.add(column, box_height(cell, index) + GAP, true)
        })
        .collect()
}

/// Adds what edges pass on their way: their own label just before their end, and space at all other columns.
fn add_routes(layers: &mut Layers, cell: &Cell, boxes: &[usize]) -> Vec<Route> {
    let nodes = cell.nodes.iter().enumerate();
    let searched = nodes.flat_map(|(node, edges)| {
        let ends = move |edge: &Edge| (edge.from, node + 2, Some(edge.operation));
        edges.iter().map(ends)
    });
    let output = cell.nodes.len() + 2;
    let to_output = (2..output).map(|node| (node, output, None));
    let mut routes = Vec::new();
    for (from, to, operation) in searched.chain(to_output) {
        let mut items = vec![boxes[from]];
        let end = layers.column(boxes[to]);
        for column in layers.column(boxes[from]) + 1..end {
            let height = match operation {
                Some(_) if column + 1 == end => LABEL_HEIGHT + GAP,
                _ => PASSING_HEIGHT,
            };
            let item = layers.add(column, height, false);
            layers.link(items[items.len() - 1], item);
            items.push(item);
        }
        layers.link(items[items.len() - 1], boxes[to]);
        items.push(boxes[to]);
        routes.push(Route { items, operation });
    }
    routes
}

/// A cell's graph with everything in its place.
struct Drawing {
    columns: Vec<(f64, f64)>,
    layers: Layers,
    routes: Vec<Route>,
}

impl Drawing {
    /// Edges to the output first, as they lie below.
    fn edges(&self) -> Vec<Group> {
        let starts = self.ports(|route| [route.items[0], route.items[1]]);
        let ends = self.ports(|route| {
            let last = route.items.len() - 1;
            [route.items[last], route.items[last - 1]]
        });
        let mut routes: Vec<_> = self
            .routes
            .iter()
            .zip(starts.into_iter().zip(ends))
            .collect();
        routes.sort_by_key(|(route, _)| route.operation.is_some());
        let edges = routes.into_iter();
        edges
            .map(|(route, (start, end))| self.edge(route, start, end))
            .collect()
    }

    /// Where every route meets the box at one of its ends, given as (box, neighbour): one below the other in the order
    /// of the neighbours, so that edges do not cross at the box.
    fn ports(&self, ends: impl Fn(&Route) -> [usize; 2]) -> Vec<f64> {
        let ends: Vec<_> = self.routes.iter().map(ends).collect();
        let port = |[at, neighbour]: &[usize; 2]| {
            let others = ends.iter().filter(|[other, _]| other == at);
            let place = |one: usize| self.layers.y(one);
            let above = others
                .clone()
                .filter(|[_, other]| place(*other) < place(*neighbour))
                .count();
            let middle = (others.count() - 1) as f64 / 2.0;
            self.y(*at) + (above as f64 - middle) * PORT_DISTANCE
        };
        ends.iter().map(port).collect()
    }

    fn y(&self, item: usize) -> f64 {
        HEADER + self.layers.y(item)
    }

    /// Left and right end of an item's column.
    fn sides(&self, item: usize) -> (f64, f64) {
        self.columns[self.layers.column(item)]
    }

    /// A smooth line with its arrow head and label.
    fn edge(&self, route: &Route, start: f64, end: f64) -> Group {
        let colour = route.operation.map_or(CONCATENATION, colour);
        let mut line = Path::new()
            .set("d", smooth(&self.points(route, start, end)))
            .set("fill", "none")
            .set("stroke", colour);
        if route.operation == Some(Operation::Zero) {
            line = line.set("stroke-dasharray", "5 4");
        }
        let base = self.sides(route.items[route.items.len() - 1]).0 - ARROW;
        let corners = [(0.0, -0.5), (1.0, 0.0), (0.0, 0.5)];
        let corners = corners.map(|(x, y)| {
            let (x, y) = (base + ARROW * x, end + ARROW * y);
            format!("{},{}", rounded(x), rounded(y))
        });
        let head = Polygon::new()
            .set("points", corners.join(" "))
            .set("fill", colour);
        let (class, width) = match route.operation {
            Some(_) => ("edge", 2.0),
            None => ("concatenation", 1.4),
        };
        let group = Group::new()
            .set("class", class)
            .add(line.set("stroke-width", width))
            .add(head);
        match (route.operation, route.labelled()) {
            (Some(operation), Some(item)) => self.label(group, operation, item),
            _ => group,
        }
    }

    /// Points of an edge from `start` to the foot of its arrow head, each with the slope there: level at boxes and at its
    /// label, and nearly so where it passes others.
    fn points(&self, route: &Route, start: f64, end: f64) -> Vec<((f64, f64), f64)> {
        let last = route.items.len() - 1;
        let mut centres = vec![(self.sides(route.items[0]).1, start)];
        for &item in &route.items[1..last] {
            let (left, right) = self.sides(item);
            centres.push(((left + right) / 2.0, self.y(item)));
        }
        centres.push((self.sides(route.items[last]).0 - ARROW, end));
        let mut points = vec![(centres[0], 0.0)];
        for (&item, centres) in route.items[1..last].iter().zip(centres.windows(3)) {
            let (left, right) = self.sides(item);
            let half = (right - left) / 2.0;
            let most = match route.labelled() {
                Some(labelled) if labelled == item => 0.0,
                _ => PASSING_RISE / half,
            };
            let slope = slope(centres).clamp(-most, most);
            let (x, y) = centres[1];
            points.extend([-half, half].map(|dx| ((x + dx, y + slope * dx), slope)));
        }
        points.push((centres[last], 0.0));
        points
    }

    /// Adds an operation's name to its edge.
    fn label(&self, edge: Group, operation: Operation, item: usize) -> Group {
        let (left, right) = self.sides(item);
        let y = self.y(item);
        let ground = Rectangle::new()
            .set("x", rounded(left))
            .set("y", rounded(y - LABEL_HEIGHT / 2.0))
            .set("width", LABEL_WIDTH)
            .set("height", LABEL_HEIGHT)
            .set("rx", LABEL_HEIGHT / 2.0)
            .set("fill", "#ffffff")
            .set("stroke", colour(operation))
            .set("stroke-width", 1.4);
        let name = text((left + right) / 2.0, y + 4.0, short_name(operation))
            .set("font-size", LABEL_SIZE)
            .set("text-anchor", "middle");
        edge.add(ground).add(name)
    }

    /// A box with its name.
    fn boxed(
        &self,
        item: usize,
        height: f64,
        name: String,
        [class, fill, stroke]: [&str; 3],
    ) -> Group {
        let (left, right) = self.sides(item);
        let y = self.y(item);
        let shape = Rectangle::new()
            .set("x", rounded(left))
            .set("y", rounded(y - height / 2.0))
            .set("width", rounded(right - left))
            .set("height", height)
            .set("rx", 7)
            .set("fill", fill)
            .set("stroke", stroke)
            .set("stroke-width", 1.4);
        let name = text((left + right) / 2.0, y + 4.5, &name)
            .set("font-size", 13)
            .set("text-anchor", "middle");
        Group::new().set("class", class).add(shape).add(name)
    }
}

/// Slope of a smooth line in the middle one of three points: it never leaves the range of its points.
fn slope(points: &[(f64, f64)]) -> f64 {
    let between = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0);
    let (before, after) = (between(points[0], points[1]), between(points[1], points[2]));
    if before * after <= 0.0 {
        0.0
    } else if before.abs() < after.abs() {
        before
    } else {
        after
    }
}

/// Through all points with the slope at each.
fn smooth(points: &[((f64, f64), f64)]) -> String {
    let ((x, y), _) = points[0];
    let mut path = format!("M{} {}", rounded(x), rounded(y));
    for pair in points.windows(2) {
        let [((x, y), slope), ((to_x, to_y), to_slope)] = [pair[0], pair[1]];
        let half = (to_x - x) / 2.0;
        let numbers = [
            x + half,
            y + slope * half,
            x + half,
            to_y - to_slope * half,
            to_x,
            to_y,
        ];
        let numbers = numbers.map(|number| rounded(number).to_string());
        path += &format!(" C{}", numbers.join(" "));
    }
    path
}

#[cfg(test)]
mod tests;
