//! Training of both networks on rendered samples, and their evaluation on benchmarks.
#![deny(missing_docs)]

mod adam;
mod batch;
mod checkpoint;
mod curves;
#[cfg_attr(
    not(test),
    expect(dead_code, reason = "the training loop is going to call it")
)]
mod data_parallel;
mod error;
mod evaluate;
mod light_task;
mod loader;
mod normal_task;
mod recipe;
mod run;
mod source;
mod task;

pub use error::TrainError;
pub use evaluate::{BenchmarkObject, Figures, LightsFrom, ObjectFigures, evaluate_object};
pub use recipe::{
    LightSettings, Network, NormalSettings, PublishedChoice, PublishedRecipe, TrainRecipe,
};
pub use run::{StepReport, TrainRun, train};
