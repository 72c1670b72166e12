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

/// Trains up to the last step, or until `observe` stops it, which is what the answer tells. A
/// checkpoint is written either way.
pub(crate) fn train_loop<L: Learner>(
    learner: &mut L,
    batches: &mut Batches<L::Batch, L::Error>,
    folder: &RunFolder,
    schedule: LoopSchedule,
    training_state: &mut TrainingState,
    mut observe: impl FnMut(StepReport) -> ControlFlow<()>,
) -> Result<ControlFlow<()>, L::Error> {
    let mut points = curves::read(folder.path())?;
    points.retain(|point| point.step <= training_state.step);
    let mut speed = Speed::default();
    while training_state.step < schedule.steps {
        let start = Instant::now();
        let batch = batches.take_next()?;
        let waited = start.elapsed().as_secs_f64();
        let learned = learn(learner, &batch, training_state.step)?;
        let rate = learner.rate(training_state.step);
        training_state.step += 1;
        training_state.loss = Some(learned.loss);
        training_state.recent.0 += learned.loss;
        training_state.recent.1 += 1;
        let computed = start.elapsed().as_secs_f64() - waited;
        speed.add(waited, computed);
        let last = training_state.step == schedule.steps;
        let validation = if last || training_state.step.is_multiple_of(schedule.validate_every) {
            let seconds = training_state.seconds + start.elapsed().as_secs_f64();
            Some(validate(
                learner,
                folder,
                training_state,
                &mut points,
                rate,
                seconds,
            )?)
        } else {
            None
        };
        training_state.seconds += start.elapsed().as_secs_f64();
        training_state.waited += waited;
        let answer = observe(StepReport {
            step: training_state.step,
            loss: learned.loss,
            gradient_norm: learned.gradient_norm,
            validation: validation.as_ref().map(|validation| validation.degrees),
            best: training_state.best.as_ref().map(|best| best.degrees),
            seconds: computed,
            waited,
        });
        let due = training_state
            .step
            .is_multiple_of(schedule.checkpoint_every);
        if last || answer.is_break() || due {
            checkpoint::save(folder.path(), &learner.state(), training_state)?;
        }
        if last || due || validation.is_some() {
            let line = log_line(training_state, schedule, learned, rate, validation.as_ref());
            folder.log(&format!("{line}, {}", speed.take(schedule.batch)));
        }
        if answer.is_break() && !last {
            return Ok(answer);
        }
    }
    Ok(ControlFlow::Continue(()))
}

fn learn<L: Learner>(
    learner: &mut L,
    batch: &L::Batch,
    step: usize,
) -> Result<StepOutcome, L::Error> {
    let learned = learner.learn(batch, step)?;
    match learned.failure() {
        None => Ok(learned),
        Some((quantity, value)) => Err(L::Error::from(RunError::Diverged {
            quantity,
            value,
            step: step + 1,
            batch_seed: learner.batch_seed(step),
        })),
    }
}

/// Validates, draws the curves, and keeps the result when it is the best or always the newest is kept.
fn validate<L: Learner>(
    learner: &mut L,
    folder: &RunFolder,
    training_state: &mut TrainingState,
    points: &mut Vec<Point>,
    rate: f32,
    seconds: f64,
) -> Result<Validation, L::Error> {
    let validation = learner.validate(training_state.step)?;
    let (sum, count) = std::mem::take(&mut training_state.recent);
    points.push(Point {
        step: training_state.step,
        loss: sum / count.max(1) as f32,
        error: validation.degrees,
        rate,
        seconds,
        figures: validation.figures.clone(),
    });
    curves::write(folder.path(), points)?;
    for (name, content) in learner.drawings() {
        folder.write(&name, &content)?;
    }
    let better = |best: &Best| validation.degrees < best.degrees;
    let is_best = validation.degrees.is_finite() && training_state.best.as_ref().is_none_or(better);
    if (is_best || L::KEEPS_NEWEST)
        && let Some(result) = learner.result()?
    {
        folder.write_result(&result)?;
    } else {
        return Ok(validation);
    }
    if is_best {
        training_state.best = Some(Best {
            step: training_state.step,
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
