//! Writes the golden stack as files for tests of other programs: `golden_stack FOLDER`.

use normalight_io::{mask_png, photograph_png, write_files};
use normalight_synth::BitDepth;
use normalight_tests::golden_sample;
use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args()
        .nth(1)
        .ok_or("usage: golden_stack FOLDER")?;
    let sample = golden_sample();
    let mut files = vec![("mask.png".to_owned(), mask_png(&sample.to_mask())?)];
    for image in sample.to_stack_images(BitDepth::Sixteen) {
        files.push((image.name.clone(), photograph_png(&image)?));
    }
    Ok(write_files(Path::new(&folder), &files)?)
}
