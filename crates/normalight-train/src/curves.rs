use crate::TrainError;
use crate::checkpoint::write_aside;
use plotters::prelude::*;
use std::fmt::Write as _;
use std::path::Path;

/// One line of the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    pub(crate) step: usize,
    /// Mean loss since the line before.
    pub(crate) loss: f32,
    /// Validation error in degrees.
    pub(crate) error: f32,
    /// Seconds of training so far.
    pub(crate) seconds: f64,
}

/// Writes `curves.csv` and `curves.png` into the run's folder.
pub(crate) fn write(folder: &Path, points: &[Point]) -> Result<(), TrainError> {
    let mut csv = String::from("step,loss,validation_degrees,seconds\n");
    for point in points {
        let _ = writeln!(
            csv,
            "{},{},{},{:.1}",
            point.step, point.loss, point.error, point.seconds
        );
    }
    write_aside(&folder.join("curves.csv"), csv.as_bytes())?;
    if points.len() < 2 {
        return Ok(());
    }
    draw(&folder.join("curves.png"), points).map_err(|error| TrainError::Plot(error.to_string()))
}

/// Reads `curves.csv` back; lines that do not parse are dropped.
pub(crate) fn read(folder: &Path) -> Vec<Point> {
    let text = std::fs::read_to_string(folder.join("curves.csv")).unwrap_or_default();
    text.lines()
        .skip(1)
        .filter_map(|line| {
            let mut fields = line.split(',');
            Some(Point {
                step: fields.next()?.parse().ok()?,
                loss: fields.next()?.parse().ok()?,
                error: fields.next()?.parse().ok()?,
                seconds: fields.next()?.parse().ok()?,
            })
        })
        .collect()
}

/// Loss and validation error over the steps, each on its own logarithmic panel. No text: fonts
/// would need a system library; the CSV has the numbers.
fn draw(path: &Path, points: &[Point]) -> Result<(), Box<dyn std::error::Error>> {
    let aside = path.with_extension("part.png");
    {
        let area = BitMapBackend::new(&aside, (900, 700)).into_drawing_area();
        area.fill(&WHITE)?;
        let panels = area.split_evenly((2, 1));
        let loss: Vec<(f32, f32)> = points.iter().map(|p| (p.step as f32, p.loss)).collect();
        let error: Vec<(f32, f32)> = points.iter().map(|p| (p.step as f32, p.error)).collect();
        for (panel, series, colour) in [
            (&panels[0], loss, RGBColor(31, 90, 160)),
            (&panels[1], error, RGBColor(190, 80, 30)),
        ] {
            let last = series.last().map_or(1.0, |point| point.0);
            let values = series.iter().map(|point| point.1.max(1e-4));
            let low = values.clone().fold(f32::MAX, f32::min) * 0.95;
            let high = values.fold(f32::MIN, f32::max) * 1.05;
            let mut chart = ChartBuilder::on(panel)
                .margin(20)
                .build_cartesian_2d(0.0..last, (low..high).log_scale())?;
            chart
                .configure_mesh()
                .x_labels(0)
                .y_labels(0)
                .light_line_style(RGBColor(230, 230, 230))
                .draw()?;
            chart.draw_series(LineSeries::new(series, colour.stroke_width(2)))?;
        }
        area.present()?;
    }
    std::fs::rename(&aside, path)?;
    Ok(())
}
