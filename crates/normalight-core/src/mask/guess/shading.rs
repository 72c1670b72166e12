//! How the background shades as the lamp moves, seen at the border of the frame.
//!
//! Over the images a matt plane is its colour times one series of numbers, the light that falls on
//! it, which changes slowly over the frame when the lamp is near. The logarithm of a pixel less its
//! mean over the images is free of the colour, so a table top has one such series whatever is printed
//! on it; a background that the lamp does not reach has one too. Surfaces turned otherwise have others.
use super::cells::Cells;
use crate::on_all_cores;

/// Most surfaces of a background: a table top, a wall, another.
const SURFACES: usize = 3;
/// Smallest share of the border that makes a further surface; the object may cross the border on less.
const SHARE: f32 = 0.25;
/// Differences of logarithms that are noise, and such as no one surface has.
const TOLERANCE: [f32; 2] = [0.08, 0.3];
/// How much darker a cast shadow is at least, as a logarithm.
const SHADOW: f32 = 0.7;
const TERMS: usize = 6;

/// The shading of one surface: for each image a polynomial of the place in the frame.
pub(super) struct Shading {
    coefficients: Vec<[f64; TERMS]>,
}

/// Logarithms of light, `[cells, images]`, of cells at places in the frame.
pub(super) struct Series {
    pub(super) places: Vec<[f32; 2]>,
    pub(super) images: usize,
    pub(super) logs: Vec<f32>,
}

impl Series {
    /// The light of some cells; `floor` is added, below which light is noise.
    pub(super) fn new(cells: &Cells, chosen: &[usize], floor: f32) -> Self {
        let logs = chosen
            .iter()
            .flat_map(|&cell| cells.light(cell))
            .map(|light| libm::logf(light + floor));
        Self {
            images: cells.images,
            logs: logs.collect(),
            places: chosen
                .iter()
                .map(|&cell| cells.grid.centre(cells.places[cell]))
                .collect(),
        }
    }

    pub(super) fn of(&self, cell: usize) -> &[f32] {
        &self.logs[cell * self.images..(cell + 1) * self.images]
    }
}

impl Shading {
    /// Adds the series at a place, times `factor`, to `series`.
    pub(super) fn add_to(&self, place: [f32; 2], factor: f32, series: &mut [f32]) {
        let terms = terms(place);
        for (value, coefficients) in series.iter_mut().zip(&self.coefficients) {
            let sum: f64 = coefficients.iter().zip(&terms).map(|(c, t)| c * t).sum();
            *value += factor * sum as f32;
        }
    }

    /// As one cell shades, less its mean over the images, which is its colour.
    fn constant(series: &[f32]) -> Self {
        let mean = series.iter().sum::<f32>() / series.len() as f32;
        let coefficients = series.iter().map(|&value| {
            let mut terms = [0.0; TERMS];
            terms[0] = f64::from(value - mean);
            terms
        });
        Self {
            coefficients: coefficients.collect(),
        }
    }

    /// Least squares over some cells with the first `order` terms, those of the slope damped; images
    /// in which a cell is further than `shadow` from what was found before do not count.
    fn fit(&self, series: &Series, chosen: &[usize], order: usize, shadow: f32) -> Self {
        let mut normal = vec![[[0.0; TERMS]; TERMS]; series.images];
        let mut right = vec![[0.0; TERMS]; series.images];
        let mut rest = vec![0.0; series.images];
        for &cell in chosen {
            let place = series.places[cell];
            let terms = terms(place);
            rest.copy_from_slice(series.of(cell));
            self.add_to(place, -1.0, &mut rest);
            let middle = spread(&mut rest.clone()).1;
            for (image, &value) in series.of(cell).iter().enumerate() {
                if (rest[image] - middle).abs() > shadow {
                    continue;
                }
                for a in 0..order {
                    for b in 0..order {
                        normal[image][a][b] += terms[a] * terms[b];
                    }
                    right[image][a] += terms[a] * f64::from(value - middle);
                }
            }
        }
        let coefficients = normal.into_iter().zip(right).map(|(mut normal, sums)| {
            for (term, row) in normal.iter_mut().enumerate() {
                // Seen on one side of the frame only, a slope is hardly known.
                row[term] += match term {
                    0 => 1e-6,
                    _ if term < order => 0.01 * chosen.len() as f64,
                    _ => 1.0,
                };
            }
            solved(normal, sums)
        });
        Self {
            coefficients: coefficients.collect(),
        }
    }

    fn inliers(&self, series: &Series, among: &[usize], tolerance: f32) -> Vec<usize> {
        let mut rest = vec![0.0; series.images];
        let fits = |&&cell: &&usize| {
            rest.copy_from_slice(series.of(cell));
            self.add_to(series.places[cell], -1.0, &mut rest);
            spread(&mut rest).0 < tolerance
        };
        among.iter().filter(fits).copied().collect()
    }
}

/// How far most of some logarithms, sorted, lie about their middle, and that middle: half of the shortest
/// interval that holds `held` of them (the shorth, a robust scale: Rousseeuw and Leroy 1988).
fn shorth(sorted: &[f32], held: usize) -> (f32, f32) {
    let held = held.max(3).min(sorted.len());
    let (length, first) = (0..=sorted.len() - held)
        .map(|first| (sorted[first + held - 1] - sorted[first], first))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or_default();
    (length / 2.0, sorted[first] + length / 2.0)
}

/// As [`shorth`] of more than half of the values, or of nearly all that lie above a gap as deep as a
/// cast shadow: the lit ones, where a shadow falls in most of the images.
pub(super) fn spread(values: &mut [f32]) -> (f32, f32) {
    values.sort_unstable_by(f32::total_cmp);
    let most = shorth(values, values.len() / 2 + 1);
    let fewest = (values.len() / 4).max(3);
    let gaps = (1..=values.len().saturating_sub(fewest))
        .map(|first| (values[first] - values[first - 1], first));
    match gaps.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((gap, first)) if gap > SHADOW => {
            let lit = &values[first..];
            let lit = shorth(lit, (3 * lit.len()).div_ceil(4));
            if lit.0 < most.0 { lit } else { most }
        }
        _ => most,
    }
}

/// The surfaces that a border shows, the most common one first, and which of its cells belong to one.
pub(super) fn surfaces(border: &Series) -> (Vec<Shading>, Vec<bool>) {
    let all = border.places.len();
    let mut left: Vec<usize> = (0..all).collect();
    let (mut found, mut explained) = (Vec::new(), vec![false; all]);
    while found.len() < SURFACES && !left.is_empty() {
        let (mut shading, mut inliers) = most_alike(border, &left);
        // From far to near: a near lamp's light changes more over the frame than a first fit knows.
        let [near, far] = [(TOLERANCE[1], TOLERANCE[0]), (SHADOW, TOLERANCE[1])];
        for (order, (shadow, tolerance)) in [
            (1, far),
            (3, far),
            (TERMS, far),
            (TERMS, near),
            (TERMS, near),
        ] {
            if inliers.len() < 2 * TERMS {
                break;
            }
            shading = shading.fit(border, &inliers, order, shadow);
            inliers = shading.inliers(border, &left, tolerance);
        }
        let wide = shading.inliers(border, &left, TOLERANCE[1]);
        if !found.is_empty() && (wide.len() as f32) < SHARE * all as f32 {
            break;
        }
        found.push(shading);
        for &cell in &inliers {
            explained[cell] = true;
        }
        left.retain(|cell| !wide.contains(cell));
        if (left.len() as f32) < SHARE * all as f32 {
            break;
        }
    }
    (found, explained)
}

/// The cell whose series most of the others are like, as a surface, and those others.
fn most_alike(series: &Series, among: &[usize]) -> (Shading, Vec<usize>) {
    const TRIED: usize = 48;
    const ASKED: usize = 1000;
    let asked: Vec<usize> = crate::evenly_spaced_indices(among.len(), ASKED)
        .into_iter()
        .map(|place| among[place])
        .collect();
    let trials = crate::evenly_spaced_indices(among.len(), TRIED);
    let found = on_all_cores(trials.len(), |trial| {
        let shading = Shading::constant(series.of(among[trials[trial]]));
        let inliers = shading.inliers(series, &asked, TOLERANCE[1]).len();
        (shading, inliers)
    });
    let most = found.into_iter().max_by_key(|(_, inliers)| *inliers);
    let shading = most.map_or_else(|| Shading::constant(series.of(0)), |(shading, _)| shading);
    let inliers = shading.inliers(series, among, TOLERANCE[1]);
    (shading, inliers)
}

fn terms([x, y]: [f32; 2]) -> [f64; TERMS] {
    let (x, y) = (f64::from(x), f64::from(y));
    [1.0, x, y, x * x, x * y, y * y]
}

/// The solution of a positive definite system, by elimination.
fn solved(mut matrix: [[f64; TERMS]; TERMS], mut right: [f64; TERMS]) -> [f64; TERMS] {
    for pivot in 0..TERMS {
        let row = matrix[pivot];
        for below in pivot + 1..TERMS {
            let factor = matrix[below][pivot] / row[pivot];
            for (value, above) in matrix[below].iter_mut().zip(row) {
                *value -= factor * above;
            }
            right[below] -= factor * right[pivot];
        }
    }
    for row in (0..TERMS).rev() {
        let known: f64 = (row + 1..TERMS).map(|k| matrix[row][k] * right[k]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shadows_do_not_move_the_spread() {
        let (half, middle) = spread(&mut [-3.0, 0.1, 0.0, -2.0, 0.2, -9.0, 0.1]);
        assert!((half - 0.1).abs() < 1e-6 && (middle - 0.1).abs() < 1e-6);
        // Most are in shadow, and not equally dark.
        let (half, middle) = spread(&mut [-3.0, 0.1, 0.0, -2.0, 0.2, -2.5, -3.5, -4.0]);
        assert!((half - 0.1).abs() < 1e-6 && (middle - 0.1).abs() < 1e-6);
        // A slope is no shadow.
        let (half, _) = spread(&mut [0.0, -0.4, -0.8, -1.2, -1.6, -2.0, -2.4]);
        assert!((half - 0.6).abs() < 1e-6);
    }

    #[test]
    fn a_system_is_solved() {
        let matrix: [[f64; TERMS]; TERMS] = std::array::from_fn(|row| {
            std::array::from_fn(|k| if row == k { 4.0 + row as f64 } else { 0.5 })
        });
        let wanted = [1.0, -2.0, 3.0, 0.5, 0.0, 7.0];
        let right = matrix.map(|row| row.iter().zip(wanted).map(|(a, x)| a * x).sum());
        for (found, wanted) in solved(matrix, right).into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12);
        }
    }
}
