use std::ops::ControlFlow;

/// What the pipeline is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The light network looks at every photograph.
    Lights,
    /// The normal network looks at every photograph.
    Normals,
    /// Lights are refitted to the normals.
    Refit,
    /// A guided light network looks again, with normals and lights in view.
    FinalLights,
    /// The normal network runs again with the better lights.
    FinalNormals,
    /// Albedo from normals and lights.
    Albedo,
}

impl Stage {
    /// A name for people and reports.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Lights => "lights",
            Stage::Normals => "normals",
            Stage::Refit => "refit",
            Stage::FinalLights => "final lights",
            Stage::FinalNormals => "final normals",
            Stage::Albedo => "albedo",
        }
    }
}

/// How far the pipeline is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The stage under way.
    pub stage: Stage,
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

/// An observer that never looks and never stops.
#[derive(Debug, Clone, Copy, Default)]
pub struct Quiet;

impl Observer for Quiet {
    async fn report(&mut self, _progress: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Seconds per stage, from a clock that the caller reads: browsers and native programs have
/// different ones.
#[derive(Debug, Clone, Default)]
pub struct StageTimes {
    current: Option<(Stage, f64)>,
    finished: Vec<(Stage, f64)>,
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
    pub fn finish(&mut self, now: f64) -> &[(Stage, f64)] {
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
            (Stage::Lights, 0.0, 1.0),
            (Stage::Lights, 1.0, 2.0),
            (Stage::Normals, 0.0, 2.5),
        ] {
            times.note(Progress { stage, fraction }, now);
        }
        assert_eq!(
            times.finish(7.5),
            [(Stage::Lights, 1.5), (Stage::Normals, 5.0)]
        );
    }
}
