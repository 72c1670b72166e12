//! End-to-end tests of the project: one small stack, rendered by the project, that every path from
//! photographs to normals must agree on.

use normalight_synth::{Framing, Renderer, Sample, SceneRecipe};

/// Photographs in the golden stack.
pub const GOLDEN_IMAGES: usize = 12;

/// Side of the golden stack in pixels: not a multiple of the networks' alignment.
pub const GOLDEN_SIZE: usize = 92;

/// Number of the sample: an object with shadows, highlights and two materials.
const GOLDEN_SEED: u64 = 2718;

/// The golden stack with the truth about it.
pub fn golden_sample() -> Sample {
    let renderer = Renderer::new(SceneRecipe::default()).expect("the preset needs no files");
    renderer.sample(
        GOLDEN_SEED,
        GOLDEN_IMAGES,
        GOLDEN_SIZE,
        Framing::WholeObject,
    )
}
