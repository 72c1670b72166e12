//! Training of both networks on rendered samples, and their evaluation on benchmarks.
//!
//! [`train`] is a run in a folder of its own. Inside, the training loop drives a learner (what is
//! trained, with its optimiser and its state as named tensors) with batches that other threads make;
//! folder, checkpoints, curves and summary are the loop's, so that another kind of training is a
//! learner and nothing else.
#![deny(missing_docs)]

mod average;
mod batch;
mod cache;
mod checkpoint;
mod curves;
mod data_parallel;
mod error;
mod evaluate;
mod init;
mod learner;
mod light_task;
mod lights;
mod loader;
mod model_card;
mod named_tensors;
mod network_learner;
mod normal_task;
mod optimiser;
mod predicted;
mod recipe;
mod run;
mod run_folder;
mod samples;
mod search;
mod session;
mod source;
mod speed;
mod summary;
mod task;
mod training_loop;

pub use error::TrainError;
pub use evaluate::{BenchmarkObject, Figures, LightsFrom, ObjectFigures, evaluate_object};
pub use recipe::{
    CacheRecipe, Decay, DepthwiseRule, LightMix, LightSettings, MuonRecipe, Network,
    NormalSettings, OptimiserKind, OptimiserRecipe, PublishedChoice, PublishedRecipe, Schedule,
    TrainRecipe,
};
pub use run::{Devices, TrainRun, train};
pub use search::{
    AlphaRecipe, Budget, CompareEvent, CompareRun, Comparison, EntryKind, EntryResult, Equal,
    Group, Measure, OperationTime, OperationTimes, Order, SearchRecipe, SearchRun, SearchSettings,
    SearchStep, SeedResult, compare, derive_again, placements, random_genotypes, search,
};
pub use session::TrainEvent;
pub use speed::{OptimiserStep, SampleSource};
pub use summary::{Best, RunState, Summary};
pub use training_loop::StepReport;
