//! The loop that every kind of training shares.
use crate::curves::{self, Point};
use crate::learner::{Learner, StepOutcome, Validation};
use crate::loader::Batches;
use crate::run_folder::RunFolder;
use crate::{Best, LoopSchedule, RunError, TrainingState, checkpoint};
use std::ops::ControlFlow;
use std::time::Instant;

/// What a step gave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport {
    /// Steps taken so far.
    pub step: usize,
    /// Loss of this step.
    pub loss: f32,
    /// Norm of the gradient before clipping.
    pub gradient_norm: f32,
    /// Validation error in degrees, after a validation.
    pub validation: Option<f32>,
    /// Best validation error so far, in degrees.
    pub best: Option<f32>,
    /// Seconds of computing, waiting for samples left out.
    pub seconds: f64,
    /// Seconds of waiting for samples.
    pub waited: f64,
}

/// A learner's way through its steps.
pub(crate) struct TrainingLoop<'a, L> {
    pub(crate) learner: &'a mut L,
    pub(crate) folder: &'a RunFolder,
    pub(crate) schedule: LoopSchedule,
    pub(crate) state: &'a mut TrainingState,
}

impl<L: Learner> TrainingLoop<'_, L> {
    /// Trains up to the last step, or until `observe` stops it, which is what the answer tells. A
    /// checkpoint is written either way.
    pub(crate) fn run(
        mut self,
        batches: &mut Batches<L::Batch, L::Error>,
        mut observe: impl FnMut(StepReport) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, L::Error> {
        let schedule = self.schedule;
        let mut points = curves::read(self.folder.path())?;
        points.retain(|point| point.step <= self.state.step);
        let mut speed = Speed::default();
        while self.state.step < schedule.steps {
            let start = Instant::now();
            let batch = batches.take_next()?;
            let waited = start.elapsed().as_secs_f64();
            let learned = self.learn(&batch)?;
            let computed = start.elapsed().as_secs_f64() - waited;
            speed.add(waited, computed);
            let rate = self.learner.rate(self.state.step - 1);
            let last = self.state.step == schedule.steps;
            let validation = if last || self.state.step.is_multiple_of(schedule.validate_every) {
                let seconds = self.state.seconds + start.elapsed().as_secs_f64();
                Some(self.validate(&mut points, rate, seconds)?)
            } else {
                None
            };
            self.state.seconds += start.elapsed().as_secs_f64();
            self.state.waited += waited;
            let answer = observe(StepReport {
                step: self.state.step,
                loss: learned.loss,
                gradient_norm: learned.gradient_norm,
                validation: validation.as_ref().map(|validation| validation.degrees),
                best: self.state.best.as_ref().map(|best| best.degrees),
                seconds: computed,
                waited,
            });
            let due = self.state.step.is_multiple_of(schedule.checkpoint_every);
            if last || answer.is_break() || due {
                checkpoint::save(self.folder.path(), &self.learner.state(), self.state)?;
            }
            if last || due || validation.is_some() {
                let line = log_line(self.state, schedule, learned, rate, validation.as_ref());
                let speed = speed.take(schedule.batch);
                self.folder.log(&format!("{line}, {speed}"));
            }
            if answer.is_break() && !last {
                return Ok(answer);
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Takes a step and counts it.
    fn learn(&mut self, batch: &L::Batch) -> Result<StepOutcome, L::Error> {
        let step = self.state.step;
        let learned = self.learner.learn(batch, step)?;
        if let Some((quantity, value)) = learned.failure() {
            return Err(L::Error::from(RunError::Diverged {
                quantity,
                value,
                step: step + 1,
                batch_seed: self.learner.batch_seed(step),
            }));
        }
        self.state.step += 1;
        self.state.loss = Some(learned.loss);
        self.state.recent.0 += learned.loss;
        self.state.recent.1 += 1;
        Ok(learned)
    }

    /// Validates, draws the curves, and keeps the result when it is the best or always the newest is kept.
    fn validate(
        &mut self,
        points: &mut Vec<Point>,
        rate: f32,
        seconds: f64,
    ) -> Result<Validation, L::Error> {
        let step = self.state.step;
        let validation = self.learner.validate(step)?;
        let (sum, count) = std::mem::take(&mut self.state.recent);
        points.push(Point {
            step,
            loss: sum / count.max(1) as f32,
            error: validation.degrees,
            rate,
            seconds,
            figures: validation.figures.clone(),
        });
        curves::write(self.folder.path(), points)?;
        for (name, content) in self.learner.drawings() {
            self.folder.write(&name, &content)?;
        }
        let better = |best: &Best| validation.degrees < best.degrees;
        let is_best = validation.degrees.is_finite() && self.state.best.as_ref().is_none_or(better);
        if (is_best || L::KEEPS_NEWEST)
            && let Some(result) = self.learner.result()?
        {
            self.folder.write_result(&result)?;
        } else {
            return Ok(validation);
        }
        if is_best {
            self.state.best = Some(Best {
                step,
                degrees: validation.degrees,
                // JSON has no word for other numbers.
                figures: validation
                    .figures
                    .iter()
                    .filter(|(_, value)| value.is_finite())
                    .map(|(name, value)| (name.clone(), *value))
                    .collect(),
            });
        }
        Ok(validation)
    }
}

fn log_line(
    training_state: &TrainingState,
    schedule: LoopSchedule,
    learned: StepOutcome,
    rate: f32,
    validation: Option<&Validation>,
) -> String {
    let mut line = format!(
        "step {} of {}: loss {:.5}, gradient {:.4}, learning rate {rate:.3e}",
        training_state.step, schedule.steps, learned.loss, learned.gradient_norm
    );
    if let Some(validation) = validation {
        line += &format!(", validation {:.3} degrees", validation.degrees);
        for (name, value) in &validation.figures {
            line += &format!(", {name} {value:.4}");
        }
        if let Some(best) = &training_state.best {
            line += &format!(", best {:.3} degrees at step {}", best.degrees, best.step);
        }
    }
    line
}

/// How fast the steps since the last line of the log were.
#[derive(Default)]
struct Speed {
    steps: usize,
    waited: f64,
    computed: f64,
}

impl Speed {
    fn add(&mut self, waited: f64, computed: f64) {
        self.steps += 1;
        self.waited += waited;
        self.computed += computed;
    }

    /// In words, and starts anew.
    fn take(&mut self, batch: usize) -> String {
        let Self {
            steps,
            waited,
            computed,
        } = std::mem::take(self);
        let seconds = (waited + computed).max(1e-9);
        format!(
            "{:.1} samples/s, {:.0} % of the time waiting for samples",
            (steps * batch) as f64 / seconds,
            100.0 * waited / seconds
        )
    }
}
