//! `normalight search`.
mod compare;
mod networks;
mod watch;

use crate::args::{DeriveArgs, SearchArgs, SearchCommand, SearchCommands};
use crate::choices::DeviceChoice;
use crate::monitor::Monitor;
use crate::terminal::{note, print};
use crate::train::describe;
use crate::{Outcome, device, exit, interrupt, search_recipe};
use anyhow::{Context, Result, bail};
use normalight_io::write_files;
use normalight_run::{RunError, RunState};
use normalight_search::{SearchRecipe, SearchRun, derive_again, random_genotypes, search};
use normalight_train::{Network, TrainError};
use std::io::ErrorKind;
use std::path::Path;

/// Searches or compares.
pub(crate) fn run(args: &SearchCommands) -> Result<Outcome> {
    match &args.what {
        SearchCommand::Light(args) => run_network(args, Network::Light),
        SearchCommand::Normal(args) => run_network(args, Network::Normal),
        SearchCommand::Derive(args) => derive(args),
        SearchCommand::Compare(args) => compare::run(args),
    }
}

fn run_network(args: &SearchArgs, network: Network) -> Result<Outcome> {
    if let Some(recipe) = search_recipe::read_networks(&args.recipe, network)? {
        return networks::run(args, recipe);
    }
    if args.round.is_some() {
        bail!("--round is of a search of whole networks; one for cells has none");
    }
    let mut recipe = search_recipe::read(&args.recipe, network)?;
    let training = &mut recipe.training;
    training.seed = args.seed.unwrap_or(training.seed);
    if let Some(threads) = args.threads {
        training.loader_threads = Some(threads as usize);
    }
    match args.random {
        Some(count) => write_random(args, &recipe, count as usize),
        None => find(args, recipe),
    }
}

/// Searches until the recipe's last step or Ctrl-C.
fn find(args: &SearchArgs, recipe: SearchRecipe) -> Result<Outcome> {
    let device = device::open(args.device)?.device;
    if !args.quiet {
        let network = recipe.training.network.kind().name();
        note(&format!("search for cells of the {network} network"));
    }
    let (steps, batch) = (recipe.training.steps, recipe.training.batch);
    // A batch of either half of the data.
    let mut monitor = Monitor::new(steps, 2 * batch, args.quiet);
    let run = SearchRun {
        recipe,
        folder: args.run.clone(),
        resume: args.resume,
        steps_on: device::steps_on(&device),
        caller: exit::caller(),
    };
    let summary = search(&run, &device, |event| {
        monitor.show(event);
        interrupt::answer()
    })?;
    drop(monitor);
    if summary.state != RunState::Finished {
        if !args.quiet {
            note("checkpoint written; continue with --resume");
        }
        return Ok(Outcome::Interrupted);
    }
    if !args.quiet {
        let genotype = args.run.join("genotype.json");
        print(&format!(
            "{}genotype: {}\n",
            describe(&summary),
            genotype.display()
        ))?;
    }
    Ok(Outcome::Done)
}

/// Writes what the last checkpoint of a search speaks for.
fn derive(args: &DeriveArgs) -> Result<Outcome> {
    let device = device::open(DeviceChoice::Cpu)?.device;
    let files = derive_again(&args.run, args.most_skips, &device)?;
    write_files(&args.out, &files)?;
    Ok(Outcome::Done)
}

/// Writes random genotypes, all or none; others of the same names are left alone.
fn write_random(args: &SearchArgs, recipe: &SearchRecipe, count: usize) -> Result<Outcome> {
    let genotypes = random_genotypes(recipe, count)?;
    let mut files = Vec::new();
    for (index, genotypes) in genotypes.iter().enumerate() {
        let name = format!("random-{}.json", index + 1);
        let json = serde_json::to_string_pretty(genotypes)? + "\n";
        if !holds(&args.run.join(&name), &json)? {
            files.push((name, json));
        }
    }
    if !files.is_empty() {
        write_files(&args.run, &files)?;
    }
    if !args.quiet {
        print(&format!(
            "random genotypes: {count}, in {}\n",
            args.run.display()
        ))?;
    }
    Ok(Outcome::Done)
}

/// Whether a file is there already; an error if it is another one.
fn holds(path: &Path, content: &str) -> Result<bool> {
    match std::fs::read(path) {
        Ok(found) if found == content.as_bytes() => Ok(true),
        Ok(_) => bail!(
            "{}: another file is here already; choose another folder",
            path.display()
        ),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error).with_context(|| path.display().to_string()),
    }
}

/// Puts the file in front of errors that do not name it.
pub(crate) fn named<T>(path: &Path, result: Result<T, TrainError>) -> Result<T> {
    match result {
        Err(error @ TrainError::Run(RunError::File { .. } | RunError::Recipe { .. })) => {
            Err(error.into())
        }
        result => result.with_context(|| path.display().to_string()),
    }
}
