//! The frame in which vectors are normals of a surface.
use super::eigen::eigenpairs;
use super::sampled::{FEW, Sampled};
use crate::CoreError;
use glam::{DMat3, DVec3};

/// Rounds of reweighting.
const ROUNDS: usize = 20;
/// Residuals beyond this many standard deviations count little.
const SPREAD: f64 = 1.5;

/// Three rows `p` for which `p.s` are a light's x, y and, up to the bas-relief, z.
///
/// The normals `n = P b` of a surface have `d(n1/n3)/dy = d(n2/n3)/dx`. With the rows of `P` that is
/// `(p1 x p3).(b x db/dy) = (p2 x p3).(b x db/dx)` (Yuille and Snow 1997): linear in the six numbers of the two
/// products, which are found as the smallest eigenvector over all pixels, reweighted by Cauchy's loss because steps,
/// shadows and highlights break it. Up to one factor the rows of the inverse transpose of `P`, which takes lights to
/// lights, are `p2 x p3`, `p3 x p1` and one that stays open.
///
/// # Errors
/// [`CoreError::RankTooLow`] where the vectors lie in a plane; [`CoreError::TooFewPixels`].
pub(super) fn integrable(vectors: &[DVec3], sampled: &Sampled) -> Result<[DVec3; 3], CoreError> {
    let low = || CoreError::RankTooLow {
        images: sampled.images(),
    };
    let unit: Vec<DVec3> = vectors.iter().map(|b| b.normalize_or_zero()).collect();
    let whiten = whitening(&unit).ok_or_else(low)?;
    let unit: Vec<DVec3> = unit
        .iter()
        .map(|&b| (whiten * b).normalize_or_zero())
        .collect();
    let equations: Vec<[f64; 6]> = sampled
        .crosses()
        .into_iter()
        .filter(|cross| cross.iter().all(|&pixel| unit[pixel] != DVec3::ZERO))
        .map(|[pixel, left, right, above, below]| {
            let across = unit[pixel].cross(unit[right] - unit[left]);
            let up = unit[pixel].cross(unit[above] - unit[below]);
            [up.x, up.y, up.z, -across.x, -across.y, -across.z]
        })
        .collect();
    if equations.len() < FEW {
        return Err(CoreError::TooFewPixels {
            found: equations.len(),
            expected: FEW,
        });
    }
    let six = smallest(&equations);
    let [p1_p3, p2_p3] = [0, 3].map(|at| DVec3::from_slice(&six[at..at + 3]));
    let third = p1_p3.cross(p2_p3);
    let scale = ((p1_p3.length_squared() + p2_p3.length_squared()) / 2.0).sqrt();
    let independent = third.length() > 1e-6 * scale * scale;
    if !independent {
        return Err(low());
    }
    // Lights s' of the whitened frame are W^-T s.
    let back = whiten.inverse();
    let rows = [p2_p3, -p1_p3, third.normalize() * scale];
    Ok(rows.map(|row| back * row))
}

/// The matrix that gives vectors the same spread in all directions, so that none is hidden by the others. `None` where
/// they have none in some direction.
fn whitening(vectors: &[DVec3]) -> Option<DMat3> {
    let gram = vectors
        .iter()
        .fold(DMat3::ZERO, |sum, &b| sum + crate::woodham::outer(b));
    let rows = gram.to_cols_array_2d().map(|column| column.to_vec());
    let pairs = eigenpairs(rows.to_vec());
    let enough = pairs[2].0 > 1e-7 * pairs[0].0;
    let row =
        |k: usize| DVec3::from_slice(&pairs[k].1) / (pairs[k].0 / vectors.len() as f64).sqrt();
    enough.then(|| DMat3::from_cols(row(0), row(1), row(2)).transpose())
}

/// The unit vector with the smallest products with equations, in the sense of Cauchy's loss.
fn smallest(equations: &[[f64; 6]]) -> Vec<f64> {
    let mut weights = vec![1.0; equations.len()];
    let mut found = Vec::new();
    for _ in 0..ROUNDS {
        let mut gram = vec![vec![0.0; 6]; 6];
        for (equation, weight) in equations.iter().zip(&weights) {
            for (line, a) in gram.iter_mut().zip(equation) {
                for (sum, b) in line.iter_mut().zip(equation) {
                    *sum += weight * a * b;
                }
            }
        }
        found = eigenpairs(gram).swap_remove(5).1;
        let products = equations.iter().map(|equation| {
            let pairs = equation.iter().zip(&found);
            pairs.map(|(a, b)| a * b).sum::<f64>().abs()
        });
        let residuals: Vec<f64> = products.collect();
        let mut sorted = residuals.clone();
        let middle = sorted.len() / 2;
        let median = *sorted.select_nth_unstable_by(middle, f64::total_cmp).1;
        // 1.4826 turns the median into a standard deviation.
        let scale = (SPREAD * 1.4826 * median).max(1e-12);
        for (weight, residual) in weights.iter_mut().zip(&residuals) {
            *weight = 1.0 / (1.0 + (residual / scale).powi(2));
        }
    }
    found
}
