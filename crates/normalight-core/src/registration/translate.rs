//! Shots laid where they belong.
use crate::{Mask, Samples, StackImage};

/// Reach of the interpolation, in pixels.
const REACH: i64 = 3;

/// The shot whose content lies `shift` pixels to the right and down, moved back, interpolated in
/// linear light by Lanczos' kernel of three lobes on each side (Duchon 1979). Samples keep their
/// kind and transfer; beyond the frame its border is repeated, see [`keep_seen`].
pub fn translated(image: &StackImage, shift: [f32; 2]) -> StackImage {
    let mut moved = image.clone();
    match (&image.samples, &mut moved.samples) {
        (Samples::U8(from), Samples::U8(to)) => {
            let light = image.light_of_codes(255);
            let decode = |code: u8| light[usize::from(code)];
            let encode = |light: f32| (image.code_value(light) * 255.0).round() as u8;
            resample(image, shift, (from, decode), (to, encode));
        }
        (Samples::U16(from), Samples::U16(to)) => {
            let light = image.light_of_codes(65_535);
            let decode = |code: u16| light[usize::from(code)];
            let encode = |light: f32| (image.code_value(light) * 65_535.0).round() as u16;
            resample(image, shift, (from, decode), (to, encode));
        }
        (Samples::F32(from), Samples::F32(to)) => {
            resample(image, shift, (from, |light| light), (to, |light| light));
        }
        _ => unreachable!("a clone has the same samples"),
    }
    moved
}

/// Takes out of a mask what a shot with this shift does not show.
pub fn keep_seen(mask: &Mask, shift: [f32; 2]) -> Mask {
    let (width, height) = (mask.width(), mask.height());
    let seen = |place: usize, size: usize, shift: f32| {
        let source = place as f32 + shift;
        // A shift as measured: a tenth of a pixel beyond the frame is on it.
        source > -0.1 && source < size as f32 - 0.9
    };
    let inside = mask.inside().iter().enumerate().map(|(pixel, &inside)| {
        inside && seen(pixel % width, width, shift[0]) && seen(pixel / width, height, shift[1])
    });
    Mask::new(width, height, inside.collect())
}

/// Whole pixels of a shift, and the weights of the pixels from `1 - REACH` to `REACH` beside them.
fn kernel(shift: f32) -> (i64, Vec<f32>) {
    let whole = shift.floor();
    let rest = f64::from(shift - whole);
    let sinc = |x: f64| match x == 0.0 {
        true => 1.0,
        false => libm::sin(std::f64::consts::PI * x) / (std::f64::consts::PI * x),
    };
    let weights: Vec<f64> = (1 - REACH..=REACH)
        .map(|place| {
            let x = place as f64 - rest;
            match x.abs() < REACH as f64 {
                true => sinc(x) * sinc(x / REACH as f64),
                false => 0.0,
            }
        })
        .collect();
    // Flat light stays as it is.
    let sum: f64 = weights.iter().sum();
    let weights = weights.into_iter().map(|weight| (weight / sum) as f32);
    (whole as i64, weights.collect())
}

/// Along rows, then along columns, one channel after the other.
fn resample<T: Copy>(
    image: &StackImage,
    shift: [f32; 2],
    (from, decode): (&[T], impl Fn(T) -> f32),
    (to, encode): (&mut [T], impl Fn(f32) -> T),
) {
    let (width, height, channels) = (image.width, image.height, image.channels);
    let (right, across) = kernel(shift[0]);
    let (below, down) = kernel(shift[1]);
    let places = |size: usize, whole: i64| -> Vec<usize> {
        let last = size as i64 - 1;
        let first = whole + 1 - REACH;
        let reached = 0..(size as i64 + 2 * REACH - 1);
        reached
            .map(|place| (place + first).clamp(0, last) as usize)
            .collect()
    };
    let (columns, rows) = (places(width, right), places(height, below));
    let mut light = vec![0.0; width * height];
    let mut line = vec![0.0; width];
    for channel in 0..channels {
        for y in 0..height {
            for (x, value) in line.iter_mut().enumerate() {
                *value = decode(from[(y * width + x) * channels + channel]);
            }
            for (x, sum) in light[y * width..(y + 1) * width].iter_mut().enumerate() {
                let reached = columns[x..].iter().zip(&across);
                *sum = reached.map(|(&column, weight)| weight * line[column]).sum();
            }
        }
        for y in 0..height {
            for x in 0..width {
                let reached = rows[y..].iter().zip(&down);
                let sum: f32 = reached
                    .map(|(&row, weight)| weight * light[row * width + x])
                    .sum();
                to[(y * width + x) * channels + channel] = encode(sum.max(0.0));
            }
        }
    }
}
