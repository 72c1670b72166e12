//! `normalight bench search`: how fast a relaxed network is searched.
use super::median_seconds;
use crate::args::BenchSearchArgs;
use crate::memory::peak_memory;
use crate::{Outcome, interrupt, search_recipe};
use anyhow::{Context, Result};
use burn::tensor::Device;
use normalight_search::{Order, SearchStep};
use normalight_train::Network;
use serde::Serialize;
use std::time::{Duration, Instant};

#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    cases: Vec<Case>,
    /// Most memory the process held, bytes; unknown on some systems.
    peak_memory: Option<u64>,
}

#[derive(Debug, Serialize)]
struct Case {
    network: &'static str,
    order: Order,
    threads: usize,
    /// Milliseconds of a step without waiting for samples.
    step_ms: f64,
    /// Samples of both halves.
    samples_per_second: f64,
    /// Milliseconds of one thread for making the samples of a step.
    data_ms: f64,
    parameters: usize,
}

/// Runs everything for one thread and for all.
pub(crate) fn run(args: &BenchSearchArgs) -> Result<Outcome> {
    let least = super::least(args.seconds)?;
    let networks = match args.network {
        Some(network) => vec![network.into()],
        None => vec![Network::Light, Network::Normal],
    };
    let mut threads = match args.threads {
        Some(threads) => vec![threads as usize],
        None => vec![1, super::cores()],
    };
    threads.dedup();
    let mut cases = Vec::new();
    for network in networks {
        for &threads in &threads {
            for order in [Order::First, Order::Second] {
                if interrupt::asked() {
                    return Ok(Outcome::Interrupted);
                }
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()
                    .with_context(|| format!("{threads} threads cannot be started"))?;
                cases.push(pool.install(|| measure(args, network, order, threads, least))?);
            }
        }
    }
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        cases,
        peak_memory: peak_memory(),
    };
    super::print_report(&report, args.json, to_text)
}

fn measure(
    args: &BenchSearchArgs,
    network: Network,
    order: Order,
    threads: usize,
    least: Duration,
) -> Result<Case> {
    let mut recipe = search_recipe::read(&args.recipe, network)?;
    recipe.search.order = order;
    recipe.search.warm_up = 0;
    let device = Device::flex();
    let mut step = SearchStep::new(&recipe, &device)?;
    let mut failed = None;
    let [seconds] = median_seconds(least, || {
        let start = Instant::now();
        failed = failed.take().or(step.take().err());
        [start.elapsed()]
    });
    if let Some(error) = failed {
        return Err(error.into());
    }
    Ok(Case {
        network: network.name(),
        order,
        threads,
        step_ms: 1e3 * seconds,
        samples_per_second: 2.0 * recipe.training.batch as f64 / seconds,
        data_ms: 1e3 * step.data().as_secs_f64(),
        parameters: step.parameters(),
    })
}

fn to_text(report: &Report) -> String {
    let mut text = String::from(
        "network  order   threads   ms a step  samples/s  data, ms a step  parameters\n",
    );
    for case in &report.cases {
        let order = match case.order {
            Order::First => "first",
            Order::Second => "second",
        };
        text += &format!(
            "{:8} {order:7} {:7} {:11.1} {:10.1} {:16.1} {:11}\n",
            case.network,
            case.threads,
            case.step_ms,
            case.samples_per_second,
            case.data_ms,
            case.parameters
        );
    }
    if let Some(bytes) = report.peak_memory {
        text += &format!("\nmemory: {:.0} MB at most\n", bytes as f64 / 1e6);
    }
    text
}
