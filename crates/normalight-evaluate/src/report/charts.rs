//! Errors against the number of photographs, and against what was expected, as SVG.
use super::reliability::expecting;
use super::rows::{Quantity, shown};
use crate::published::PAPER_BY_IMAGES;
use crate::{EvaluateError, Method, Table, Training};
use plotters::prelude::*;
use plotters::style::register_font;
use std::sync::OnceLock;

const SIZE: (u32, u32) = (720, 420);
/// Readable on white and on black pages alike.
const TEXT: RGBColor = RGBColor(128, 136, 144);
const GRID: RGBAColor = RGBAColor(128, 136, 144, 0.25);
const FONT: &str = "sans-serif";

/// Colours of lines that are no method's.
const COLOURS: [RGBColor; 6] = [
    RGBColor(224, 122, 48),
    RGBColor(70, 140, 220),
    RGBColor(60, 165, 115),
    RGBColor(190, 100, 180),
    RGBColor(205, 70, 95),
    RGBColor(120, 130, 230),
];

/// The colour of a method's line.
fn colour(method: Method) -> RGBColor {
    match method {
        Method::Uncalibrated => RGBColor(224, 122, 48),
        Method::EstimatedLeastSquares => RGBColor(190, 100, 180),
        Method::Factorisation => RGBColor(205, 70, 95),
        Method::Calibrated => RGBColor(70, 140, 220),
        Method::Robust => RGBColor(60, 165, 115),
        Method::LeastSquares => RGBColor(120, 130, 230),
    }
}

/// A chart, and beside it, where no line hides it, what its lines mean.
pub(super) struct Chart {
    pub(super) svg: String,
    /// Names of the lines and their colours.
    pub(super) legend: Vec<(String, String)>,
}

/// A line of a chart: its name, its colour, and (photographs, degrees).
struct Line {
    name: String,
    colour: RGBColor,
    points: Vec<(f64, f64)>,
}

/// What the axes of a chart are.
struct Axes {
    x: &'static str,
    y: &'static str,
    /// Whether powers of two lie at equal distances.
    powers: bool,
}

/// The errors of each method over the number of photographs; `None` with fewer than two numbers.
///
/// # Errors
/// [`EvaluateError::Report`] when it cannot be drawn.
pub(super) fn by_images(
    tables: &[Table],
    quantity: Quantity,
) -> Result<Option<Chart>, EvaluateError> {
    let mut lines = lines(tables, quantity);
    if lines.iter().all(|line| line.points.len() < 2) {
        return Ok(None);
    }
    let all = || lines.iter().flat_map(|line| line.points.iter());
    let few = all().map(|point| point.0).fold(f64::INFINITY, f64::min);
    let many = all().map(|point| point.0).fold(0.0, f64::max);
    let mut shown = paper(quantity);
    shown.points.retain(|point| (few..=many).contains(&point.0));
    lines.push(shown);
    let axes = Axes {
        x: "photographs",
        y: match quantity {
            Quantity::Normals => "error of the normals in degrees",
            Quantity::Lights => "error of the lights in degrees",
        },
        powers: true,
    };
    draw(lines, axes).map(Some).map_err(failed)
}

/// The validation errors of trainings over their hours; `None` without any.
///
/// # Errors
/// [`EvaluateError::Report`] when it cannot be drawn.
pub(super) fn by_hours(trainings: &[Training]) -> Result<Option<Chart>, EvaluateError> {
    if trainings.is_empty() {
        return Ok(None);
    }
    let line = |(training, &colour): (&Training, &RGBColor)| Line {
        name: training.name.clone(),
        colour,
        points: training
            .points
            .iter()
            .map(|point| (point.hours, point.degrees))
            .collect(),
    };
    let lines = trainings.iter().zip(COLOURS.iter().cycle()).map(line);
    let axes = Axes {
        x: "hours of training",
        y: "validation error in degrees",
        powers: false,
    };
    draw(lines.collect(), axes).map(Some).map_err(failed)
}

/// The errors that were found over those that were expected, a line for each number of photographs; `None` without any.
///
/// # Errors
/// [`EvaluateError::Report`] when it cannot be drawn.
pub(super) fn by_expectation(tables: &[Table]) -> Result<Option<Chart>, EvaluateError> {
    let mut lines: Vec<Line> = expecting(tables)
        .zip(COLOURS.iter().cycle())
        .map(|((table, classes), &colour)| Line {
            name: format!("{}, {}", table.method.title(), table.title()),
            colour,
            points: classes
                .iter()
                .map(|class| (class.expected_degrees, class.found_degrees))
                .collect(),
        })
        .collect();
    let all = lines.iter().flat_map(|line| &line.points);
    let most = all.fold(0.0, |most, point| point.0.max(most));
    if lines.is_empty() {
        return Ok(None);
    }
    lines.push(Line {
        name: "As expected".to_owned(),
        colour: TEXT,
        points: vec![(0.0, 0.0), (most, most)],
    });
    let axes = Axes {
        x: "expected error in degrees",
        y: "error found in degrees",
        powers: false,
    };
    draw(lines, axes).map(Some).map_err(failed)
}

fn failed(error: Box<dyn std::error::Error>) -> EvaluateError {
    EvaluateError::Report(error.to_string())
}

fn lines(tables: &[Table], quantity: Quantity) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for method in Method::ALL {
        let mut points: Vec<(f64, f64)> = tables
            .iter()
            .filter(|table| table.method == method && table.disturbance.is_none())
            .filter(|table| table.failures.is_empty() && shown(tables, table, quantity))
            .filter_map(|table| {
                let images = table.objects.iter().map(|object| object.images).max()?;
                let mean = table.mean.as_ref()?;
                let degrees = match quantity {
                    Quantity::Normals => mean.normal_degrees()?,
                    Quantity::Lights => mean.light_degrees?,
                };
                Some((images as f64, degrees))
            })
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by_key(|point| point.0);
        if !points.is_empty() {
            lines.push(Line {
                name: method.title().to_owned(),
                colour: colour(method),
                points,
            });
        }
    }
    lines
}

/// The paper's figures are means of all ten objects of DiLiGenT.
fn paper(quantity: Quantity) -> Line {
    let point = |&(images, lights, normals): &(usize, f64, f64)| {
        let degrees = match quantity {
            Quantity::Normals => normals,
            Quantity::Lights => lights,
        };
        (images as f64, degrees)
    };
    Line {
        name: "The paper (ten objects, published)".to_owned(),
        colour: TEXT,
        points: PAPER_BY_IMAGES.iter().map(point).collect(),
    }
}

fn register() -> Result<(), Box<dyn std::error::Error>> {
    static KNOWN: OnceLock<bool> = OnceLock::new();
    match KNOWN
        .get_or_init(|| register_font(FONT, FontStyle::Normal, dejavu::sans::regular()).is_ok())
    {
        true => Ok(()),
        false => Err("the font is not one".into()),
    }
}

fn draw(lines: Vec<Line>, axes: Axes) -> Result<Chart, Box<dyn std::error::Error>> {
    register()?;
    let all = || lines.iter().flat_map(|line| line.points.iter().copied());
    let most = all().map(|point| point.1).fold(0.0, f64::max);
    let largest = all().map(|point| point.0).fold(0.0, f64::max);
    // Powers of two lie at equal distances.
    let place = |x: f64| if axes.powers { x.log2() } else { x };
    let (first, last, labels) = if axes.powers {
        let few = all().map(|point| point.0).fold(f64::INFINITY, f64::min);
        let between = largest.log2().floor() - few.log2().ceil();
        (few.log2(), largest.log2(), between.max(0.0) as usize + 1)
    } else {
        (0.0, largest * 1.05, 10)
    };
    let (mut svg, mut legend) = (String::new(), Vec::new());
    {
        let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        let words = |size: u32| (FONT, size).into_font().color(&TEXT);
        let mut chart = ChartBuilder::on(&area)
            .margin(14)
            .x_label_area_size(46)
            .y_label_area_size(58)
            .build_cartesian_2d(first..last, 0.0..most * 1.05)?;
        chart
            .configure_mesh()
            .x_desc(axes.x)
            .y_desc(axes.y)
            .axis_desc_style(words(15))
            .label_style(words(13))
            .x_labels(labels)
            .x_label_formatter(&|&x| match axes.powers {
                true => format!("{:.0}", x.exp2()),
                // As many digits as tell ten labels apart.
                false if last < 10.0 => format!("{x:.1}"),
                false => format!("{x:.0}"),
            })
            .axis_style(TEXT)
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .draw()?;
        for Line {
            name,
            colour,
            points,
        } in lines
        {
            let points = points.into_iter().map(|(x, y)| (place(x), y));
            let style = colour.stroke_width(2);
            chart.draw_series(LineSeries::new(points, style).point_size(3))?;
            let RGBColor(red, green, blue) = colour;
            legend.push((name, format!("#{red:02x}{green:02x}{blue:02x}")));
        }
        area.present()?;
    }
    Ok(Chart { svg, legend })
}
