//! What is the same for every kind of run: folder, continuing, notes, summary.
use crate::learner::Learner;
use crate::loader::{BatchMaker, Batches};
use crate::run_folder::{Found, RunFolder};
use crate::training_loop::{StepReport, TrainingLoop};
use crate::{Failure, RunError, RunSpec, RunState, Summary, TrainingState, checkpoint};
use std::ops::ControlFlow;

/// What happens during a run.
#[derive(Debug, Clone, PartialEq)]
pub enum RunEvent {
    /// Something a person should know.
    Note(String),
    /// A step.
    Step(StepReport),
}

/// Carries out a run in its folder: `train` prepares a learner and lets it go, `card` writes about the result.
/// A run that is finished already is not begun.
///
/// # Errors
/// Those of the folder, and of `train`; the summary tells them unless nothing has begun.
pub fn run_job<O, E>(
    spec: &RunSpec,
    observe: &mut O,
    train: impl FnOnce(&mut Session<O>) -> Result<ControlFlow<()>, E>,
    card: impl FnOnce(&Summary) -> String,
) -> Result<Summary, E>
where
    O: FnMut(RunEvent) -> ControlFlow<()>,
    E: Failure,
{
    let folder = RunFolder::open(spec)?;
    let notes = match folder.find(spec)? {
        Found::Begun(note) => note.into_iter().collect(),
        Found::Finished(summary) => {
            let note = "finished already, nothing is left to do".to_owned();
            let _ = observe(RunEvent::Note(note));
            return Ok(*summary);
        }
    };
    let mut session = Session {
        spec,
        folder,
        training_state: TrainingState::start(),
        notes,
        observe,
    };
    let result = train(&mut session);
    session.end(result, card)
}

/// A run under way.
pub struct Session<'a, O> {
    spec: &'a RunSpec,
    folder: RunFolder,
    training_state: TrainingState,
    notes: Vec<String>,
    observe: &'a mut O,
}

impl<O: FnMut(RunEvent) -> ControlFlow<()>> Session<'_, O> {
    /// Brings a learner to where the run stands: from the checkpoint, or by `start`, which tells what it
    /// did. Then the run has begun.
    ///
    /// # Errors
    /// A checkpoint that is damaged or of another network, a file that cannot be written; those of `start`.
    pub fn begin<L: Learner>(
        &mut self,
        learner: &mut L,
        start: impl FnOnce(&mut L) -> Result<String, L::Error>,
    ) -> Result<(), L::Error> {
        let path = self.folder.path();
        if self.spec.resume && checkpoint::exists(path) {
            let loaded = checkpoint::load(path)?;
            let step = loaded.training_state.step;
            learner
                .restore(loaded.tensors, step)
                .map_err(|reason| RunError::Checkpoint {
                    path: loaded.path,
                    reason,
                })?;
            self.training_state = loaded.training_state;
            self.notes.extend(loaded.note);
            let steps = self.spec.schedule.steps;
            self.notes
                .push(format!("continued after step {step} of {steps}"));
        } else {
            self.notes.push(start(learner)?);
        }
        self.folder.clean();
        self.folder.write_recipe(&self.spec.recipe)?;
        for note in std::mem::take(&mut self.notes) {
            self.folder.log(&note);
            let _ = (self.observe)(RunEvent::Note(note));
        }
        Ok(self
            .folder
            .write_summary(&self.summary(RunState::Running))?)
    }

    /// Trains to the end, or until the observer stops it.
    ///
    /// # Errors
    /// Those of learner and maker; [`RunError::Diverged`]; a file that cannot be written.
    pub fn go<L, M>(
        &mut self,
        learner: &mut L,
        maker: &M,
        threads: usize,
    ) -> Result<ControlFlow<()>, L::Error>
    where
        L: Learner,
        M: BatchMaker<Batch = L::Batch, Error = L::Error>,
    {
        let schedule = self.spec.schedule;
        let mut batches = Batches::start(maker, threads, self.training_state.step, schedule.steps);
        let observe = &mut *self.observe;
        let observe = |report| observe(RunEvent::Step(report));
        let training_loop = TrainingLoop {
            learner,
            folder: &self.folder,
            schedule,
            state: &mut self.training_state,
        };
        training_loop.run(&mut batches, observe)
    }

    fn summary(&self, state: RunState) -> Summary {
        let result = self.folder.result();
        Summary::new(self.spec, &self.training_state, state, result.as_deref())
    }

    fn end<E: Failure>(
        self,
        result: Result<ControlFlow<()>, E>,
        card: impl FnOnce(&Summary) -> String,
    ) -> Result<Summary, E> {
        let folder = &self.folder;
        let summary = match result {
            Ok(ControlFlow::Continue(())) => {
                let summary = self.summary(RunState::Finished);
                folder.write("model-card.md", card(&summary).as_bytes())?;
                folder.log("finished");
                summary
            }
            Ok(ControlFlow::Break(())) => {
                folder.log("interrupted");
                self.summary(RunState::Interrupted)
            }
            Err(error) => {
                if folder.has_run() {
                    folder.log(&format!("error: {error}"));
                    let summary = self.summary(RunState::Failed).failed(self.spec, &error);
                    // The error itself matters more than one in telling about it, on a full disk say.
                    let _ = folder.write_summary(&summary);
                } else {
                    self.folder.abandon();
                }
                return Err(error);
            }
        };
        folder.write_summary(&summary)?;
        Ok(summary)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learner::{StepOutcome, Validation};
    use crate::named_tensors::NamedTensors;
    use crate::{LoopSchedule, RunError};
    use std::collections::BTreeMap;
    use std::path::Path;

    /// Another kind of training than that of our networks: one number walks towards the batches.
    struct Walker(f32);

    struct Targets;

    impl BatchMaker for Targets {
        type Batch = f32;
        type Error = RunError;

        fn for_thread(&self) -> Self {
            Self
        }

        fn together(&self) -> usize {
            2
        }

        fn make(&mut self, step: usize) -> Result<f32, RunError> {
            Ok((step as f32).sin())
        }
    }

    impl Learner for Walker {
        type Batch = f32;
        type Error = RunError;

        fn learn(&mut self, batch: &f32, step: usize) -> Result<StepOutcome, RunError> {
            let gradient = self.0 - batch;
            self.0 -= self.rate(step) * gradient;
            Ok(StepOutcome {
                loss: gradient * gradient,
                gradient_norm: gradient.abs(),
            })
        }

        fn validate(&mut self, _step: usize) -> Result<Validation, RunError> {
            Ok(Validation {
                degrees: self.0.abs(),
                figures: BTreeMap::new(),
            })
        }

        fn result(&self) -> Result<Option<Vec<u8>>, RunError> {
            Ok(Some(self.0.to_string().into_bytes()))
        }

        fn state(&self) -> NamedTensors {
            NamedTensors::from([("walker".to_owned(), vec![self.0])])
        }

        fn restore(&mut self, state: NamedTensors, _step: usize) -> Result<(), String> {
            self.0 = *state
                .get("walker")
                .and_then(|w| w.first())
                .ok_or("no walker")?;
            Ok(())
        }

        fn rate(&self, _step: usize) -> f32 {
            0.1
        }

        fn batch_seed(&self, step: usize) -> u64 {
            step as u64
        }
    }

    fn walk(folder: &Path, stop_at: usize) -> Result<Summary, RunError> {
        let spec = RunSpec {
            folder: folder.to_owned(),
            resume: true,
            recipe: "stride = 0.1\n".to_owned(),
            free: &[],
            network: "walk".to_owned(),
            parameters: 1,
            seed: 0,
            schedule: LoopSchedule {
                steps: 20,
                validate_every: 5,
                checkpoint_every: 3,
                batch: 1,
            },
            exit_codes: None,
            result: "place.txt",
        };
        let mut observe = |event| match event {
            RunEvent::Step(report) if report.step == stop_at => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let train = |session: &mut Session<_>| {
            let mut walker = Walker(f32::NAN);
            session.begin(&mut walker, |walker| {
                walker.0 = 3.0;
                Ok("at three".to_owned())
            })?;
            session.go(&mut walker, &Targets, 2)
        };
        run_job(&spec, &mut observe, train, |_| "A walk.\n".to_owned())
    }

    /// Loop, checkpoints, curves and summary know nothing of networks.
    #[test]
    fn any_learner_can_be_run() {
        let (straight, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let whole = walk(straight.path(), 0).unwrap();
        assert_eq!((whole.state, whole.steps), (RunState::Finished, 20));
        let first = walk(broken.path(), 7).unwrap();
        assert_eq!((first.state, first.steps), (RunState::Interrupted, 7));
        let second = walk(broken.path(), 0).unwrap();
        assert_eq!((second.best, second.loss), (whole.best, whole.loss));
        for name in ["place.txt", "curves.png", "model-card.md"] {
            let read = |folder: &Path| std::fs::read(folder.join(name)).unwrap();
            assert!(read(straight.path()) == read(broken.path()), "{name}");
        }
    }
}
