//! The engine of long computations that can be stopped and continued: a [`Learner`] says what a step is, the engine
//! brings batches ([`BatchMaker`], on threads of their own), checkpoints, curves, log, summary and the folder of the run.
//!
//! It knows nothing of photographs or lights: [`RunSpec`] and the two traits are all it sees of what it runs
//! ([`run_job`]). A run that was stopped and continued has the same numbers as one that was not.
#![deny(missing_docs)]

mod average;
mod caller;
mod check;
mod checkpoint;
mod curves;
mod difference;
mod error;
mod hash;
mod learner;
mod loader;
mod named_tensors;
mod optimiser;
mod run_folder;
mod seeded;
mod session;
mod spec;
mod state;
mod summary;
mod training_loop;

pub use average::Average;
pub use caller::{Caller, ExitCodes};
pub use check::check;
pub use checkpoint::{Loaded, load};
pub use difference::{Difference, differences};
pub use error::{Failure, RunError, read_text};
pub use hash::sha256;
pub use learner::{Learner, StepOutcome, Validation};
pub use loader::{BatchMaker, Batches};
pub use named_tensors::{NamedTensors, collect, fill, host, put, scalar, take};
pub use optimiser::{
    Decay, DepthwiseRule, DeviceGradients, HostGradients, MuonRecipe, Optimiser, OptimiserKind,
    OptimiserRecipe, Schedule, StepGradients, StepsOn, collect_gradients,
};
pub use seeded::seeded;
pub use session::{RunEvent, Session, run_job};
pub use spec::{LoopSchedule, RunSpec};
pub use state::{Best, TrainingState};
pub use summary::{RunState, Summary};
pub use training_loop::StepReport;
