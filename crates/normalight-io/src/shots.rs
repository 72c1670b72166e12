//! Photographs that cannot work: nearly the same, black or saturated ones, of a camera that moved
//! ([`motion`]), without lamp ([`ambient`]).
pub(crate) mod ambient;
pub(crate) mod motion;

use crate::{IoError, Notice};
use normalight_core::{ImageStack, Mask, Rect, ShotLight, evenly_spaced_indices};

/// Pixels that are looked at in each photograph.
const PIXELS: usize = 4000;
/// Share of saturated pixels that is worth a word.
const SATURATED: f32 = 0.2;
/// Share of saturated samples over all shots that is.
const OVEREXPOSED: f32 = 0.1;
/// Two shots with less difference are nearly the same picture, whatever a JPEG made of them.
const SAME: f32 = 0.01;
/// Of the two most different shots of a stack: less, and the lamp stood still; less, and it hardly
/// moved. A lamp that moves by one degree changes the light of a slope of 45 degrees by 1.7 %.
const STILL: f32 = 0.015;
const HARDLY: f32 = 0.05;
/// Pixels of an object, as few as say nothing about the lamp.
const FEW: usize = 1000;

/// What is doubtful about the photographs inside the mask.
///
/// # Errors
/// [`IoError::AllIdentical`], [`IoError::LampStill`].
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
    let clipped: f32 = (0..shots.len()).map(share).sum::<f32>() / shots.len() as f32;
    if clipped > OVEREXPOSED {
        notices.push(Notice::Overexposed { share: clipped });
    }
    let light = ShotLight::new(stack, mask);
    let bright: Vec<usize> = (0..shots.len()).filter(|k| !black.contains(k)).collect();
    let few = inside.len() < FEW;
    check_difference(&light, (&bright, few), &name, &mut notices)?;
    if let Some(shot) = light.room_lit() {
        notices.push(Notice::RoomLit { file: name(shot) });
    }
    Ok(notices)
}

/// Whether the lamp moved, over all pairs of shots that are not black; a few pixels cannot say that it did not.
fn check_difference(
    light: &ShotLight,
    (shots, few): (&[usize], bool),
    name: &dyn Fn(usize) -> String,
    notices: &mut Vec<Notice>,
) -> Result<(), IoError> {
    let (mut most, mut near) = (0.0f32, Vec::new());
    for (place, &shot) in shots.iter().enumerate() {
        let differences = shots[..place]
            .iter()
            .map(|&other| light.difference(other, shot));
        let differences: Vec<f32> = differences.collect();
        most = differences.iter().copied().fold(most, f32::max);
        if differences.iter().any(|&difference| difference < SAME) {
            near.push(name(shot));
        }
    }
    if shots.len() < 2 {
        return Ok(());
    }
    if most < STILL && !few {
        return Err(IoError::LampStill {
            first: name(shots[0]),
            difference: most,
        });
    }
    if most < HARDLY {
        notices.push(Notice::LampHardlyMoved { difference: most });
    }
    if !near.is_empty() {
        notices.push(Notice::NearlyIdentical { files: near });
    }
    Ok(())
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
