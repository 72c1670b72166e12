//! `normalight evaluate`.
mod benchmark;
mod facts;
mod objects;
mod store;

use crate::Outcome;
use crate::args::EvaluateArgs;
use crate::choices::NamedRun;
use crate::interrupt;
use crate::progress;
use crate::settings::Estimation;
use crate::terminal::print;
use anyhow::{Context, Result, bail};
use benchmark::{Source, sources};
use facts::Evaluation;
use normalight_evaluate::{Disturbance, Method, Photographs, Report, Table, Training, Trial};
use normalight_io::OutputFolder;
use normalight_search::network_drawings;
use objects::Work;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use store::Store;

/// A table for each method and number of images, on the standard output, as JSON and as a report.
pub(crate) fn run(args: &EvaluateArgs) -> Result<Outcome> {
    let json = args.json.as_deref().map(prepare_json).transpose()?;
    let sources = sources(&args.folder)?;
    for one in &args.leave_out {
        if sources.iter().all(|source| source.name() != one.object) {
            bail!(
                "--leave-out {one}: {} has no such object",
                args.folder.display()
            );
        }
    }
    let trainings = args.curves.iter().map(training).collect::<Result<_>>()?;
    let store = args.report.as_deref().map(Store::open).transpose()?;
    let estimation = Estimation::open(&args.estimation)?;
    let methods = methods(args);
    let mut evaluation = Evaluation::new(args, &methods, &estimation);
    print(&evaluation.heading())?;
    let choices = choices(args);
    let bar = progress::bar(
        (sources.len() * methods.len() * choices.len()) as u64,
        "{msg:40} [{bar:30}] {pos}/{len}  {eta} left",
        args.quiet,
    );
    let work = Work {
        args,
        estimation: &estimation,
        methods: &methods,
        choices: &choices,
        store: store.as_ref(),
        bar: &bar,
    };
    let trials = measure(&work, &sources);
    bar.finish_and_clear();
    let trials = in_order(trials?, &methods, &choices);
    if interrupt::asked() {
        return Ok(Outcome::Interrupted);
    }
    evaluation.tables = Table::all(&trials);
    for table in &evaluation.tables {
        let method = match methods.len() {
            1 => String::new(),
            _ => format!("{}, ", table.method.title()),
        };
        print(&format!("\n{method}{}\n{}", table.title(), table.to_text()))?;
    }
    let failed = trials.iter().any(|trial| trial.result.is_err());
    let mut bytes = serde_json::to_vec_pretty(&evaluation)?;
    bytes.push(b'\n');
    if let Some(store) = store {
        if args.estimates {
            store.pack_estimates(&trials, &methods)?;
        }
        let report = Report {
            facts: evaluation.facts(),
            pictures: store.all_pictures(&trials),
            trials,
            networks: networks(&estimation, &methods),
            trainings,
        };
        store.write(&report, bytes.clone())?;
    }
    if let Some((folder, name)) = json {
        folder.write(&[(name, bytes)])?;
    }
    Ok(if failed {
        Outcome::PartlyFailed
    } else {
        Outcome::Done
    })
}

/// Drawings of the networks that the methods use.
fn networks(estimation: &Estimation, methods: &[Method]) -> Vec<(String, Vec<u8>)> {
    let architectures = estimation.estimator.architectures();
    let used = |network: usize| methods.iter().any(|method| method.networks()[network]);
    let used = architectures.iter().enumerate().filter(|(at, _)| used(*at));
    used.flat_map(|(_, network)| network_drawings(network))
        .collect()
}

/// The course of a training.
fn training(run: &NamedRun) -> Result<Training> {
    let path = run.folder.join("curves.csv");
    let text = std::fs::read_to_string(&path)
        .with_context(|| format!("{} cannot be read", path.display()))?;
    Ok(Training::read(&run.name, &text)?)
}

/// The methods that are asked for, each once.
fn methods(args: &EvaluateArgs) -> Vec<Method> {
    if args.calibrated {
        return vec![Method::Calibrated];
    }
    let mut methods = Vec::new();
    for choice in &args.methods {
        let chosen = choice.0.map_or(Method::ALL.to_vec(), |method| vec![method]);
        for method in chosen {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
    }
    methods
}

/// The choices of photographs that are asked for, the first one disturbed as well.
fn choices(args: &EvaluateArgs) -> Vec<Photographs> {
    let subsets: Vec<Option<u64>> = match args.subsets {
        Some(subsets) => (0..subsets).map(Some).collect(),
        None => vec![None],
    };
    let counts: Vec<Option<usize>> = match args.images[..] {
        [] => vec![None],
        _ => args.images.iter().copied().map(Some).collect(),
    };
    let choices = |images: Option<usize>, disturbance: Option<Disturbance>| {
        let of_subset = move |&subset: &Option<u64>| Photographs {
            images,
            subset,
            disturbance,
        };
        subsets.iter().map(of_subset).collect::<Vec<_>>()
    };
    let disturbed = args.disturb.iter().map(|&one| (counts[0], Some(one)));
    let all = counts.iter().map(|&count| (count, None)).chain(disturbed);
    all.flat_map(|(images, disturbance)| choices(images, disturbance))
        .collect()
}

/// Measures every object, some side by side.
fn measure(work: &Work, sources: &[Source]) -> Result<Vec<Trial>> {
    let next = AtomicUsize::new(0);
    let one_after_another = || {
        let mut measured = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(source) = sources.get(index) else {
                return anyhow::Ok(measured);
            };
            measured.push((index, work.measure(source)?));
        }
    };
    let jobs = work.args.jobs.get().min(sources.len());
    let mut measured = std::thread::scope(|scope| -> Result<Vec<_>> {
        let threads: Vec<_> = (0..jobs).map(|_| scope.spawn(one_after_another)).collect();
        let mut all = Vec::new();
        for thread in threads {
            match thread.join() {
                Ok(measured) => all.extend(measured?),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        Ok(all)
    })?;
    measured.sort_by_key(|(index, _)| *index);
    Ok(measured
        .into_iter()
        .flat_map(|(_, trials)| trials)
        .collect())
}

/// The trials by method, then by number of photographs, then by object: the order of the tables.
fn in_order(mut trials: Vec<Trial>, methods: &[Method], choices: &[Photographs]) -> Vec<Trial> {
    trials.sort_by_key(|trial| {
        (
            methods.iter().position(|method| *method == trial.method),
            choices
                .iter()
                .position(|choice| *choice == trial.photographs),
        )
    });
    trials
}

/// The last part of a path, whichever way it is written.
fn folder_name(folder: &Path) -> String {
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = whole.file_name().unwrap_or(whole.as_os_str());
    name.to_string_lossy().into_owned()
}

/// The folder of the JSON file, tried out before the work, and the file's name.
fn prepare_json(path: &Path) -> Result<(OutputFolder, String)> {
    let Some(name) = path.file_name() else {
        bail!("{}: the name of a file is expected", path.display());
    };
    let folder = OutputFolder::prepare(path.parent().unwrap_or(Path::new(".")))?;
    Ok((folder, name.to_string_lossy().into_owned()))
}
