//! All shots of a stack laid over each other at once.
use super::shots::{Fit, Spectra};
use crate::on_all_cores;
use rustfft::num_complex::Complex32;

/// Most rounds over the shots.
const ROUNDS: usize = 6;
/// A shot that moves by less, in pixels, lies where it belongs.
const SETTLED: f32 = 0.15;
/// Of so many shots one, and at most so many, are moved at once, all others lying still: two that exchanged their places
/// would do so for ever.
const AT_ONCE: (usize, usize) = (3, 16);
/// A shift above this, in pixels, is worth a second start.
const MOVED: f32 = 0.6;

/// Where each shot lies, and how well it fits all others there.
pub(super) struct Placement {
    /// Fits against the sum of the others; shifts are relative to where most shots lie.
    pub(super) fits: Vec<Fit>,
}

/// Each shot in turn is laid where it fits the sum of all others best, until nothing moves: a
/// change of the light moves the edges of single pairs of shots, each another way, so in the sum the
/// common structure wins.
///
/// The sum is first that of all shots as they lie, which is right if most are unmoved; if some
/// move, or are known to lie `apart`, also one that grows shot by shot, which is right if all are moved; the better
/// fit counts.
pub(super) fn place(spectra: &Spectra, apart: bool) -> Placement {
    let count = spectra.len();
    let mut best = settle(spectra, vec![[0.0; 2]; count]);
    let moved = |shift: &[f32; 2]| shift[0].hypot(shift[1]) > MOVED;
    if apart || best.0.iter().any(moved) {
        let grown = settle(spectra, grown(spectra));
        if grown.1 > 1.001 * best.1 {
            best = grown;
        }
    }
    let shifts = about_most(spectra, best.0);
    let sum = sum_of(spectra, &shifts);
    Placement {
        fits: fits(spectra, &sum, &(0..count).collect::<Vec<_>>(), &shifts),
    }
}

/// Shifts of shots that hardly moved, relative to where most shots lie.
pub(super) fn place_near(spectra: &Spectra) -> Vec<[f32; 2]> {
    let shifts = settle(spectra, vec![[0.0; 2]; spectra.len()]).0;
    about_most(spectra, shifts)
}

/// How shots fit the sum of all others, two at a time, which is as fast as one.
fn fits(spectra: &Spectra, sum: &[Complex32], shots: &[usize], shifts: &[[f32; 2]]) -> Vec<Fit> {
    let twos: Vec<&[usize]> = shots.chunks(2).collect();
    let found = on_all_cores(twos.len(), |two| {
        spectra.fits_to_others(sum, twos[two], shifts)
    });
    found.into_iter().flatten().collect()
}

fn about_most(spectra: &Spectra, mut shifts: Vec<[f32; 2]>) -> Vec<[f32; 2]> {
    let seen: Vec<[f32; 2]> = (0..shifts.len())
        .filter(|&shot| !spectra.is_empty(shot))
        .map(|shot| shifts[shot])
        .collect();
    let middle = geometric_median(&seen);
    for shift in &mut shifts {
        *shift = [shift[0] - middle[0], shift[1] - middle[1]];
    }
    shifts
}

fn sum_of(spectra: &Spectra, shifts: &[[f32; 2]]) -> Vec<Complex32> {
    let mut sum = spectra.zeros();
    for (shot, &shift) in shifts.iter().enumerate() {
        spectra.add(&mut sum, shot, shift, 1.0);
    }
    sum
}

/// Shifts of each shot against the sum of those before it.
fn grown(spectra: &Spectra) -> Vec<[f32; 2]> {
    let mut sum = spectra.zeros();
    (0..spectra.len())
        .map(|shot| {
            let shift = spectra.fit(&sum, shot).shift;
            spectra.add(&mut sum, shot, shift, 1.0);
            shift
        })
        .collect()
}

/// Rounds from a start over those that still move; the shifts and the energy of the sum, the larger the better they fit.
fn settle(spectra: &Spectra, mut shifts: Vec<[f32; 2]>) -> (Vec<[f32; 2]>, f64) {
    let mut sum = sum_of(spectra, &shifts);
    let mut moving: Vec<usize> = (0..shifts.len()).collect();
    let at_once = (shifts.len() / AT_ONCE.0).clamp(1, AT_ONCE.1);
    for _ in 0..ROUNDS {
        let mut moved = Vec::new();
        for shots in moving.chunks(at_once) {
            let found = fits(spectra, &sum, shots, &shifts);
            for (&shot, Fit { shift: found, .. }) in shots.iter().zip(found) {
                let old = std::mem::replace(&mut shifts[shot], found);
                spectra.add(&mut sum, shot, old, -1.0);
                spectra.add(&mut sum, shot, found, 1.0);
                if (found[0] - old[0]).hypot(found[1] - old[1]) >= SETTLED {
                    moved.push(shot);
                }
            }
        }
        moving = moved;
        if moving.is_empty() {
            break;
        }
    }
    let energy = |value: &Complex32| f64::from(value.norm_sqr());
    (shifts, sum.iter().map(energy).sum())
}

/// The point with the least sum of distances to all (Weiszfeld's iteration): where most lie, however
/// far the others are.
pub(super) fn geometric_median(points: &[[f32; 2]]) -> [f32; 2] {
    let mut middle: [f32; 2] = std::array::from_fn(|axis| {
        let mut along: Vec<f32> = points.iter().map(|point| point[axis]).collect();
        along.sort_by(f32::total_cmp);
        along.get(along.len() / 2).copied().unwrap_or(0.0)
    });
    for _ in 0..30 {
        let (mut sum, mut weights) = ([0.0; 2], 0.0);
        for point in points {
            let distance = (point[0] - middle[0]).hypot(point[1] - middle[1]);
            let weight = 1.0 / distance.max(0.02);
            sum = [sum[0] + weight * point[0], sum[1] + weight * point[1]];
            weights += weight;
        }
        if weights > 0.0 {
            middle = sum.map(|sum: f32| sum / weights);
        }
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_stays_with_most() {
        let mut points = vec![[1.0, -2.0]; 7];
        points.extend([[90.0, 3.0], [-40.0, 60.0], [5.0, 5.0]]);
        let found = geometric_median(&points);
        assert!((found[0] - 1.0).hypot(found[1] + 2.0) < 0.05, "{found:?}");
    }
}
