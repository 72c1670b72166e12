//! Measures the time per sample on one thread.

use normalight_synth::{Framing, SceneRecipe, render_sample};
use std::time::Instant;

fn main() {
    let recipe = SceneRecipe::default();
    for (name, framing, size) in [
        ("crop 32x32", Framing::Crop, 32),
        ("crop 64x64", Framing::Crop, 64),
        ("whole object 64x64", Framing::WholeObject, 64),
    ] {
        let samples = 300;
        let start = Instant::now();
        let mut covered = 0;
        for seed in 0..samples {
            let sample = render_sample(&recipe, seed, 12, size, framing);
            covered += sample.mask.iter().filter(|&&inside| inside).count();
        }
        let milliseconds = start.elapsed().as_secs_f64() * 1e3 / samples as f64;
        let share = covered as f64 / (samples as usize * size * size) as f64;
        println!(
            "{name}, 12 images: {milliseconds:.2} ms, {:.0} % object",
            100.0 * share
        );
    }
}
