//! Photographs that cannot work: nearly the same, black or saturated ones, of a camera that moved
//! ([`motion`]), without lamp ([`ambient`]).
pub(crate) mod ambient;
pub(crate) mod dark;
pub(crate) mod motion;

use crate::{IoError, Notice};
use normalight_core::{ImageStack, Mask, Rect, ShotLight, evenly_spaced_indices, on_all_cores};

/// Pixels that are looked at in each photograph.
const PIXELS: usize = 4000;
/// Light of samples that are full.
const FULL: f32 = 0.995;
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
    let shots = on_all_cores(stack.len(), |image| {
        let mut pixels = vec![[0.0; 3]; chosen.len()];
        stack.linear_pixels(image, &chosen, &mut pixels);
        pixels
    });
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
    let levels = full_levels(stack, &shots);
    let share = |image: usize| {
        let full = shots[image]
            .iter()
            .filter(|pixel| brightest_of(pixel) >= levels[image]);
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

fn brightest_of(pixel: &[f32; 3]) -> f32 {
    pixel.iter().copied().fold(0.0, f32::max)
}

/// Light from which on samples of each shot are saturated: full scale, or less where a converter scaled what the sensor had
/// clipped. Then many samples are just as bright as the brightest, few nearly so, and of most shots it is the same level.
fn full_levels(stack: &ImageStack, shots: &[Vec<[f32; 3]>]) -> Vec<f32> {
    let clipped = |pixels: &Vec<[f32; 3]>| -> Option<f32> {
        let most = pixels.iter().map(brightest_of).fold(0.0, f32::max);
        let count = |from: f32, to: f32| {
            let between =
                |pixel: &&[f32; 3]| (from * most..to * most).contains(&brightest_of(pixel));
            pixels.iter().filter(between).count()
        };
        let (at, near) = (count(0.999, 1.1), count(0.9, 0.999));
        (20 * at > pixels.len() && at > 2 * near).then_some(most)
    };
    let found: Vec<Option<f32>> = shots.iter().map(clipped).collect();
    let alike = |level: f32| {
        let same = |other: &&f32| (**other - level).abs() < 2e-3 * level;
        2 * found.iter().flatten().filter(same).count() >= shots.len()
    };
    (0..shots.len())
        .map(|image| match found[image] {
            Some(level) if alike(level) => 0.999 * level,
            _ if is_float(stack, image) => f32::INFINITY,
            _ => FULL,
        })
        .collect()
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
