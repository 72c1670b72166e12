//! `normalight search` of whole networks.
use super::watch::Watch;
use crate::args::SearchArgs;
use crate::terminal::{note, print};
use crate::{Outcome, device, exit, interrupt};
use anyhow::{Result, bail};
use normalight_run::RunState;
use normalight_search::{
    NetworkSearchEvent, NetworkSearchRecipe, NetworkSearchRun, RoundPart, search_networks,
    search_part,
};

/// Searches until the last training of the last round, or Ctrl-C; the same command goes on.
pub(super) fn run(args: &SearchArgs, mut recipe: NetworkSearchRecipe) -> Result<Outcome> {
    if args.random.is_some() {
        bail!("--random draws cells; a search of whole networks begins with random ones by itself");
    }
    let training = &mut recipe.training;
    training.seed = args.seed.unwrap_or(training.seed);
    if let Some(threads) = args.threads {
        training.loader_threads = Some(threads as usize);
    }
    let device = device::open(args.device)?.device;
    let run = NetworkSearchRun {
        recipe,
        folder: args.run.clone(),
        caller: exit::caller(),
    };
    let mut watch = Watch::new(args.quiet);
    let observe = |event: NetworkSearchEvent| {
        match event {
            NetworkSearchEvent::Note(text) => watch.tell(&text),
            NetworkSearchEvent::Begins { name, recipe } => watch.begin(name, recipe),
            NetworkSearchEvent::Training(event) => watch.training(event),
            NetworkSearchEvent::Ends(result) => watch.end(result.degrees, ""),
        }
        interrupt::answer()
    };
    let result = match args.round {
        None => search_networks(&run, &device, observe)?,
        Some(round) => {
            let (index, of) = (args.shard.index(), args.shard.of());
            search_part(&run, RoundPart { round, index, of }, &device, observe)?
        }
    };
    drop(watch);
    if !args.quiet {
        print(&result.to_text())?;
    }
    if result.state == RunState::Finished {
        return Ok(Outcome::Done);
    }
    if !args.quiet {
        note("the same command goes on from here");
    }
    Ok(Outcome::Interrupted)
}
