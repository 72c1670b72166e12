//! Photographs that cannot work: nearly the same, black or saturated ones.
use crate::{IoError, Notice};
use normalight_core::{ImageStack, Mask, Rect, evenly_spaced_indices};

/// Pixels that are looked at in each photograph.
const PIXELS: usize = 4000;
/// Share of saturated pixels that is worth a word.
const SATURATED: f32 = 0.2;

/// What is doubtful about the photographs inside the mask.
///
/// # Errors
/// [`IoError::AllIdentical`].
pub(crate) fn check(stack: &ImageStack, mask: &Mask) -> Result<Vec<Notice>, IoError> {
    let inside = mask.pixels();
    let chosen: Vec<usize> = evenly_spaced_indices(inside.len(), PIXELS)
        .into_iter()
        .map(|place| inside[place])
        .collect();
    let shots: Vec<Vec<[f32; 3]>> = (0..stack.len())
        .map(|image| {
            let mut pixels = vec![[0.0; 3]; chosen.len()];
            stack.linear_pixels(image, &chosen, &mut pixels);
            pixels
        })
        .collect();
    let name = |image: usize| stack.images()[image].name.clone();
    let mut notices = Vec::new();
    if same_pictures(stack, &shots) {
        return Err(IoError::AllIdentical { first: name(0) });
    }
    let brightest = shots
        .iter()
        .flatten()
        .flatten()
        .copied()
        .fold(0.0, f32::max);
    let black: Vec<usize> = (0..shots.len())
        .filter(|&image| mean(&shots[image]) < 1e-3 * brightest)
        .collect();
    if !black.is_empty() {
        notices.push(Notice::Black {
            files: black.iter().map(|&image| name(image)).collect(),
        });
    }
    let share = |image: usize| {
        let full = shots[image].iter().filter(|pixel| {
            pixel.iter().copied().fold(0.0, f32::max) >= 0.995 && !is_float(stack, image)
        });
        full.count() as f32 / chosen.len().max(1) as f32
    };
    let saturated: Vec<(usize, f32)> = (0..shots.len())
        .map(|image| (image, share(image)))
        .filter(|&(_, share)| share > SATURATED)
        .collect();
    if !saturated.is_empty() {
        notices.push(Notice::Saturated {
            files: saturated.iter().map(|&(image, _)| name(image)).collect(),
            share: saturated
                .iter()
                .map(|&(_, share)| share)
                .fold(0.0, f32::max),
        });
    }
    let near: Vec<String> = (1..shots.len())
        .filter(|&image| !black.contains(&image) && !black.contains(&(image - 1)))
        .filter(|&image| difference(&shots[image - 1], &shots[image]) < 0.004)
        .map(name)
        .collect();
    if !near.is_empty() {
        notices.push(Notice::NearlyIdentical { files: near });
    }
    Ok(notices)
}

fn is_float(stack: &ImageStack, image: usize) -> bool {
    matches!(
        stack.images()[image].samples,
        normalight_core::Samples::F32(_)
    )
}

fn same_pictures(stack: &ImageStack, shots: &[Vec<[f32; 3]>]) -> bool {
    if !shots.windows(2).all(|pair| pair[0] == pair[1]) {
        return false;
    }
    let area = Rect::whole(stack.width(), stack.height());
    let tile = |image| {
        let mut tile = vec![0.0; 3 * area.area()];
        stack.linear_tile(image, area, &mut tile);
        tile
    };
    let first = tile(0);
    (1..stack.len()).all(|image| tile(image) == first)
}

fn mean(pixels: &[[f32; 3]]) -> f32 {
    let sum: f32 = pixels.iter().flatten().sum();
    sum / (3 * pixels.len()).max(1) as f32
}

/// Mean difference of two pictures of the same brightness, relative to their brightness.
fn difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    let (mean_a, mean_b) = (mean(a).max(1e-9), mean(b).max(1e-9));
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    let sum: f32 = pairs.map(|(a, b)| (a / mean_a - b / mean_b).abs()).sum();
    sum / (3 * a.len()).max(1) as f32
}
