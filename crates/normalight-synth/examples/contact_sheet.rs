//! Draws sheets of samples to look at: `contact_sheet [FOLDER [FIRST_SEED [SIDE]]]` writes `whole.png` and `crop.png`.
//! Each row shows normals, mask and six photographs.

use image::{Rgb, RgbImage};
use normalight_core::Transfer;
use normalight_synth::{Framing, Sample, SceneRecipe, render_sample};
use std::path::PathBuf;

const SEEDS: u64 = 16;
const PHOTOGRAPHS: usize = 6;

fn main() -> Result<(), image::ImageError> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let first: u64 = std::env::args()
        .nth(2)
        .and_then(|text| text.parse().ok())
        .unwrap_or(0);
    let whole = std::env::args()
        .nth(3)
        .and_then(|text| text.parse().ok())
        .unwrap_or(96);
    sheet(first, Framing::WholeObject, whole).save(folder.join("whole.png"))?;
    sheet(first, Framing::Crop, 64).save(folder.join("crop.png"))
}

/// Two samples side by side in every row.
fn sheet(first: u64, framing: Framing, size: usize) -> RgbImage {
    let columns = PHOTOGRAPHS + 2;
    let side = size as u32;
    let mut sheet = RgbImage::new(2 * columns as u32 * side, SEEDS.div_ceil(2) as u32 * side);
    for seed in 0..SEEDS {
        let recipe = SceneRecipe::default();
        let sample = render_sample(&recipe, first + seed, PHOTOGRAPHS, size, framing);
        for column in 0..columns {
            let left = (seed as usize % 2 * columns + column) as u32 * side;
            let top = (seed / 2) as u32 * side;
            for row in 0..size {
                for place in 0..size {
                    let pixel = picture(&sample, column, row * size + place);
                    sheet.put_pixel(left + place as u32, top + row as u32, Rgb(pixel));
                }
            }
        }
    }
    sheet
}

fn picture(sample: &Sample, column: usize, pixel: usize) -> [u8; 3] {
    let byte = |value: f32| (value * 255.0 + 0.5) as u8;
    match column {
        0 => sample.normals[pixel]
            .to_array()
            .map(|value| byte(0.5 + 0.5 * value)),
        1 => [u8::from(sample.mask[pixel]) * 255; 3],
        _ => {
            let area = sample.size * sample.size;
            let plane = (column - 2) * 3;
            std::array::from_fn(|channel| {
                let light = sample.images[(plane + channel) * area + pixel];
                byte(Transfer::Srgb.encode(light))
            })
        }
    }
}
