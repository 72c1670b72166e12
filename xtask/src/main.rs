//! Set-up, demo, test: what people and CI run.
//!
//! `cargo xtask demo` builds everything and serves the page; `cargo xtask test` runs every test.
//! Both fetch what is missing first, and name the exact command where they may not install.

mod bench;
mod engine;
mod fresh;
mod fuzz;
mod lints;
mod node;
mod packages;
mod run;
mod serve;
mod setup;
mod steps;
mod types;
mod wasm;
mod wheel;
mod workspace;

use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

use packages::Installing;
use steps::Step;
use workspace::Workspace;

/// Builds, shows and tests Normalight.
#[derive(Parser)]
#[command(bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
    /// Install nothing: name the exact command for what is missing, and stop.
    #[arg(long, global = true)]
    no_install: bool,
}

#[derive(Subcommand)]
enum Task {
    /// Build the page and serve it on this computer.
    Demo {
        /// The port to serve on; the next free one if it is taken.
        #[arg(long, default_value_t = 8000)]
        port: u16,
        /// Build only.
        #[arg(long)]
        no_serve: bool,
    },
    /// Run every check and test: Rust, WebAssembly in a browser, the page end to end.
    Test {
        /// Run only this step (repeatable).
        #[arg(long, value_name = "STEP")]
        only: Vec<Step>,
        /// Leave out this step (repeatable).
        #[arg(long, value_name = "STEP")]
        skip: Vec<Step>,
    },
    /// Measure the speed of what runs in a browser, see docs/speed.md.
    Bench {
        #[command(subcommand)]
        what: bench::Bench,
    },
    /// Run every fuzz target for some time, see fuzz/README.md.
    Fuzz {
        /// Seconds for each target.
        #[arg(long, default_value_t = 60)]
        seconds: u32,
        /// Run only this target (repeatable).
        #[arg(long, value_name = "TARGET")]
        only: Vec<String>,
    },
    /// Run the workflow of captures on a Slurm of two nodes that is started on this machine, as root.
    Slurm,
    /// Build the WebAssembly module and its JavaScript into web/wasm, and renew the package's generated types.
    Wasm,
}

fn main() -> ExitCode {
    let done = lints::as_rustdoc().unwrap_or_else(|| perform(Arguments::parse()));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            run::note(&format!("error: {error:#}"));
            ExitCode::FAILURE
        }
    }
}

fn perform(arguments: Arguments) -> Result<()> {
    let installing = if arguments.no_install {
        Installing::Forbidden
    } else {
        Installing::Announced
    };
    let workspace = Workspace::find()?;
    match arguments.task {
        Task::Demo { port, no_serve } => {
            steps::run(&workspace, &steps::DEMO, installing)?;
            if no_serve {
                return Ok(());
            }
            serve::serve(&workspace.root.join("www/dist"), port)
        }
        Task::Test { only, skip } => {
            steps::run(&workspace, &steps::chosen(&only, &skip), installing)
        }
        Task::Bench { what } => bench::run(&workspace, &what, installing),
        Task::Fuzz { seconds, only } => fuzz::run(&workspace, seconds, &only, installing),
        Task::Slurm => engine::slurm(&workspace, installing),
        Task::Wasm => {
            steps::run(&workspace, &steps::WASM, installing)?;
            types::renew(&workspace)
        }
    }
}
