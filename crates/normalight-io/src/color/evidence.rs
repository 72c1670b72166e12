//! Whether a stack's samples look proportional to light or encoded for viewing.
//!
//! Matt surfaces that every lamp reaches shade by three numbers a pixel (the normal times the
//! albedo), so their samples over the images span three dimensions when they are linear, and more
//! when a curve lies on them. Both readings are tried; the one that leaves less beside three
//! dimensions explains the photographs better.
//!
//! Measured as linear samples against their sRGB encoding: matt rendered and photographed objects
//! 0.55 to 0.93 against 1.07 to 1.8; glossy ones 0.5 against 0.5 to 0.7, so gloss hides a curve and
//! a stack that says nothing is always noticed, however clear it looks.
use normalight_core::{ImageStack, Mask, Samples, Transfer, evenly_spaced_indices};

/// Most images and pixels that are looked at.
const IMAGES: usize = 20;
const PIXELS: usize = 3000;
/// Fewest with which anything can be said: three dimensions must not explain everything.
const FEWEST_IMAGES: usize = 6;
const FEWEST_PIXELS: usize = 150;

/// How much worse linear samples explain the photographs than sRGB ones, as a factor: above 1 they
/// look encoded, below 1 linear. `None` where too little can be seen.
pub(crate) fn encoded_factor(stack: &ImageStack, mask: &Mask) -> Option<f32> {
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
        .filter(|codes: &Vec<f32>| is_lit(codes))
        .collect();
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
    let (linear, srgb) = (beside(Transfer::Linear), beside(Transfer::Srgb));
    (linear.is_finite() && srgb > 0.0).then(|| (linear / srgb) as f32)
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

/// Neither in shadow nor saturated in any image.
fn is_lit(codes: &[f32]) -> bool {
    let darkest = codes.iter().copied().fold(f32::MAX, f32::min);
    let brightest = codes.iter().copied().fold(0.0, f32::max);
    darkest > 0.02 && darkest > 0.15 * brightest && brightest < 0.97
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

/// The three directions in which rows extend most.
fn principal(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let size = rows[0].len();
    let mut products = vec![vec![0.0; size]; size];
    for row in rows {
        for (a, line) in products.iter_mut().enumerate() {
            for (b, sum) in line.iter_mut().enumerate() {
                *sum += row[a] * row[b];
            }
        }
    }
    let mut pairs = eigenpairs(products);
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs.into_iter().take(3).map(|(_, axis)| axis).collect()
}

/// Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations (Golub and Van Loan,
/// 8.5).
fn eigenpairs(mut m: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let size = m.len();
    // Row k is the k-th vector.
    let mut vectors: Vec<Vec<f64>> = (0..size)
        .map(|k| (0..size).map(|j| f64::from(u8::from(j == k))).collect())
        .collect();
    for _ in 0..30 {
        let mut off = 0.0;
        for p in 0..size {
            for q in p + 1..size {
                if m[p][q] == 0.0 {
                    continue;
                }
                off += m[p][q] * m[p][q];
                let ratio = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                let t = match ratio == 0.0 {
                    true => 1.0,
                    false => ratio.signum() / (ratio.abs() + (ratio * ratio + 1.0).sqrt()),
                };
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for row in &mut m {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                for rows in [&mut m, &mut vectors] {
                    let (upper, lower) = rows.split_at_mut(q);
                    for (a, b) in upper[p].iter_mut().zip(&mut lower[0]) {
                        (*a, *b) = (c * *a - s * *b, s * *a + c * *b);
                    }
                }
            }
        }
        let trace: f64 = (0..size).map(|k| m[k][k]).sum();
        if off <= 1e-22 * trace * trace {
            break;
        }
    }
    let values: Vec<f64> = (0..size).map(|k| m[k][k]).collect();
    values.into_iter().zip(vectors).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenpairs_of_a_known_matrix() {
        let m = vec![
            vec![2.0, 1.0, 0.0],
            vec![1.0, 2.0, 0.0],
            vec![0.0, 0.0, 5.0],
        ];
        let mut pairs = eigenpairs(m.clone());
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for ((found, vector), expected) in pairs.iter().zip([1.0, 3.0, 5.0]) {
            assert!((found - expected).abs() < 1e-10);
            for (row, value) in m.iter().zip(vector) {
                let product: f64 = row.iter().zip(vector).map(|(a, b)| a * b).sum();
                assert!((product - expected * value).abs() < 1e-10);
            }
        }
    }
}
