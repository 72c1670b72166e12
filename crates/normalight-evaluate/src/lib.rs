//! Errors of the whole pipeline on objects with known truth: [`evaluate_object`] runs it as users do.
#![deny(missing_docs)]

mod error;
mod figures;
mod object;

pub use error::EvaluateError;
pub use figures::{Figures, ObjectFigures};
pub use object::{BenchmarkObject, LightsFrom, evaluate_object};
