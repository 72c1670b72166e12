//! Training of both networks on rendered samples.
#![deny(missing_docs)]

mod adam;
mod batch;
mod checkpoint;
mod curves;
mod error;
mod light_task;
mod loader;
mod normal_task;
mod recipe;
mod run;
mod task;

pub use error::TrainError;
pub use recipe::{LightSettings, Network, NormalSettings, TrainRecipe};
pub use run::{StepReport, TrainRun, train};
