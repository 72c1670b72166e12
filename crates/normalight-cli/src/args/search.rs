use crate::choices::{DeviceChoice, EqualChoice};
use clap::{Args, Subcommand};
use normalight_batch::Shard;
use std::path::PathBuf;

/// Searches for cells, or for whole networks.
#[derive(Debug, Args)]
pub(crate) struct SearchCommands {
    #[command(subcommand)]
    pub(crate) what: SearchCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SearchCommand {
    /// Search for the cells of the light network.
    Light(SearchArgs),
    /// Search for the cells of the normal network.
    Normal(SearchArgs),
    /// Choose the cells of a search again, with another cap on skips, and draw them.
    Derive(DeriveArgs),
    /// Train found, random and plain networks for the same short schedule and compare their errors.
    Compare(CompareArgs),
}

/// Searches for the cells of one network.
///
/// The folder of a run then holds what one of a training does, but genotype.json instead of weights, the
/// operations' weights over time, and drawings of the cells. A training recipe takes the file as
/// `genotype`. Ctrl-C and SIGTERM write a checkpoint and stop.
#[derive(Debug, Args)]
#[command(after_help = SEARCH_EXAMPLES)]
pub(crate) struct SearchArgs {
    /// `laptop`, `paper`, `networks`, or a TOML file.
    ///
    /// laptop: cells; an hour or so on a few cores, without any files. paper: cells as published; needs the
    /// Blobby and Sculpture sets in the current folder, and a GPU. networks: whole networks, by successive
    /// halving of random ones; an hour and a half on two cores. It writes search.json, and a training recipe
    /// for each network on the front of error against cost; the same command goes on where it was.
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) recipe: String,
    /// Folder of the run; made when missing.
    #[arg(long, value_name = "DIR")]
    pub(crate) run: PathBuf,
    /// Seed of weights and samples, instead of the recipe's; up to 1048575.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 20))]
    pub(crate) seed: Option<u64>,
    /// Continue from the folder's checkpoint; without one a fresh start.
    ///
    /// Only steps, validate_every, checkpoint_every and loader_threads of the recipe may have changed.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Search for nothing: write this many random genotypes of the same space and budget into the
    /// folder, as random-1.json and so on.
    #[arg(long, value_name = "N", conflicts_with = "resume", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) random: Option<u32>,
    /// Whole networks: only the trainings of this round, from 1; the rounds before must be done.
    ///
    /// For several machines that share the folder, with --shard. At the end the command without --round
    /// has nothing to train any more, and writes the results.
    #[arg(long, value_name = "K", conflicts_with = "random")]
    pub(crate) round: Option<usize>,
    /// Of the round's networks, only every Nth, beginning with the Ith.
    #[arg(long, value_name = "I/N", requires = "round", default_value_t = Shard::WHOLE)]
    pub(crate) shard: Shard,
    /// Threads that make samples; default: one fewer than there are cores. The samples stay the same.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
    /// Show no progress and no summary.
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Chooses the cells of a search again, with another cap on skips, and draws them.
///
/// The cap decides only what is chosen, not how the search goes, so nothing is searched again.
#[derive(Debug, Args)]
pub(crate) struct DeriveArgs {
    /// Folder of the search.
    #[arg(value_name = "RUN")]
    pub(crate) run: PathBuf,
    /// Most skips in a cell; any number where missing.
    #[arg(long, value_name = "N")]
    pub(crate) most_skips: Option<usize>,
    /// Folder for genotype.json, alpha.csv and the drawings; made when missing.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
}

const SEARCH_EXAMPLES: &str = "\
Examples: a search, and six random genotypes to measure it by
  normalight search normal --recipe laptop --run runs/found
  normalight search normal --recipe laptop --run runs/random --random 6

Exit codes and summary.json are those of `normalight train`.";

/// Trains networks of equal cost for the same short schedule on the same data and seeds, and prints
/// their errors.
///
/// Every network is made as wide as brings its multiply-adds closest to those of the plain one. The
/// folder then holds the training of every network and seed, and compare.json: parameters,
/// multiply-adds, errors, their mean and spread. The same command again goes on where it was.
#[derive(Debug, Args)]
#[command(after_help = COMPARE_EXAMPLES)]
pub(crate) struct CompareArgs {
    /// Genotype files, or folders: the genotype.json of a search, else all genotype files in it.
    #[arg(required_unless_present = "plain", value_name = "PATH")]
    pub(crate) paths: Vec<PathBuf>,
    /// The schedule: a training recipe, as TOML, of a network of cells without `genotype`.
    #[arg(long, value_name = "FILE")]
    pub(crate) recipe: PathBuf,
    /// Folder of the trainings; made when missing.
    #[arg(long, value_name = "DIR")]
    pub(crate) run: PathBuf,
    /// Number of seeds (3: 1, 2 and 3), or a list of them: 4,7. `4,` is a list of one.
    #[arg(long, value_name = "N|LIST", default_value = "1", value_parser = parse_seeds)]
    pub(crate) seeds: Seeds,
    /// What is the same for all.
    #[arg(long, value_enum, default_value = "multiply-adds")]
    pub(crate) equal: EqualChoice,
    /// Multiply-adds for a stack of ten images; default: those of the plain network that ships.
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000_000))]
    pub(crate) multiply_adds: Option<u64>,
    /// Compare the plain network, too.
    #[arg(long)]
    pub(crate) plain: bool,
    /// Threads that make samples; default: one fewer than there are cores. The samples stay the same.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) threads: Option<u32>,
    /// Where to compute.
    #[arg(long, value_enum, default_value = "auto")]
    pub(crate) device: DeviceChoice,
    /// Show no progress and no table.
    #[arg(long)]
    pub(crate) quiet: bool,
}

const COMPARE_EXAMPLES: &str = "\
Example: a search against chance, the paper's cells and plain convolutions, three times each
  normalight search compare runs/found runs/random models/genotypes/paper.json --plain \\
    --recipe models/recipes/compare-normal.toml --seeds 3 --run runs/compared

With `--equal training-time` the time of a step is measured first, while nothing else should run, and
kept in times.json; `steps` of the recipe are those of the network of median speed.

Exit codes: 0 finished, 1 error, 2 wrong usage, 130 stopped by Ctrl-C or SIGTERM after writing a
checkpoint. A training that diverges has no error and ends nothing.";

/// Seeds in ascending order, each once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Seeds(pub(crate) Vec<u64>);

/// Most seeds that a number stands for.
const MOST_SEEDS: u64 = 1000;

fn parse_seeds(text: &str) -> Result<Seeds, String> {
    let number = |word: &str, most: u64| match word.trim().parse::<u64>() {
        Ok(number) if number <= most => Ok(number),
        _ => Err(format!("{word:?} found, a number up to {most} expected")),
    };
    if !text.contains(',') {
        return match number(text, MOST_SEEDS)? {
            0 => Err("0 found, 1 or more expected".to_owned()),
            count => Ok(Seeds((1..=count).collect())),
        };
    }
    let words = text.strip_suffix(',').unwrap_or(text).split(',');
    let mut seeds: Vec<u64> = words
        .map(|word| number(word, (1 << 20) - 1))
        .collect::<Result<_, _>>()?;
    seeds.sort_unstable();
    seeds.dedup();
    Ok(Seeds(seeds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_a_number_of_them_or_a_list() {
        let seeds = |text| parse_seeds(text).map(|seeds| seeds.0);
        assert_eq!(seeds("3").unwrap(), [1, 2, 3]);
        assert_eq!(seeds("7, 2,7").unwrap(), [2, 7]);
        assert_eq!(seeds("5,").unwrap(), [5]);
        assert_eq!(seeds("0,").unwrap(), [0]);
        for bad in ["", "0", "-1", "1,x", ",", "1,,2", "1048576,", "1001"] {
            assert!(seeds(bad).is_err(), "{bad}");
        }
    }
}
