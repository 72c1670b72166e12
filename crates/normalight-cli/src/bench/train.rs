//! `normalight bench train`: how fast the networks learn on this machine.
mod networks;
mod operations;

use super::median_seconds;
use crate::Outcome;
use crate::args::BenchTrainArgs;
use crate::interrupt;
use crate::memory::peak_memory;
use anyhow::{Context, Result};
use burn::tensor::{Device, Tensor};
use networks::{Case, Conditions};
use operations::OperationCase;
use serde::Serialize;
use std::time::{Duration, Instant};

/// All cases, as they are printed.
#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    /// Whose operations: `own`, or `generic` for those of Burn alone.
    operations: &'static str,
    matmul: Vec<Matmul>,
    cases: Vec<Case>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    operation_cases: Vec<OperationCase>,
    /// Most memory the process held, bytes; unknown on some systems.
    peak_memory: Option<u64>,
}

/// Product of two matrices of 1024x1024: what the machine can do.
#[derive(Debug, Clone, Copy, Serialize)]
struct Matmul {
    threads: usize,
    gflops: f64,
}

/// Runs everything for one thread and for all.
pub(crate) fn run(args: &BenchTrainArgs) -> Result<Outcome> {
    let least = super::least(args.seconds)?;
    let cores = super::cores();
    let mut threads = match args.threads {
        Some(threads) => vec![threads as usize],
        None => vec![1, cores],
    };
    threads.dedup();
    let data_ms = networks::data_ms()?;
    let mut report = Report {
        version: env!("CARGO_PKG_VERSION"),
        operations: if args.generic { "generic" } else { "own" },
        matmul: Vec::new(),
        cases: Vec::new(),
        operation_cases: Vec::new(),
        peak_memory: None,
    };
    for threads in threads {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .with_context(|| format!("{threads} threads cannot be started"))?;
        let measured = pool.install(|| {
            let mut measure = || measure(args, threads, least, data_ms, &mut report);
            if args.generic {
                normalight_kernels::generic(measure)
            } else {
                measure()
            }
        });
        if !measured? {
            return Ok(Outcome::Interrupted);
        }
    }
    report.peak_memory = peak_memory();
    super::print_report(&report, args.json, to_text)
}

/// All cases on the threads of this pool; false when the user stops it.
fn measure(
    args: &BenchTrainArgs,
    threads: usize,
    least: Duration,
    data_ms: f64,
    report: &mut Report,
) -> Result<bool> {
    let device = Device::flex();
    let matmul = matmul(&device, least);
    report.matmul.push(Matmul {
        threads,
        gflops: matmul,
    });
    let conditions = Conditions {
        threads,
        matmul,
        least,
        data_ms,
    };
    for network in networks::all()? {
        if interrupt::asked() {
            return Ok(false);
        }
        let wanted = args.only.is_empty() || args.only.iter().any(|name| name == network.name);
        if wanted {
            report.cases.push(network.measure(&device, &conditions)?);
        }
    }
    if args.ops {
        for operation in operations::all() {
            if interrupt::asked() {
                return Ok(false);
            }
            report
                .operation_cases
                .push(operation.measure(&device, threads, least));
        }
    }
    Ok(true)
}

/// GFLOP/s of Burn's matrix product.
fn matmul(device: &Device, least: Duration) -> f64 {
    const SIDE: usize = 1024;
    let ones = Tensor::<2>::ones([SIDE, SIDE], device);
    let seconds = median_seconds(least, || {
        let start = Instant::now();
        std::hint::black_box(ones.clone().matmul(ones.clone()).into_data());
        [start.elapsed()]
    });
    2.0 * (SIDE as f64).powi(3) / seconds[0] / 1e9
}

fn to_text(report: &Report) -> String {
    let mut text = String::from(
        "milliseconds a sample of ten 32x32 images, batch 16; speed of forward and backward together\n\n\
         network      threads   forward  backward      both      adam      muon      data   GFLOP/s  of matmul\n",
    );
    for case in &report.cases {
        text += &format!(
            "{:12} {:7} {:9.2} {:9.2} {:9.2} {:9.2} {:9.2} {:9.2} {:9.0} {:8.0} %\n",
            case.name,
            case.threads,
            case.forward_ms,
            case.backward_ms,
            case.ms_per_sample,
            case.adam_ms,
            case.muon_ms,
            case.data_ms,
            case.gflops,
            100.0 * case.share_of_matmul
        );
    }
    if !report.operation_cases.is_empty() {
        text += "\nforward and backward, milliseconds a batch\n\n\
                 operation                                       threads       own   generic     ratio\n";
    }
    for case in &report.operation_cases {
        text += &format!(
            "{:47} {:7} {:9.2} {:9.2} {:9.1}\n",
            case.name,
            case.threads,
            case.own_ms,
            case.generic_ms,
            case.generic_ms / case.own_ms
        );
    }
    text.push('\n');
    for matmul in &report.matmul {
        let (threads, gflops) = (matmul.threads, matmul.gflops);
        text += &format!("matmul 1024 on {threads} threads: {gflops:.0} GFLOP/s\n");
    }
    if let Some(bytes) = report.peak_memory {
        text += &format!("memory: {:.0} MB at most\n", bytes as f64 / 1e6);
    }
    text
}
