//! How far the pipeline is from the truth, object by object.
mod figures;
mod object;

pub use figures::{Figures, ObjectFigures};
pub use object::{BenchmarkObject, LightsFrom, evaluate_object};
