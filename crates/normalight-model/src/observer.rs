use crate::ModelError;
use std::ops::ControlFlow;

/// What the pipeline is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PipelineStage {
    /// The light network looks at every photograph.
    Lights,
    /// The normal network looks at every photograph.
    Normals,
    /// Lights are refitted to the normals.
    Refit,
    /// The normal network runs again with the refitted lights.
    FinalNormals,
    /// Albedo from normals and lights.
    Albedo,
}

impl PipelineStage {
    /// A name for people and reports.
    pub fn name(self) -> &'static str {
        match self {
            PipelineStage::Lights => "lights",
            PipelineStage::Normals => "normals",
            PipelineStage::Refit => "refit",
            PipelineStage::FinalNormals => "final normals",
            PipelineStage::Albedo => "albedo",
        }
    }
}

/// How far the pipeline is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The stage under way.
    pub stage: PipelineStage,
    /// Share of the stage that is done, 0..1.
    pub fraction: f32,
}

/// Follows a run and may stop it.
///
/// The pipeline calls it between pieces of work and waits for the answer, so that a browser's
/// event loop gets its turn and a cancel button works.
pub trait Observer {
    /// Takes note of the progress; `Break` cancels the run.
    fn report(&mut self, progress: Progress) -> impl Future<Output = ControlFlow<()>>;
}

/// Tells the observer how far a stage is.
///
/// # Errors
/// [`ModelError::Cancelled`] when it says stop.
pub(crate) async fn report(
    observer: &mut impl Observer,
    stage: PipelineStage,
    fraction: f32,
) -> Result<(), ModelError> {
    match observer.report(Progress { stage, fraction }).await {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(ModelError::Cancelled),
    }
}

/// An observer that never looks and never stops.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoopObserver;

impl Observer for NoopObserver {
    async fn report(&mut self, _progress: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Seconds per stage, from a clock that the caller reads: browsers and native programs have
/// different ones.
#[derive(Debug, Clone, Default)]
pub struct StageTimes {
    current: Option<(PipelineStage, f64)>,
    finished: Vec<(PipelineStage, f64)>,
}

impl StageTimes {
    /// Notes that `progress` was reported when the clock showed `now` seconds.
    pub fn note(&mut self, progress: Progress, now: f64) {
        if self
            .current
            .is_none_or(|(stage, _)| stage != progress.stage)
        {
            self.finish(now);
            self.current = Some((progress.stage, now));
        }
    }

    /// Ends the last stage and returns all of them with their seconds, in order.
    pub fn finish(&mut self, now: f64) -> &[(PipelineStage, f64)] {
        if let Some((stage, start)) = self.current.take() {
            self.finished.push((stage, now - start));
        }
        &self.finished
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_timed_in_order() {
        let mut times = StageTimes::default();
        for (stage, fraction, now) in [
            (PipelineStage::Lights, 0.0, 1.0),
            (PipelineStage::Lights, 1.0, 2.0),
            (PipelineStage::Normals, 0.0, 2.5),
        ] {
            times.note(Progress { stage, fraction }, now);
        }
        assert_eq!(
            times.finish(7.5),
            [(PipelineStage::Lights, 1.5), (PipelineStage::Normals, 5.0)]
        );
    }
}
