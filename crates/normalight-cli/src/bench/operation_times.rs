//! `normalight bench ops`: how long every operation takes where a recipe's cells stand.
use super::median_seconds;
use crate::args::BenchOpsArgs;
use crate::terminal::{note, print};
use crate::{Outcome, device, interrupt, search_recipe};
use anyhow::{Context, Result};
use burn::tensor::{Device, Distribution, Tensor};
use normalight_io::write_files;
use normalight_model::{Operation, OperationLayer};
use normalight_search::{OperationTime, OperationTimes};
use std::path::Path;
use std::time::{Duration, Instant};

/// Images of a batch.
const IMAGES: usize = 16;

/// Measures and writes the table.
pub(crate) fn run(args: &BenchOpsArgs) -> Result<Outcome> {
    let least = super::least(args.seconds)?;
    let recipe = search_recipe::read(&args.recipe, args.network.into())?;
    let device = device::open(args.device)?;
    let threads = args
        .threads
        .map_or_else(super::cores, |threads| threads as usize);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .with_context(|| format!("{threads} threads cannot be started"))?;
    let mut cases = Vec::new();
    let training = &recipe.training;
    for site in training.network.cell_sites(training.size) {
        for stride in [1, 2] {
            if stride == 1 || site.reduces {
                cases.push((site.width, site.area, stride));
            }
        }
    }
    cases.sort_unstable();
    cases.dedup();
    let mut times = Vec::new();
    for (width, area, stride) in cases {
        for &operation in &recipe.search.operations {
            if operation == Operation::Zero {
                continue;
            }
            if interrupt::asked() {
                return Ok(Outcome::Interrupted);
            }
            let case = Case {
                operation,
                width,
                area,
                stride,
            };
            times.push(pool.install(|| case.measure(&device.device, least)));
        }
    }
    let table = OperationTimes {
        device: device.name,
        threads,
        times,
    };
    write(&args.out, &table)?;
    print(&to_text(&table))?;
    note(&format!("written: {}", args.out.display()));
    Ok(Outcome::Done)
}

#[derive(Clone, Copy)]
struct Case {
    operation: Operation,
    width: usize,
    area: usize,
    stride: usize,
}

impl Case {
    fn measure(self, device: &Device, least: Duration) -> OperationTime {
        let Self {
            operation,
            width,
            area,
            stride,
        } = self;
        let side = area.isqrt() * stride;
        let shape = [IMAGES, side, side, width];
        let input = |device: &Device| Tensor::<4>::random(shape, Distribution::Default, device);
        let layer = OperationLayer::trained(operation, width, stride, device);
        let plain = input(device);
        let [forward] = median_seconds(least, || {
            let start = Instant::now();
            // Reading a number back waits for the device.
            std::hint::black_box(layer.forward(plain.clone()).sum().into_data());
            [start.elapsed()]
        });
        let device = device.clone().autodiff();
        let layer = OperationLayer::trained(operation, width, stride, &device);
        let tracked = input(&device).require_grad();
        let [training] = median_seconds(least, || {
            let start = Instant::now();
            let gradients = layer.forward(tracked.clone()).sum().backward();
            let gradient = tracked.grad(&gradients).map(|one| one.sum().into_data());
            std::hint::black_box(gradient);
            [start.elapsed()]
        });
        OperationTime {
            operation,
            width,
            area,
            stride,
            forward_ms: 1e3 * forward / IMAGES as f64,
            training_ms: 1e3 * training / IMAGES as f64,
        }
    }
}

fn write(path: &Path, table: &OperationTimes) -> Result<()> {
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let name = path.file_name().context("--out: a file name expected")?;
    let json = serde_json::to_string_pretty(table)? + "\n";
    write_files(folder, &[(&name.to_string_lossy(), json.as_bytes())])?;
    Ok(())
}

fn to_text(table: &OperationTimes) -> String {
    let mut text = format!(
        "{}, {} threads; milliseconds an image\n\n\
         operation        channels    pixels  stride   forward  forward + backward\n",
        table.device, table.threads
    );
    for one in &table.times {
        text += &format!(
            "{:16} {:8} {:9} {:7} {:9.4} {:19.4}\n",
            one.operation.name(),
            one.width,
            one.area,
            one.stride,
            one.forward_ms,
            one.training_ms
        );
    }
    text
}
