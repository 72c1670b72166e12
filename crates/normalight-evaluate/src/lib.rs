//! Errors on objects with known truth: [`evaluate_object`] runs the whole pipeline as users do, or a classical method;
//! a [`Table`] is what came of some objects, a [`Report`] the page of everything beside [published](PUBLISHED) figures.
#![deny(missing_docs)]

mod disturbance;
mod error;
mod figures;
mod measure;
mod method;
mod object;
mod photographs;
mod published;
mod reliability;
mod report;
mod table;
mod training;

pub use disturbance::Disturbance;
pub use error::EvaluateError;
pub use figures::{Figures, NormalFigures, ObjectFigures};
pub use measure::{Measured, evaluate_object};
pub use method::Method;
pub use object::BenchmarkObject;
pub use photographs::Photographs;
pub use published::{DILIGENT, PAPER_BY_IMAGES, PUBLISHED, Published};
pub use reliability::Reliability;
pub use report::{Fact, MethodPictures, ObjectPictures, Report, errors_picture, normals_picture};
pub use table::{Failure, Spread, Table, Trial};
pub use training::{Training, TrainingPoint};
