//! The course of a run as numbers and as a picture.
use crate::RunError;
use normalight_io::write_files;
use plotters::prelude::*;
use plotters::style::register_font;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{Cursor, ErrorKind};
use std::path::Path;
use std::sync::OnceLock;

const CSV: &str = "curves.csv";
const PNG: &str = "curves.png";
/// Size of the picture in pixels.
const SIZE: (u32, u32) = (900, 800);
/// Columns before those of the figures.
const COLUMNS: &str = "step,loss,validation_degrees,learning_rate,seconds";

/// One line of the table.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    pub step: usize,
    /// Mean loss since the line before.
    pub loss: f32,
    /// Validation error in degrees.
    pub error: f32,
    /// Learning rate.
    pub rate: f32,
    /// Seconds of training so far.
    pub seconds: f64,
    /// More about the validation, by name.
    pub figures: BTreeMap<String, f32>,
}

/// Writes `curves.csv` and `curves.png` into the run's folder.
pub(crate) fn write(folder: &Path, points: &[Point]) -> Result<(), RunError> {
    let mut csv = COLUMNS.to_owned();
    for name in points.iter().flat_map(|point| point.figures.keys()).take(
        // All lines have the same figures.
        points.first().map_or(0, |point| point.figures.len()),
    ) {
        let _ = write!(csv, ",{name}");
    }
    csv.push('\n');
    for point in points {
        let Point {
            step,
            loss,
            error,
            rate,
            seconds,
            figures,
        } = point;
        let _ = write!(csv, "{step},{loss},{error},{rate},{seconds:.1}");
        for value in figures.values() {
            let _ = write!(csv, ",{value}");
        }
        csv.push('\n');
    }
    write_files(folder, &[(CSV, csv.into_bytes())])?;
    if points.len() < 2 {
        return Ok(());
    }
    let png = draw(points).map_err(|error| RunError::Plot(error.to_string()))?;
    Ok(write_files(folder, &[(PNG, png)])?)
}

/// Reads `curves.csv` back; no points where there is no such file yet.
///
/// # Errors
/// A file that cannot be read, or that is not such a table: it would be overwritten otherwise.
pub(crate) fn read(folder: &Path) -> Result<Vec<Point>, RunError> {
    let path = folder.join(CSV);
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(reason) => return Err(RunError::File { path, reason }),
    };
    let wrong = |line: usize, expected: &str| RunError::Checkpoint {
        path: path.clone(),
        reason: format!("line {line} is not as written, expected {expected}"),
    };
    let mut lines = text.lines();
    let header = lines.next().unwrap_or_default();
    let names = header.strip_prefix(COLUMNS);
    let names = names.ok_or_else(|| wrong(1, &format!("columns {COLUMNS}")))?;
    let names: Vec<&str> = names.split(',').skip(1).collect();
    lines
        .enumerate()
        .map(|(k, line)| point(line, &names).ok_or_else(|| wrong(k + 2, "numbers")))
        .collect()
}

fn point(line: &str, names: &[&str]) -> Option<Point> {
    let mut fields = line.split(',');
    Some(Point {
        step: fields.next()?.parse().ok()?,
        loss: fields.next()?.parse().ok()?,
        error: fields.next()?.parse().ok()?,
        rate: fields.next()?.parse().ok()?,
        seconds: fields.next()?.parse().ok()?,
        figures: names
            .iter()
            .map(|&name| Some((name.to_owned(), fields.next()?.parse().ok()?)))
            .collect::<Option<_>>()?,
    })
}

/// Loss and validation error over the steps, as a PNG.
fn draw(points: &[Point]) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    static FONT: OnceLock<bool> = OnceLock::new();
    let known = FONT.get_or_init(|| {
        register_font("sans-serif", FontStyle::Normal, dejavu::sans::regular()).is_ok()
    });
    if !known {
        return Err("the font is not one".into());
    }
    let mut pixels = vec![0; 3 * (SIZE.0 * SIZE.1) as usize];
    {
        let area = BitMapBackend::with_buffer(&mut pixels, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let panels = area.split_evenly((2, 1));
        let series = |value: fn(&Point) -> f32| -> Vec<(f64, f64)> {
            let pairs = points.iter().map(|p| (p.step as f64, f64::from(value(p))));
            pairs.filter(|(_, value)| value.is_finite()).collect()
        };
        for (panel, title, unit, series, colour) in [
            (
                &panels[0],
                "Training",
                "mean loss",
                series(|point| point.loss),
                RGBColor(31, 90, 160),
            ),
            (
                &panels[1],
                "Validation on unseen objects",
                "mean error in degrees",
                series(|point| point.error),
                RGBColor(190, 80, 30),
            ),
        ] {
            draw_panel(panel, title, unit, series, colour)?;
        }
        area.present()?;
    }
    let mut png = Cursor::new(Vec::new());
    image::write_buffer_with_format(
        &mut png,
        &pixels,
        SIZE.0,
        SIZE.1,
        image::ExtendedColorType::Rgb8,
        image::ImageFormat::Png,
    )?;
    Ok(png.into_inner())
}

fn draw_panel(
    panel: &DrawingArea<BitMapBackend, plotters::coord::Shift>,
    title: &str,
    unit: &str,
    series: Vec<(f64, f64)>,
    colour: RGBColor,
) -> Result<(), Box<dyn std::error::Error>> {
    let last = series.last().map_or(1.0, |point| point.0);
    let high = series.iter().map(|point| point.1).fold(0.0, f64::max);
    let low = series.iter().map(|point| point.1).fold(0.0, f64::min);
    let margin = 0.05 * (high - low).max(1e-9);
    let mut chart = ChartBuilder::on(panel)
        .caption(title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(70)
        .build_cartesian_2d(0.0..last, low..high + margin)?;
    chart
        .configure_mesh()
        .x_desc("step")
        .y_desc(unit)
        .axis_desc_style(("sans-serif", 15))
        .label_style(("sans-serif", 13))
        .x_label_formatter(&|step| format!("{step:.0}"))
        .light_line_style(RGBColor(240, 240, 240))
        .bold_line_style(RGBColor(215, 215, 215))
        .draw()?;
    chart.draw_series(LineSeries::new(series, colour.stroke_width(2)))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_comes_back_and_the_picture_has_words() {
        let folder = tempfile::tempdir().unwrap();
        let points: Vec<Point> = (1..=40)
            .map(|k| Point {
                step: 250 * k,
                loss: 0.1 + 1.0 / k as f32,
                error: 8.0 + 40.0 / k as f32,
                rate: 1e-3 / k as f32,
                seconds: 10.5 * k as f64,
                figures: BTreeMap::from([
                    ("under_11_25".to_owned(), 0.3),
                    ("under_30".to_owned(), 1.0 / k as f32),
                ]),
            })
            .collect();
        write(folder.path(), &points).unwrap();
        assert_eq!(read(folder.path()).unwrap(), points);
        let picture = image::open(folder.path().join(PNG)).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), SIZE);
        // Titles and numbers: dark pixels left of and above the curves.
        let is_dark = |x: u32, y: u32| picture.get_pixel(x, y).0.iter().all(|v| *v < 100);
        let dark = |xs: std::ops::Range<u32>, ys: std::ops::Range<u32>| {
            ys.flat_map(|y| xs.clone().map(move |x| (x, y)))
                .filter(|&(x, y)| is_dark(x, y))
                .count()
        };
        assert!(dark(0..70, 60..340) > 100, "numbers of the upper axis");
        assert!(dark(300..600, 0..36) > 100, "the title");
        // Another table is an error, not an empty one that the next write would replace; none is no error.
        let file = folder.path().join(CSV);
        let text = std::fs::read_to_string(&file).unwrap();
        for (damaged, line) in [
            (text.replace("\n500,", "\nx,"), "line 3"),
            (text.replacen("step", "epoch", 1), "line 1"),
            (String::new(), "line 1"),
        ] {
            std::fs::write(&file, damaged).unwrap();
            let error = read(folder.path()).unwrap_err().to_string();
            assert!(error.contains(CSV) && error.contains(line), "{error}");
        }
        std::fs::remove_file(&file).unwrap();
        assert_eq!(read(folder.path()).unwrap(), []);
    }
}
