//! All shots of a stack laid over each other at once.
use super::shots::{Fit, Spectra};
use rustfft::num_complex::Complex32;

/// Most rounds over all shots.
const ROUNDS: usize = 6;
/// A round in which no shot moves by more pixels is the last.
const SETTLED: f32 = 0.15;
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
/// move, also one that grows shot by shot, which is right if all are moved; the better fit counts.
pub(super) fn place(spectra: &Spectra) -> Placement {
    let count = spectra.len();
    let mut best = settle(spectra, vec![[0.0; 2]; count]);
    let moved = |shift: &[f32; 2]| shift[0].hypot(shift[1]) > MOVED;
    if best.0.iter().any(moved) {
        let grown = settle(spectra, grown(spectra));
        if grown.1 > 1.001 * best.1 {
            best = grown;
        }
    }
    let mut shifts = best.0;
    let seen: Vec<[f32; 2]> = (0..count)
        .filter(|&shot| !spectra.is_empty(shot))
        .map(|shot| shifts[shot])
        .collect();
    let middle = geometric_median(&seen);
    for shift in &mut shifts {
        *shift = [shift[0] - middle[0], shift[1] - middle[1]];
    }
    let mut sum = spectra.zeros();
    for (shot, &shift) in shifts.iter().enumerate() {
        spectra.add(&mut sum, shot, shift, 1.0);
    }
    let fits = (0..count).map(|shot| {
        spectra.add(&mut sum, shot, shifts[shot], -1.0);
        let fit = spectra.fit(&sum, shot);
        spectra.add(&mut sum, shot, shifts[shot], 1.0);
        fit
    });
    Placement {
        fits: fits.collect(),
    }
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

/// Rounds from a start; the shifts and the energy of the sum, the larger the better they fit.
fn settle(spectra: &Spectra, mut shifts: Vec<[f32; 2]>) -> (Vec<[f32; 2]>, f64) {
    let mut sum = spectra.zeros();
    for (shot, &shift) in shifts.iter().enumerate() {
        spectra.add(&mut sum, shot, shift, 1.0);
    }
    for _ in 0..ROUNDS {
        let mut farthest = 0.0f32;
        for (shot, shift) in shifts.iter_mut().enumerate() {
            spectra.add(&mut sum, shot, *shift, -1.0);
            let found = spectra.fit(&sum, shot).shift;
            farthest = farthest.max((found[0] - shift[0]).hypot(found[1] - shift[1]));
            *shift = found;
            spectra.add(&mut sum, shot, *shift, 1.0);
        }
        if farthest < SETTLED {
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
