//! `normalight bench`.
mod render;

use crate::Outcome;
use crate::args::{BenchArgs, BenchCommand};
use anyhow::Result;

/// Measures what was asked for.
pub(crate) fn run(args: &BenchArgs) -> Result<Outcome> {
    match &args.what {
        BenchCommand::Render(args) => render::run(args),
    }
}
