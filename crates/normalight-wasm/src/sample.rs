//! A stack for those who have none at hand.
use crate::error::Failure;
use crate::file::OutputFile;
use normalight_io::photograph_png;
use normalight_synth::{BitDepth, Framing, SceneRecipe, render_sample as render};
use wasm_bindgen::prelude::*;

/// A glazed teapot in white and gold.
const SEED: u64 = 58;
const IMAGES: usize = 16;
const SIDE: usize = 192;

/// Renders a stack as PNG files, which then go the way of all files.
///
/// # Errors
/// None that memory can cause.
#[wasm_bindgen]
pub fn render_sample() -> Result<JsValue, Failure> {
    let sample = render(
        &SceneRecipe::default(),
        SEED,
        IMAGES,
        SIDE,
        Framing::WholeObject,
    );
    let mut files = Vec::with_capacity(IMAGES);
    for image in sample.to_stack_images(BitDepth::Sixteen) {
        files.push(OutputFile::new(&image.name, &photograph_png(&image)?));
    }
    Ok(serde_wasm_bindgen::to_value(&files)?)
}
