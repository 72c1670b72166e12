//! The light map: all lights of a stack in one picture.
use normalight_core::Light;
use svg::Document;
use svg::node::element::{Circle, Definitions, Group, Line, LinearGradient, Rectangle, Stop, Text};

/// Radius of the unit disc, in user units of a 520 x 412 picture.
const RADIUS: f64 = 180.0;
const CENTRE: (f64, f64) = (210.0, 216.0);
/// Circles of equal angle to the view axis, in degrees.
const RINGS: [f64; 2] = [30.0, 60.0];
const LEGEND_X: f64 = 442.0;
const LEGEND_TOP: f64 = 96.0;
const LEGEND_HEIGHT: f64 = 240.0;
/// Readable on white and on black pages alike.
const TEXT: &str = "#808890";
/// The disc brings its own dark ground, so that all colours of the map stand out on any page.
const DISC: &str = "#1b2028";
const GRID: &str = "#48515e";

/// The light map as SVG: the upper half of the sphere of directions seen from the camera, x to the
/// right, y up; each light is a point at (x, y) of its direction, its colour says its intensity
/// relative to the mean.
pub fn lights_svg(lights: &[Light]) -> Vec<u8> {
    lights_compared_svg(lights, &[])
}

/// The same with true lights: from each light a line to the true one of the same image, a ring.
pub fn lights_compared_svg(lights: &[Light], truth: &[Light]) -> Vec<u8> {
    let total: f32 = lights.iter().map(Light::mean_intensity).sum();
    let mean = f64::from(total / lights.len().max(1) as f32);
    let relative = |light: &Light| {
        let value = f64::from(light.mean_intensity()) / mean;
        if value.is_finite() { value } else { 1.0 }
    };
    let low = lights
        .iter()
        .map(relative)
        .fold(f64::INFINITY, f64::min)
        .min(0.9);
    let high = lights.iter().map(relative).fold(0.0, f64::max).max(1.1);

    let mut points = Group::new().set("stroke", DISC).set("stroke-width", 1);
    for (index, light) in lights.iter().enumerate() {
        let value = relative(light);
        let direction = light.direction.as_dvec3();
        let title = svg::node::element::Title::new(format!(
            "image {}: x {:.3}, y {:.3}, z {:.3}, intensity {value:.2}",
            index + 1,
            direction.x,
            direction.y,
            direction.z,
        ));
        let (x, y) = place(light);
        let point = Circle::new()
            .set("cx", x)
            .set("cy", y)
            .set("r", 6)
            .set("fill", colour((value - low) / (high - low)))
            .add(title);
        points = points.add(point);
    }
    let mut document = Document::new()
        .set("viewBox", (0, 0, 520, 412))
        .set("width", 520)
        .set("height", 412)
        .set("font-family", "system-ui, sans-serif")
        .set("font-size", 13)
        .add(disc());
    if !truth.is_empty() {
        document = document.add(errors(lights, truth));
    }
    let document = legend(document.add(points).add(ring_labels()), low, high);
    document.to_string().into_bytes()
}

/// Where a light stands in the picture.
fn place(light: &Light) -> (f64, f64) {
    let direction = light.direction.as_dvec3();
    (
        rounded(CENTRE.0 + RADIUS * direction.x),
        rounded(CENTRE.1 - RADIUS * direction.y),
    )
}

/// True lights as rings, with lines to what was taken for them.
fn errors(lights: &[Light], truth: &[Light]) -> Group {
    let group = Group::new()
        .set("stroke", TEXT)
        .set("stroke-width", 1.5)
        .set("fill", "none");
    lights
        .iter()
        .zip(truth)
        .fold(group, |group, (light, truth)| {
            let ((x1, y1), (x2, y2)) = (place(light), place(truth));
            let line = Line::new()
                .set("x1", x1)
                .set("y1", y1)
                .set("x2", x2)
                .set("y2", y2);
            let ring = Circle::new().set("cx", x2).set("cy", y2).set("r", 4);
            group.add(line).add(ring)
        })
}

/// The disc with circles at 30, 60 and 90 degrees from the view axis.
fn disc() -> Group {
    let circle = |radius: f64| {
        Circle::new()
            .set("cx", CENTRE.0)
            .set("cy", CENTRE.1)
            .set("r", rounded(radius))
    };
    let line = |dx: f64, dy: f64| {
        Line::new()
            .set("x1", CENTRE.0 - dx)
            .set("y1", CENTRE.1 - dy)
            .set("x2", CENTRE.0 + dx)
            .set("y2", CENTRE.1 + dy)
    };
    let mut grid = Group::new()
        .set("stroke", GRID)
        .set("stroke-width", 1)
        .set("fill", "none")
        .add(circle(RADIUS).set("fill", DISC))
        .add(line(RADIUS, 0.0))
        .add(line(0.0, RADIUS));
    for radius in RINGS.map(ring_radius) {
        grid = grid.add(circle(radius).set("stroke-dasharray", "3 4"));
    }
    let axes = Group::new()
        .set("fill", TEXT)
        .add(label(
            CENTRE.0 + RADIUS + 8.0,
            CENTRE.1 + 4.0,
            "x".to_owned(),
        ))
        .add(label(
            CENTRE.0 - 3.0,
            CENTRE.1 - RADIUS - 9.0,
            "y".to_owned(),
        ));
    Group::new().add(grid).add(axes)
}

/// The angles of the circles, over the points, with a rim that parts them from what lies below.
fn ring_labels() -> Group {
    RINGS.iter().fold(
        Group::new()
            .set("fill", TEXT)
            .set("font-size", 11)
            .set("text-anchor", "middle")
            .set("stroke", DISC)
            .set("stroke-width", 4)
            .set("paint-order", "stroke"),
        |group, &degrees| {
            let y = CENTRE.1 + ring_radius(degrees) + 4.0;
            group.add(label(CENTRE.0, y, format!("{degrees}°")))
        },
    )
}

fn ring_radius(degrees: f64) -> f64 {
    RADIUS * degrees.to_radians().sin()
}

fn legend(document: Document, low: f64, high: f64) -> Document {
    let mut gradient = LinearGradient::new()
        .set("id", "normalight-intensity")
        .set("x1", 0)
        .set("y1", 1)
        .set("x2", 0)
        .set("y2", 0);
    for step in 0..=8 {
        let fraction = f64::from(step) / 8.0;
        let stop = Stop::new()
            .set("offset", fraction)
            .set("stop-color", colour(fraction));
        gradient = gradient.add(stop);
    }
    let bar = Rectangle::new()
        .set("x", LEGEND_X)
        .set("y", LEGEND_TOP)
        .set("width", 14)
        .set("height", LEGEND_HEIGHT)
        .set("rx", 3)
        .set("fill", "url(#normalight-intensity)");
    let mut words = Group::new()
        .set("fill", TEXT)
        .add(label(
            LEGEND_X - 14.0,
            LEGEND_TOP - 32.0,
            "intensity".to_owned(),
        ))
        .add(
            label(LEGEND_X - 14.0, LEGEND_TOP - 15.0, "(mean = 1)".to_owned()).set("font-size", 11),
        );
    for step in 0..=4 {
        let fraction = f64::from(step) / 4.0;
        words = words.add(label(
            LEGEND_X + 22.0,
            LEGEND_TOP + LEGEND_HEIGHT * (1.0 - fraction) + 4.0,
            format!("{:.2}", low + (high - low) * fraction),
        ));
    }
    document
        .add(Definitions::new().add(gradient))
        .add(bar)
        .add(words)
}

fn label(x: f64, y: f64, words: String) -> Text {
    Text::new(words).set("x", rounded(x)).set("y", rounded(y))
}

/// A colour of equal perceived steps (plasma); its darkest part would drown in the disc.
fn colour(fraction: f64) -> String {
    let colour = colorous::PLASMA.eval_continuous(0.28 + 0.72 * fraction.clamp(0.0, 1.0));
    format!("#{colour:x}")
}

fn rounded(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}
