use crate::Outcome;
use crate::args::BenchRenderArgs;
use crate::memory::peak_memory;
use crate::{interrupt, scenes};
use anyhow::Result;
use normalight_synth::Renderer;
use serde::Serialize;
use std::hint::black_box;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Crops of one scene in the case of many small samples.
const CROPS: usize = 32;

/// All cases, as they are printed.
#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    recipe: String,
    cases: Vec<Case>,
    /// Most memory the process held, bytes; unknown on some systems.
    peak_memory: Option<u64>,
}

#[derive(Debug, Serialize)]
struct Case {
    name: &'static str,
    threads: usize,
    /// Stacks of photographs, camera included.
    samples: u64,
    seconds: f64,
    samples_per_second: f64,
    scenes: u64,
    /// Mean time one thread spends on a scene without any camera.
    milliseconds_per_scene: f64,
    pixels: usize,
    images: usize,
}

/// Runs both cases.
pub(crate) fn run(args: &BenchRenderArgs) -> Result<Outcome> {
    let least = super::least(args.seconds)?;
    let renderer = scenes::renderer(&args.recipe, &args.library)?;
    let threads = match args.threads {
        Some(threads) => threads as usize,
        None => super::cores(),
    };
    let mut report = Report {
        version: env!("CARGO_PKG_VERSION"),
        recipe: args.recipe.clone(),
        cases: Vec::new(),
        peak_memory: None,
    };
    for (name, pixels, images, crops) in [("32x16", 32, 16, CROPS), ("128x32", 128, 32, 0)] {
        let work = Work {
            renderer: &renderer,
            pixels,
            images,
            crops,
        };
        report.cases.push(work.measure(name, threads, least));
        if interrupt::asked() {
            return Ok(Outcome::Interrupted);
        }
    }
    report.peak_memory = peak_memory();
    super::print_report(&report, args.json, to_text)
}

/// One case: crops of scenes, or whole scenes when `crops` is 0.
struct Work<'a> {
    renderer: &'a Renderer,
    pixels: usize,
    images: usize,
    crops: usize,
}

impl Work<'_> {
    fn measure(&self, name: &'static str, threads: usize, least: Duration) -> Case {
        // Tables that are made once, and the first pages of memory.
        self.scene(u64::MAX / 2);
        let (next, samples, drawing) = (AtomicU64::new(0), AtomicU64::new(0), AtomicU64::new(0));
        let start = Instant::now();
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    while start.elapsed() < least && !interrupt::asked() {
                        let (count, time) = self.scene(next.fetch_add(1, Ordering::Relaxed));
                        samples.fetch_add(count, Ordering::Relaxed);
                        drawing.fetch_add(time.as_micros() as u64, Ordering::Relaxed);
                    }
                });
            }
        });
        let seconds = start.elapsed().as_secs_f64();
        let (samples, scenes) = (samples.into_inner(), next.into_inner());
        Case {
            name,
            threads,
            samples,
            seconds,
            samples_per_second: samples as f64 / seconds,
            scenes,
            milliseconds_per_scene: drawing.into_inner() as f64 / 1e3 / scenes as f64,
            pixels: self.pixels,
            images: self.images,
        }
    }

    /// Draws one scene and all its samples: their number, and the time for the scene alone.
    fn scene(&self, number: u64) -> (u64, Duration) {
        let start = Instant::now();
        if self.crops == 0 {
            let scene = self.renderer.whole_scene(number, self.images, self.pixels);
            let drawn = start.elapsed();
            black_box(scene.whole(self.images));
            return (1, drawn);
        }
        let scene = self.renderer.crop_scene(number, self.images, self.pixels);
        let drawn = start.elapsed();
        for part in 0..self.crops {
            black_box(scene.crop(part, self.images));
        }
        (self.crops as u64, drawn)
    }
}

fn to_text(report: &Report) -> String {
    let mut text = String::new();
    for case in &report.cases {
        text += &format!(
            "{:7} {:8.1} samples/s on {} threads ({} of {} scenes in {:.1} s; {:.1} ms for a scene)\n",
            case.name,
            case.samples_per_second,
            case.threads,
            case.samples,
            case.scenes,
            case.seconds,
            case.milliseconds_per_scene
        );
    }
    if let Some(bytes) = report.peak_memory {
        text += &format!("memory: {:.0} MB at most\n", bytes as f64 / 1e6);
    }
    text
}
