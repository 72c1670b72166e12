//! Figures of a benchmark as a table for people.
use normalight_evaluate::{Figures, ObjectFigures};
use serde::Serialize;

/// The figures of all objects, for one number of images.
#[derive(Debug, Serialize)]
pub(crate) struct Table {
    /// Images asked for; `None` for all.
    pub(crate) images: Option<usize>,
    pub(crate) objects: Vec<ObjectFigures>,
    /// The mean over the objects.
    pub(crate) mean: Option<Figures>,
    pub(crate) failures: Vec<Failure>,
}

/// An object that could not be evaluated.
#[derive(Debug, Serialize)]
pub(crate) struct Failure {
    pub(crate) name: String,
    pub(crate) reason: String,
}

impl Table {
    /// The table as text, one line for each object and one for their mean.
    pub(crate) fn to_text(&self) -> String {
        let header = [
            "images",
            "normals",
            "<11.25",
            "<22.5",
            "<30",
            "lights",
            "intensity",
            "seconds",
        ];
        let names = self.objects.iter().map(|object| object.name.as_str());
        let failed = self.failures.iter().map(|failure| failure.name.as_str());
        let width = names
            .chain(failed)
            .map(|name| name.chars().count())
            .fold(6, usize::max);
        let row = |name: &str, cells: [String; 8]| {
            let cells: String = cells.iter().map(|cell| format!("  {cell:>9}")).collect();
            format!("{name:width$}{cells}\n")
        };
        let mut text = row("object", header.map(str::to_owned));
        for object in &self.objects {
            let images = object.images.to_string();
            text += &row(&object.name, cells(images, &object.figures));
        }
        for failure in &self.failures {
            text += &format!("{:width$}  failed: {}\n", failure.name, failure.reason);
        }
        if let Some(mean) = &self.mean {
            text += &row("mean", cells(String::new(), mean));
        }
        text
    }
}

fn cells(images: String, figures: &Figures) -> [String; 8] {
    let share = |share: f64| format!("{:.1} %", 100.0 * share);
    let known = |value: Option<f64>, digits: usize| {
        value.map_or("-".to_owned(), |value| format!("{value:.digits$}"))
    };
    [
        images,
        format!("{:.2}", figures.normal_degrees),
        share(figures.under_11_25),
        share(figures.under_22_5),
        share(figures.under_30),
        known(figures.light_degrees, 2),
        known(figures.intensity_error, 3),
        format!("{:.2}", figures.seconds),
    ]
}
