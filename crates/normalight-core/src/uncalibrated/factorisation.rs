//! Samples as a product of rank 3.
use super::eigen::leading;
use super::sampled::{FEW, Sampled};
use crate::robust::{Fitter, Kept, l1_weight};
use crate::{CoreError, on_all_cores};
use glam::{DMat3, DVec3, Vec3};

/// Turns over pixels and images.
const TURNS: usize = 8;
/// Rounds of reweighting of an image in each turn.
const WEIGHINGS: usize = 4;
/// Pixels that are lit in so many of the images start the factors.
const LIT: f32 = 0.9;
/// The third eigenvalue as a share of the first below which there are only two, and the factor by which it must exceed
/// the fourth. What rounding to 8 bits alone adds lies far below.
const RANK: [f64; 2] = [1e-5, 1.1];

/// Vectors of the pixels and of the images, whose products are the samples; up to one invertible matrix.
#[derive(Debug, Clone)]
pub(super) struct Factors {
    /// `b` of each pixel.
    pub pixels: Vec<DVec3>,
    /// `s` of each image.
    pub images: Vec<DVec3>,
}

impl Factors {
    /// Of samples, given how bright the lights are: what lies in the highlight of a dim light must not pass for a
    /// matte sample of a bright one.
    ///
    /// # Errors
    /// [`CoreError::RankTooLow`].
    pub fn new(sampled: &Sampled, intensities: &[f64]) -> Result<Self, CoreError> {
        let low = || CoreError::RankTooLow {
            images: sampled.images(),
        };
        let samples: Vec<Vec<f32>> = (0..sampled.len())
            .map(|pixel| {
                let even = sampled.of(pixel).iter().zip(intensities);
                even.map(|(&value, &by)| (f64::from(value) / by) as f32)
                    .collect()
            })
            .collect();
        let kept: Vec<Kept> = samples.iter().map(|values| Kept::of(values)).collect();
        let mut images = start(sampled, &samples).ok_or_else(low)?;
        let mut pixels = fit_pixels(&samples, &kept, &images);
        for _ in 0..TURNS {
            images = fit_images(&samples, &kept, &pixels, &images);
            pixels = fit_pixels(&samples, &kept, &images);
        }
        if !images.iter().all(|image| image.is_finite()) {
            return Err(low());
        }
        Ok(Self {
            pixels: pixels.into_iter().map(Vec3::as_dvec3).collect(),
            images: images
                .iter()
                .zip(intensities)
                .map(|(image, &by)| image.as_dvec3() * by)
                .collect(),
        })
    }
}

/// The three directions in which the images differ most, over pixels that are lit in nearly all of them; each pixel
/// counts alike, whatever its albedo. `None` where there are fewer.
fn start(sampled: &Sampled, samples: &[Vec<f32>]) -> Option<Vec<Vec3>> {
    let count = sampled.images();
    let lit = |least: f32| -> Vec<usize> {
        let pixels = 0..samples.len();
        pixels
            .filter(|&pixel| sampled.lit(pixel) >= least)
            .collect()
    };
    let pixels = [LIT, 0.5, f32::MIN_POSITIVE]
        .into_iter()
        .map(lit)
        .find(|pixels| pixels.len() >= FEW)?;
    let even: Vec<Vec<f64>> = pixels
        .iter()
        .map(|&pixel| {
            let values = samples[pixel].iter().map(|&value| f64::from(value));
            let length = values
                .clone()
                .map(|value| value * value)
                .sum::<f64>()
                .sqrt();
            values
                .map(|value| value / length.max(f64::MIN_POSITIVE))
                .collect()
        })
        .collect();
    let products = on_all_cores(count, |a| {
        let mut row = vec![0.0; count];
        for values in &even {
            for (sum, value) in row.iter_mut().zip(values) {
                *sum += values[a] * value;
            }
        }
        row
    });
    let pairs = leading(&products, 4);
    let [first, .., third, fourth] = &pairs[..] else {
        return None;
    };
    let three = third.0 > RANK[0] * first.0 && third.0 > RANK[1] * fourth.0;
    let scale = (count as f64).sqrt();
    three.then(|| {
        (0..count)
            .map(|k| DVec3::from([0, 1, 2].map(|axis| pairs[axis].1[k] * scale)).as_vec3())
            .collect()
    })
}

fn fit_pixels(samples: &[Vec<f32>], kept: &[Kept], images: &[Vec3]) -> Vec<Vec3> {
    const TILE: usize = 1024;
    let tiles = samples.len().div_ceil(TILE);
    let fitted = on_all_cores(tiles, |tile| {
        let mut fitter = Fitter::default();
        (tile * TILE..samples.len().min((tile + 1) * TILE))
            .map(|pixel| fitter.fit(images, &samples[pixel], kept[pixel]))
            .collect::<Vec<Vec3>>()
    });
    fitted.concat()
}

/// Each image's vector by the smallest sum of absolute residuals over the pixels that keep it, relative to their albedo.
fn fit_images(samples: &[Vec<f32>], kept: &[Kept], pixels: &[Vec3], images: &[Vec3]) -> Vec<Vec3> {
    on_all_cores(images.len(), |image| {
        let rows: Vec<(Vec3, f32)> = (0..samples.len())
            .filter(|&pixel| kept[pixel].keeps(samples[pixel][image]))
            .filter_map(|pixel| {
                let length = pixels[pixel].length();
                let row = (pixels[pixel] / length, samples[pixel][image] / length);
                (length > 0.0 && row.0.is_finite() && row.1.is_finite()).then_some(row)
            })
            .collect();
        let mut vector = images[image];
        for _ in 0..WEIGHINGS {
            vector = reweighted(&rows, vector).unwrap_or(vector);
        }
        vector
    })
}

/// One round of least squares with the weights of least absolute residuals. `None` where the rows leave it open.
fn reweighted(rows: &[(Vec3, f32)], vector: Vec3) -> Option<Vec3> {
    let mut residuals: Vec<f32> = rows
        .iter()
        .map(|(b, i)| (i - b.dot(vector)).abs())
        .collect();
    // Below a thousandth of the usual residual all weigh the same.
    let noise = 1e-3 * crate::albedo::quantile_of(&mut residuals, 0.5) + 1e-6 * vector.length();
    let (mut gram, mut sum) = (DMat3::ZERO, DVec3::ZERO);
    for &(row, value) in rows {
        let weight = f64::from(l1_weight(value - row.dot(vector), noise));
        let row = row.as_dvec3();
        gram += crate::woodham::outer(row) * weight;
        sum += row * (weight * f64::from(value));
    }
    let trace = gram.x_axis.x + gram.y_axis.y + gram.z_axis.z;
    let determined = gram.determinant() > 1e-9 * (trace / 3.0).powi(3);
    let next = (gram.inverse() * sum).as_vec3();
    (determined && next.is_finite()).then_some(next)
}
