//! Which of all bas-reliefs has the plainest albedo.
use super::sampled::{FEW, Sampled};
use crate::{evenly_spaced_indices, on_all_cores};
use glam::{DMat3, DVec3};

/// Distance of the pixels that are compared: at one, noise and rounding hide how albedo changes.
const DISTANCE: isize = 5;
/// Pixels that are lit in so many of the images are compared.
const LIT: f32 = 0.9;
/// Most pairs that are compared.
const PAIRS: usize = 8000;
/// Relative difference of albedo beyond which it is taken for another material rather than an error.
const SAME: f64 = 0.02;
/// Steps of the search; it comes to rest after about a hundred.
const STEPS: usize = 200;

/// The generalised bas-relief `G`, rows (1, 0, 0), (0, 1, 0), (mu, nu, lambda) with lambda > 0, under which the
/// albedo `|G^T b|` of neighbours differs least.
pub(super) fn flattest_albedo(vectors: &[DVec3], sampled: &Sampled) -> DMat3 {
    let pairs = pairs(vectors, sampled);
    let cost = |&[mu, nu, depth]: &[f64; 3]| {
        let relief = transposed(mu, nu, depth);
        let log = |b: DVec3| 0.5 * (relief * b).length_squared().max(1e-300).ln();
        let off = pairs.iter().map(|&[a, b]| (log(a) - log(b)) / SAME);
        off.map(|off| (off * off).ln_1p()).sum::<f64>()
    };
    // Reliefs too flat and too deep lie in valleys of their own.
    let starts = [-0.7, 0.0, 0.7];
    let found = on_all_cores(starts.len(), |k| minimum([0.0, 0.0, starts[k]], &cost));
    let best = found.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let [mu, nu, depth] = best.map_or([0.0; 3], |(best, _)| best);
    transposed(mu, nu, depth).transpose()
}

/// `G^T`, with the logarithm of lambda.
fn transposed(mu: f64, nu: f64, depth: f64) -> DMat3 {
    DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(mu, nu, depth.exp()))
}

/// Vectors of neighbours in four directions, evenly thinned.
fn pairs(vectors: &[DVec3], sampled: &Sampled) -> Vec<[DVec3; 2]> {
    let steps = [[1, 0], [0, 1], [1, 1], [1, -1]];
    let find = |least: f32, distance: isize| -> Vec<[usize; 2]> {
        let usable = |pixel: usize| sampled.lit(pixel) >= least && vectors[pixel] != DVec3::ZERO;
        (0..sampled.len())
            .filter(|&pixel| usable(pixel))
            .flat_map(|pixel| steps.map(|[x, y]| (pixel, x * distance, y * distance)))
            .filter_map(|(pixel, x, y)| {
                let other = sampled.beside(pixel, x, y)?;
                usable(other).then_some([pixel, other])
            })
            .collect()
    };
    let mut found = find(LIT, DISTANCE);
    if found.len() < FEW {
        found = find(0.0, 1);
    }
    evenly_spaced_indices(found.len(), PAIRS)
        .into_iter()
        .map(|place| found[place].map(|pixel| vectors[pixel]))
        .collect()
}

/// A minimum near a start and its value, by the simplex of Nelder and Mead (1965).
fn minimum(start: [f64; 3], cost: &impl Fn(&[f64; 3]) -> f64) -> ([f64; 3], f64) {
    let corner = |axis: usize, step: f64| {
        let mut corner = start;
        corner[axis] += step;
        corner
    };
    let corners = [start, corner(0, 0.3), corner(1, 0.3), corner(2, 0.5)];
    let mut simplex = corners.map(|corner| (corner, cost(&corner)));
    let towards = |from: [f64; 3], to: [f64; 3], share: f64| {
        [0, 1, 2].map(|axis| from[axis] + share * (to[axis] - from[axis]))
    };
    for _ in 0..STEPS {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let [best, _, second, worst] = simplex;
        if worst.1 - best.1 <= 1e-12 * best.1.abs() {
            break;
        }
        let middle =
            [0, 1, 2].map(|axis| simplex[..3].iter().map(|c| c.0[axis]).sum::<f64>() / 3.0);
        let at = |share: f64| {
            let place = towards(worst.0, middle, share);
            (place, cost(&place))
        };
        let reflected = at(2.0);
        let better = if reflected.1 < best.1 {
            let expanded = at(3.0);
            Some(if expanded.1 < reflected.1 {
                expanded
            } else {
                reflected
            })
        } else if reflected.1 < second.1 {
            Some(reflected)
        } else {
            let outside = reflected.1 < worst.1;
            let contracted = at(if outside { 1.5 } else { 0.5 });
            (contracted.1 < worst.1.min(reflected.1)).then_some(contracted)
        };
        if let Some(better) = better {
            simplex[3] = better;
            continue;
        }
        for corner in &mut simplex[1..] {
            corner.0 = towards(best.0, corner.0, 0.5);
            corner.1 = cost(&corner.0);
        }
    }
    simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
    simplex[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_simplex_finds_a_known_minimum() {
        // Rosenbrock's valley in two of the numbers.
        let valley = |&[x, y, z]: &[f64; 3]| {
            (1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2) + (z + 2.0).powi(2)
        };
        let (mut place, mut value) = ([0.0; 3], f64::INFINITY);
        for _ in 0..4 {
            (place, value) = minimum(place, &valley);
        }
        assert!(value < 1e-6, "{place:?} {value}");
    }
}
