//! Whether a stack's samples look proportional to light or encoded for viewing.
//!
//! Matt surfaces shade by three numbers a pixel (the normal times the albedo), so their samples over
//! the images span three dimensions when they are linear, and more when a curve lies on them,
//! whatever the lights are (Belhumeur and Kriegman 1998). Both readings are tried; the one that
//! leaves less beside three dimensions explains the photographs better.
//!
//! Shadows and saturated samples are left out one by one, and the rest is fitted as if they had never
//! been taken ([`fit`]). What is left is compared twice, as a sum over the pixels and at the median
//! pixel: highlights weigh in the sum, ambient light and bounces at the median. The answer is the
//! weaker of the two where they agree. Where they do not, the pixels that every lamp reaches decide
//! alone.
use normalight_core::{ImageStack, Mask, Samples, Transfer, evenly_spaced_indices};

mod eigen;
mod fit;
#[cfg(test)]
mod measured;

use eigen::principal;

/// Most images and pixels that are looked at.
const IMAGES: usize = 20;
const PIXELS: usize = 3000;
/// Most pixels of the fit with gaps, which takes longer.
const FITTED_PIXELS: usize = 800;
/// Fewest with which anything can be said: three dimensions must not explain everything.
const FEWEST_IMAGES: usize = 6;
const FEWEST_PIXELS: usize = 150;
/// Fewest samples of a pixel.
const FEWEST_SAMPLES: usize = 5;

/// What the pixels say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Evidence {
    /// How much worse linear samples explain the photographs than sRGB ones, as a factor: above 1
    /// they look encoded, below 1 linear.
    pub(crate) factor: f32,
    /// Whether sum and median agree; otherwise the answer is hardly better than a guess.
    pub(crate) agreed: bool,
}

/// Logarithms of the factor, and how often an answer at least so far from 0 is right where sum and
/// median agree: for stacks that look linear, and for those that look encoded.
///
/// Measured on 360 rendered stacks of 6 to 40 photographs (`measured`): a quarter each matt, of all
/// materials, glossy, and of measured materials; every one linear (half in 16 bits, half in 8) and
/// encoded in 8 bits. Shares of the linear and of the encoded stacks in percent:
///
/// | logarithm    | linear: right | wrong | encoded: right | wrong |
/// | ------------ | ------------- | ----- | -------------- | ----- |
/// | 0 to 0.3     | 26.3          | 9.4   | 14.9           | 15.0  |
/// | 0.3 to 0.5   | 9.2           | 0.8   | 11.1           | 6.9   |
/// | 0.5 to 1     | 21.1          | 2.2   | 11.7           | 4.4   |
/// | above 1      | 13.1          | 0.6   | 13.1           | 0.6   |
/// | not agreed   | 2.9           | 1.2   | 2.8            | 17.4  |
///
/// The rest is seen too little of. Gloss is what misleads: it hides a curve, and where sum and median
/// do not agree stacks that look linear are mostly encoded ones with highlights.
const LINEAR: [(f32, f32); 3] = [(0.0, 0.6), (0.5, 0.83), (1.0, 0.96)];
const ENCODED: [(f32, f32); 3] = [(0.0, 0.6), (0.3, 0.88), (1.0, 0.96)];

impl Evidence {
    /// The reading that explains the photographs better.
    pub(crate) fn looks(self) -> Transfer {
        match self.factor > 1.0 {
            true => Transfer::Srgb,
            false => Transfer::Linear,
        }
    }

    /// How often such an answer is right where both readings are as frequent, 0.5 to 1.
    pub(crate) fn sure(self) -> f32 {
        let table = match self.looks() {
            Transfer::Linear => LINEAR,
            Transfer::Srgb => ENCODED,
        };
        let far = self.factor.ln().abs();
        let reached = table.iter().rev().find(|(least, _)| far >= *least);
        match reached {
            Some((_, share)) if self.agreed => *share,
            _ => 0.5,
        }
    }
}

/// What the pixels inside the mask say; `None` where too little can be seen.
pub(crate) fn of_stack(stack: &ImageStack, mask: &Mask) -> Option<Evidence> {
    if stack.len() < FEWEST_IMAGES {
        return None;
    }
    let chosen = evenly_spaced_indices(stack.len(), IMAGES);
    let inside = mask.pixels();
    // Many more than are used: most lie in some shadow.
    let tried = evenly_spaced_indices(inside.len(), 20 * PIXELS);
    let pixels: Vec<Vec<f32>> = tried
        .into_iter()
        .map(|place| {
            chosen
                .iter()
                .map(|&image| code(stack, image, inside[place]))
                .collect()
        })
        .collect();
    let agreed = agreed(&pixels);
    let log = agreed.or_else(|| everywhere_lit(&pixels))?;
    Some(Evidence {
        factor: log.exp() as f32,
        agreed: agreed.is_some(),
    })
}

/// The logarithm of the factor by the fit with gaps, where sum and median agree.
fn agreed(pixels: &[Vec<f32>]) -> Option<f64> {
    let usable: Vec<&Vec<f32>> = pixels
        .iter()
        .filter(|codes| {
            codes.iter().filter(|&&code| is_seen(code, codes)).count() >= FEWEST_SAMPLES
        })
        .collect();
    if usable.len() < FEWEST_PIXELS {
        return None;
    }
    let kept = evenly_spaced_indices(usable.len(), FITTED_PIXELS);
    let beside = |transfer: Transfer| {
        let rows: Vec<Vec<Option<f64>>> = kept
            .iter()
            .map(|&place| {
                let codes = usable[place].iter();
                codes
                    .map(|&code| {
                        is_seen(code, usable[place]).then(|| f64::from(transfer.decode(code)))
                    })
                    .collect()
            })
            .collect();
        fit::beside_three(&rows)
    };
    let (linear, srgb) = (beside(Transfer::Linear)?, beside(Transfer::Srgb)?);
    let sum = (linear.sum / srgb.sum).ln();
    let median = (linear.median / srgb.median).ln();
    let weaker = if sum.abs() < median.abs() {
        sum
    } else {
        median
    };
    (weaker.is_finite() && sum * median > 0.0).then_some(weaker)
}

/// Neither in shadow nor saturated.
fn is_seen(code: f32, codes: &[f32]) -> bool {
    let brightest = codes.iter().copied().fold(0.0, f32::max);
    code > 0.02 && code > 0.15 * brightest && code < 0.97
}

/// The logarithm of the factor by the pixels that every lamp reaches.
fn everywhere_lit(pixels: &[Vec<f32>]) -> Option<f64> {
    let lit = |codes: &&Vec<f32>| codes.iter().all(|&code| is_seen(code, codes));
    let pixels: Vec<&Vec<f32>> = pixels.iter().filter(lit).collect();
    if pixels.len() < FEWEST_PIXELS {
        return None;
    }
    let kept = evenly_spaced_indices(pixels.len(), PIXELS);
    let beside = |transfer: Transfer| {
        let rows = kept.iter().map(|&place| {
            let light: Vec<f64> = pixels[place]
                .iter()
                .map(|&code| f64::from(transfer.decode(code)))
                .collect();
            let length = light.iter().map(|value| value * value).sum::<f64>().sqrt();
            light
                .into_iter()
                .map(|value| value / length)
                .collect::<Vec<f64>>()
        });
        beside_three(&rows.collect::<Vec<_>>())
    };
    let log = (beside(Transfer::Linear) / beside(Transfer::Srgb)).ln();
    log.is_finite().then_some(log)
}

/// The green or grey sample as stored, full scale 1.
fn code(stack: &ImageStack, image: usize, pixel: usize) -> f32 {
    let image = &stack.images()[image];
    let place = pixel * image.channels + image.channels / 2;
    match &image.samples {
        Samples::U8(codes) => f32::from(codes[place]) / 255.0,
        Samples::U16(codes) => f32::from(codes[place]) / 65_535.0,
        Samples::F32(values) => values[place],
    }
}

/// The share of the rows' variation that three dimensions do not explain.
fn beside_three(rows: &[Vec<f64>]) -> f64 {
    let axes = principal(rows);
    let beside = |dimensions: usize| -> f64 {
        let axes = &axes[..dimensions];
        rows.iter()
            .map(|row| (1.0 - explained(row, axes)).max(0.0))
            .sum()
    };
    // The first dimension is the mean brightness, which every reading explains.
    beside(3) / beside(1)
}

/// The part of a unit vector's square that lies along some axes.
fn explained(row: &[f64], axes: &[Vec<f64>]) -> f64 {
    let along = |axis: &Vec<f64>| {
        let product: f64 = row.iter().zip(axis).map(|(a, b)| a * b).sum();
        product * product
    };
    axes.iter().map(along).sum()
}
