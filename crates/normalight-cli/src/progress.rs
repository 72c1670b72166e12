//! Progress bars on the standard error output, and the pipeline's observer behind them.
use crate::interrupt;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use normalight_io::StageSeconds;
use normalight_model::{Observer, Progress, StageTimes};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Steps of a bar that shows a share.
const FINE: u64 = 1000;

/// A bar of `length` steps; hidden when quiet, or where nobody watches.
pub(crate) fn bar(length: u64, template: &str, quiet: bool) -> ProgressBar {
    let target = if quiet {
        ProgressDrawTarget::hidden()
    } else {
        // Hides itself when the standard error output is no terminal.
        ProgressDrawTarget::stderr()
    };
    let style = ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("=> ");
    ProgressBar::with_draw_target(Some(length), target).with_style(style)
}

/// A sign of life for work of unknown length; gone when dropped.
pub(crate) struct Spinner(ProgressBar);

impl Spinner {
    pub(crate) fn new(message: impl Into<String>, quiet: bool) -> Self {
        let spinner = bar(1, "{spinner} {msg}", quiet).with_message(message.into());
        spinner.enable_steady_tick(Duration::from_millis(100));
        Self(spinner)
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// Shows how far the pipeline is, takes the times of its stages, and stops it at Ctrl-C.
pub(crate) struct ProgressObserver {
    bar: ProgressBar,
    /// Stands before the stage's name.
    prefix: String,
    start: Instant,
    times: StageTimes,
}

impl ProgressObserver {
    pub(crate) fn new(prefix: impl Into<String>, quiet: bool) -> Self {
        Self {
            bar: bar(FINE, "{msg:32} [{bar:30}] {percent:>3} %", quiet),
            prefix: prefix.into(),
            start: Instant::now(),
            times: StageTimes::default(),
        }
    }

    /// Ends the bar; the seconds of each stage.
    pub(crate) fn finish(mut self) -> Vec<StageSeconds> {
        let now = self.start.elapsed().as_secs_f64();
        let stages = self.times.finish(now).iter();
        stages
            .map(|&(stage, seconds)| StageSeconds {
                stage: stage.name().to_owned(),
                seconds,
            })
            .collect()
    }
}

impl Observer for ProgressObserver {
    async fn report(&mut self, progress: Progress) -> ControlFlow<()> {
        self.times
            .note(progress, self.start.elapsed().as_secs_f64());
        let stage = progress.stage.name();
        self.bar.set_message(format!("{}{stage}", self.prefix));
        self.bar
            .set_position((progress.fraction * FINE as f32) as u64);
        interrupt::answer()
    }
}

impl Drop for ProgressObserver {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
