//! What the process ends with. Wrong usage ends it with 2, before anything begins.
use crate::Outcome;
use normalight_run::{Caller, ExitCodes};
use normalight_train::TrainError;
use std::process::ExitCode;

/// 130 is what shells expect of a program that Ctrl-C ended; also for SIGTERM.
pub(crate) const EXIT: ExitCodes = ExitCodes {
    finished: 0,
    failed: 1,
    diverged: 3,
    interrupted: 130,
};

/// What the process ends with after a command.
pub(crate) fn code(outcome: &anyhow::Result<Outcome>) -> ExitCode {
    let code = match outcome {
        Ok(Outcome::Done) => EXIT.finished,
        Ok(Outcome::PartlyFailed) => EXIT.failed,
        Ok(Outcome::Interrupted) => EXIT.interrupted,
        Err(error) => match error.downcast_ref::<TrainError>() {
            Some(error) => EXIT.of_error(error),
            None => EXIT.failed,
        },
    };
    ExitCode::from(code)
}

/// This process, for the files of a run.
pub(crate) fn caller() -> Caller {
    Caller {
        command: std::env::args().collect::<Vec<_>>().join(" "),
        exit_codes: Some(EXIT),
    }
}
