//! How trainings went.
use super::rows::{Grid, GridRow};
use crate::Training;

/// A line for each training.
pub(super) fn grid(trainings: &[Training]) -> Grid {
    let heads = ["Training", "Steps", "Hours", "Best error", "Last error"];
    let rows = trainings.iter().filter_map(|training| {
        let last = training.points.last()?;
        let degrees = training.points.iter().map(|point| point.degrees);
        let best = degrees.fold(f64::INFINITY, f64::min);
        Some(GridRow {
            published: false,
            cells: vec![
                training.name.clone(),
                last.step.to_string(),
                format!("{:.2}", last.hours),
                format!("{best:.2}"),
                format!("{:.2}", last.degrees),
            ],
        })
    });
    Grid {
        title: "Trainings".to_owned(),
        note: "Errors on rendered objects that the trainings never show, in degrees: of lights or of normals, as the training's \
               network has them. Hours are those of training alone."
            .to_owned(),
        rows: rows.collect(),
        words: 1,
        heads: heads.map(str::to_owned).to_vec(),
    }
}
