//! The report: everything that was measured, as files for people and for programs.
mod charts;
mod html;
mod markdown;
mod pictures;
mod reliability;
mod rows;
mod trainings;

pub use pictures::{MethodPictures, ObjectPictures, errors_picture, normals_picture};

use crate::{EvaluateError, Table, Training, Trial};
use serde::Serialize;

/// What was measured with what, in the order in which it is said.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fact {
    /// What it is.
    pub name: String,
    /// Its value.
    pub value: String,
}

/// All that a report is made of.
#[derive(Debug, Clone)]
pub struct Report {
    /// What was measured with what.
    pub facts: Vec<Fact>,
    /// What was measured.
    pub trials: Vec<Trial>,
    /// Pictures of the objects.
    pub pictures: Vec<ObjectPictures>,
    /// Drawings of the networks (title, SVG).
    pub networks: Vec<(String, Vec<u8>)>,
    /// Trainings whose course is shown.
    pub trainings: Vec<Training>,
}

impl Report {
    /// The files of the report (name, content): one self-contained page, the tables as Markdown, everything as CSV.
    ///
    /// # Errors
    /// [`EvaluateError::Report`] for a chart that cannot be drawn or a table that cannot be written.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, EvaluateError> {
        let tables = Table::all(&self.trials);
        let html = html::page(self, &tables)?;
        let markdown = markdown::text(self, &tables);
        Ok(vec![
            ("trials.csv".to_owned(), rows::csv(&self.trials)?),
            ("report.md".to_owned(), markdown.into_bytes()),
            ("index.html".to_owned(), html.into_bytes()),
        ])
    }
}
