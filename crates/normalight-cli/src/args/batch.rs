//! `batch`.
use clap::Args;
use normalight_batch::Shard;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Estimates every capture in a tree of folders.
///
/// A capture is a folder with at least three photographs, an archive of them, or a TIFF with as many
/// pages. Each gets a result folder of its own with the same path below the output. What has its result
/// already is left alone as long as photographs, settings and program are the same, so the same command
/// goes on where it was. One bad capture stops nothing: it is a row of the table.
#[derive(Debug, Args)]
#[command(after_help = BATCH_EXAMPLES)]
pub(crate) struct BatchArgs {
    /// The tree of captures.
    #[arg(value_name = "ROOT", required_unless_present = "collect")]
    pub(crate) root: Option<PathBuf>,
    /// Folder for the results, the table (batch.csv) and the page (index.html); made when missing.
    #[arg(long, value_name = "DIR", required_unless_present = "dry_run")]
    pub(crate) out: Option<PathBuf>,
    /// Captures at the same time; default: as many as there are cores.
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<NonZeroUsize>,
    /// Memory in GiB that all captures at work may take together by estimation; default: most of what is
    /// free. One alone always runs.
    #[arg(long, value_name = "GIB", value_parser = parse_memory)]
    pub(crate) memory: Option<u64>,
    /// Only every Nth capture, from the Ith on: machines without a scheduler share a tree with 1/3, 2/3
    /// and 3/3.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE)]
    pub(crate) shard: Shard,
    /// Minutes after which a capture has failed.
    #[arg(long, value_name = "MINUTES", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) time_limit: Option<u32>,
    /// Read all photographs to see whether they changed, instead of believing their size and times.
    #[arg(long)]
    pub(crate) check_contents: bool,
    /// Compute nothing: make table and page of all results that are there, whatever shard made them.
    #[arg(long, conflicts_with_all = ["root", "dry_run", "shard"])]
    pub(crate) collect: bool,
    /// Say what is a capture and what is passed over, and stop.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) dry_run: bool,
    /// Name every file in what `--dry-run` says.
    #[arg(long, requires = "dry_run")]
    pub(crate) verbose: bool,
    /// Show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Settings of `normalight estimate` for all captures, after `--`.
    #[arg(last = true, value_name = "SETTINGS")]
    pub(crate) settings: Vec<String>,
}

const BATCH_EXAMPLES: &str = "\
Examples: a museum's tree; with settings of `estimate`; on three machines that share the folders
  normalight batch captures --out results
  normalight batch captures --out results --jobs 2 -- --quality fast --depth --mesh glb
  normalight batch captures --out results --shard 1/3

Exit codes: 0 all captures have their results, 1 some failed or an error, 2 wrong usage, 130 stopped by
Ctrl-C or SIGTERM.";

/// GiB as bytes.
fn parse_memory(text: &str) -> Result<u64, String> {
    match text.parse::<f64>() {
        Ok(gib) if gib > 0.0 && gib < 1e6 => Ok((gib * f64::from(1 << 30)) as u64),
        _ => Err(format!("{text:?} found, a number of GiB above 0 expected")),
    }
}
