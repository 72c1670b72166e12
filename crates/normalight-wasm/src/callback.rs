//! Progress out, cancelling in, and the clock.
use crate::error::Failure;
use crate::stage::Stage;
use normalight_io::{InputPlan, StageSeconds};
use normalight_model::{Observer, Progress, StageTimes};
use std::ops::ControlFlow;
use tsify::Tsify;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = "
/** Follows a run. */
export interface ProgressCallback {
  /** Hears of progress (a stage and the share of it that is done), lets the event loop run, and says whether to go on. */
  report(stage: Stage, fraction: number): Promise<boolean>;
  /** Hears what was decided about the files, before anything is computed: typed, and in the command's words. */
  plan(plan: InputPlan, words: string[]): void;
}
";

#[wasm_bindgen]
extern "C" {
    /// Follows a run: an object whose `report(stage, fraction)` lets the event loop run and then
    /// says whether to go on.
    #[wasm_bindgen(typescript_type = "ProgressCallback")]
    pub type ProgressCallback;

    #[wasm_bindgen(method, catch)]
    async fn report(
        this: &ProgressCallback,
        stage: &str,
        fraction: f32,
    ) -> Result<JsValue, JsValue>;

    #[wasm_bindgen(method, catch)]
    fn plan(this: &ProgressCallback, plan: JsValue, words: Vec<String>) -> Result<(), JsValue>;

    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// Passes the pipeline's progress on and takes the time of its stages.
pub(crate) struct ProgressObserver<'a> {
    callback: &'a ProgressCallback,
    started: f64,
    read: f64,
    stages: StageTimes,
}

impl<'a> ProgressObserver<'a> {
    /// Begins with the reading of the files; `None` when the run is cancelled already.
    pub(crate) async fn start(callback: &'a ProgressCallback) -> Option<Self> {
        let go_on = tell(callback, Stage::Reading, 0.0).await;
        go_on.is_continue().then(|| Self {
            callback,
            started: seconds(),
            read: 0.0,
            stages: StageTimes::default(),
        })
    }

    /// The files are read, and this was decided about them.
    ///
    /// # Errors
    /// A plan that JavaScript cannot hold.
    pub(crate) fn read(&mut self, plan: &InputPlan) -> Result<(), Failure> {
        self.read = seconds() - self.started;
        let said = self
            .callback
            .plan(plan.clone().into_ts()?.into(), plan.lines(true));
        // A callback that fails is asked to go on next, and then cannot say yes.
        drop(said);
        Ok(())
    }

    /// Seconds per stage, the reading first.
    pub(crate) fn finish(mut self) -> Vec<StageSeconds> {
        let reading = StageSeconds {
            stage: Stage::Reading.name().to_owned(),
            seconds: self.read,
        };
        let stages = self.stages.finish(seconds()).iter();
        let stages = stages.map(|&(stage, seconds)| StageSeconds {
            stage: Stage::from(stage).name().to_owned(),
            seconds,
        });
        std::iter::once(reading).chain(stages).collect()
    }
}

impl Observer for ProgressObserver<'_> {
    async fn report(&mut self, progress: Progress) -> ControlFlow<()> {
        self.stages.note(progress, seconds());
        tell(self.callback, progress.stage.into(), progress.fraction).await
    }
}

async fn tell(callback: &ProgressCallback, stage: Stage, fraction: f32) -> ControlFlow<()> {
    match callback.report(stage.name(), fraction).await {
        Ok(answer) if answer.is_truthy() => ControlFlow::Continue(()),
        // A callback that fails cannot be asked to cancel any more.
        _ => ControlFlow::Break(()),
    }
}

fn seconds() -> f64 {
    now() / 1000.0
}
