//! Training of both networks on rendered samples.
//!
//! [`train`] is a run in a folder of its own: what is particular to each network is a [`Task`], its samples come from a
//! [`Source`], and [`NetworkLearner`] is what the engine (`normalight-run`) drives.
#![deny(missing_docs)]

mod batch;
mod cache;
mod data_parallel;
mod error;
mod init;
mod light_task;
mod lights;
mod model_card;
mod network_learner;
mod normal_task;
mod predicted;
mod recipe;
mod run;
mod samples;
mod source;
#[cfg(feature = "bench")]
mod speed;
mod task;
mod validated;

pub use batch::Batch;
pub use error::TrainError;
pub use light_task::LightTask;
pub use model_card::{data, row};
pub use network_learner::NetworkLearner;
pub use normal_task::{NormalTask, NormalTraining};
pub use predicted::{Predictor, read_weights};
pub use recipe::{
    CacheRecipe, LightMix, LightSettings, Network, NetworkRecipe, NormalSettings, PublishedChoice,
    PublishedRecipe, TrainRecipe, read_table,
};
pub use run::{Devices, FREE, TrainRun, threads, train};
pub use samples::{SampleMaker, first_scene};
pub use source::Source;
#[cfg(feature = "bench")]
pub use speed::{OptimiserStep, SampleSource};
pub use task::Task;
pub use validated::validated;
