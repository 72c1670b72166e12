//! The command `normalight`: photographs in, lights and normals out; rendering, training, search, evaluation.

mod args;
mod average;
mod batch;
mod bench;
mod choices;
mod device;
mod display;
mod estimate;
mod evaluate;
mod exit;
mod export;
mod interrupt;
mod memory;
mod mesh;
mod monitor;
mod output_file;
mod outputs;
mod progress;
mod render;
mod scenes;
mod search;
mod search_recipe;
mod settings;
mod terminal;
mod train;

use args::{Arguments, Command};
use clap::Parser;
use normalight_run::{Failure, RunError};
use normalight_train::TrainError;
use std::process::ExitCode;
use terminal::note;

/// How a command ended, errors aside.
enum Outcome {
    /// Everything that was asked for is there.
    Done,
    /// Some of it failed, as was said on the way.
    PartlyFailed,
    /// The user stopped it.
    Interrupted,
}

fn main() -> ExitCode {
    normalight_batch::end_with_batch();
    display::quiet_without();
    // Wrong usage ends here, with code 2.
    let arguments = Arguments::parse();
    let outcome = interrupt::listen().and_then(|()| match &arguments.command {
        Command::Estimate(args) => estimate::run(args),
        Command::Batch(args) => batch::run(args),
        Command::Mesh(args) => mesh::run(args),
        Command::Train(args) => train::run(args),
        Command::Average(args) => average::run(args),
        Command::Export(args) => export::run(args),
        Command::Search(args) => search::run(args),
        Command::Evaluate(args) => evaluate::run(args),
        Command::Render(args) => render::run(args),
        Command::Bench(args) => bench::run(args),
    });
    match &outcome {
        Ok(Outcome::Done | Outcome::PartlyFailed) => {}
        Ok(Outcome::Interrupted) => note("interrupted"),
        Err(error) => note(&format!("error: {error:#}{}", hint(error))),
    }
    exit::code(&outcome)
}

/// What the command has to offer against an error.
fn hint(error: &anyhow::Error) -> &'static str {
    let run_error = error
        .downcast_ref::<TrainError>()
        .and_then(Failure::run_error);
    match run_error {
        Some(RunError::Unfinished { .. }) => " (--resume continues it)",
        _ => "",
    }
}
