//! `normalight bench`.
mod render;
mod train;

use crate::Outcome;
use crate::args::{BenchArgs, BenchCommand};
use anyhow::Result;

/// Measures what was asked for.
pub(crate) fn run(args: &BenchArgs) -> Result<Outcome> {
    match &args.what {
        BenchCommand::Render(args) => render::run(args),
        BenchCommand::Train(args) => train::run(args),
    }
}

/// Most memory the process held so far, where the system tells (Linux: proc(5), `VmHWM`).
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024)
}
