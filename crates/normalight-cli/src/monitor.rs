//! How a training or a search goes, on the standard error output.
use crate::progress;
use crate::terminal::note;
use indicatif::ProgressBar;
use normalight_run::{RunEvent, StepReport};

/// Shows how the training goes: a bar on a terminal, a line for each validation elsewhere.
pub(crate) struct Monitor {
    bar: ProgressBar,
    /// Of a step.
    samples: usize,
    /// Whether validations are told where there is no terminal.
    lines: bool,
    validation: Option<f32>,
    begun: bool,
}

impl Monitor {
    /// For a run of so many steps of so many samples.
    pub(crate) fn new(steps: usize, samples: usize, quiet: bool) -> Self {
        let template = "[{bar:30}] {pos}/{len}  {msg}  {eta} left";
        Self {
            bar: progress::bar(steps as u64, template, quiet),
            samples,
            lines: !quiet,
            validation: None,
            begun: false,
        }
    }

    /// Nothing but the bar: others tell how the run ends.
    pub(crate) fn only_bar(steps: usize, samples: usize, quiet: bool) -> Self {
        let mut monitor = Self::new(steps, samples, quiet);
        monitor.lines = false;
        monitor
    }

    pub(crate) fn show(&mut self, event: RunEvent) {
        match event {
            RunEvent::Step(report) => self.step(report),
            RunEvent::Note(text) if self.lines => self.bar.suspend(|| note(&text)),
            RunEvent::Note(_) => {}
        }
    }

    fn step(&mut self, report: StepReport) {
        self.bar.set_position(report.step as u64);
        if !self.begun {
            // Steps of an earlier run must not count for the speed.
            self.bar.reset_eta();
            self.begun = true;
        }
        self.validation = report.validation.or(self.validation);
        let speed = self.bar.per_sec() * self.samples as f64;
        let best = report
            .best
            .map_or(String::new(), |best| format!(" (best {best:.2})"));
        let validation = self.validation.map_or(String::new(), |error| {
            format!("  validation {error:.2}{best} degrees")
        });
        let line = format!("loss {:.4}{validation}  {speed:.1} samples/s", report.loss);
        if report.validation.is_some() && self.bar.is_hidden() && self.lines {
            note(&format!("step {}  {line}", report.step));
        }
        self.bar.set_message(line);
    }
}

impl Drop for Monitor {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
