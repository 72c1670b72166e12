//! What is shown of several trainings, one after the other.
use crate::monitor::Monitor;
use crate::terminal::note;
use normalight_run::RunEvent;
use normalight_train::TrainRecipe;

/// A line for every training, and a bar while it runs.
pub(super) struct Watch {
    quiet: bool,
    training: Option<(String, Monitor)>,
    /// Whether the training did anything: it may have been finished.
    trained: bool,
}

impl Watch {
    pub(super) fn new(quiet: bool) -> Self {
        Self {
            quiet,
            training: None,
            trained: false,
        }
    }

    pub(super) fn begin(&mut self, name: String, recipe: &TrainRecipe) {
        let monitor = Monitor::only_bar(recipe.steps, recipe.batch, self.quiet);
        self.training = Some((name, monitor));
        self.trained = false;
    }

    pub(super) fn training(&mut self, event: RunEvent) {
        self.trained |= matches!(event, RunEvent::Step(_));
        if let Some((_, monitor)) = &mut self.training {
            monitor.show(event);
        }
    }

    /// The line of the training that came to its end, with its error; `more` follows.
    pub(super) fn end(&mut self, degrees: Option<f64>, more: &str) {
        let Some((name, monitor)) = self.training.take() else {
            return;
        };
        drop(monitor);
        let error = match degrees {
            Some(degrees) => format!("{degrees:.2} degrees"),
            None => "no error".to_owned(),
        };
        let earlier = if self.trained {
            ""
        } else {
            ", finished already"
        };
        self.tell(&format!("{name}: {error}{more}{earlier}"));
    }

    pub(super) fn tell(&self, text: &str) {
        if !self.quiet {
            note(text);
        }
    }
}
