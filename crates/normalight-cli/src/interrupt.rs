//! Ctrl-C and SIGTERM: the first asks the work to end in good order, the second ends it at once.
use crate::exit::EXIT;
use crate::terminal::note;
use anyhow::{Context, Result};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// Begins to listen, once per process.
pub(crate) fn listen() -> Result<()> {
    ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(EXIT.interrupted.into());
        }
        note("stopping; press Ctrl-C again to stop at once");
    })
    .context("Ctrl-C cannot be listened to")
}

/// What says so, for work that looks at it by itself.
pub(crate) fn flag() -> &'static AtomicBool {
    &ASKED
}

/// Whether the work shall end.
pub(crate) fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// The same as an observer's answer.
pub(crate) fn answer() -> ControlFlow<()> {
    if asked() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}
