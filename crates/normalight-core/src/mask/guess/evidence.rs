//! What tells object and background apart at one place, and by how much.
use super::cells::{Cells, PART};
use super::shading::{Series, Shading, spread, surfaces};
use crate::on_all_cores;

/// Numbers that a cell is judged by: how unlike the background it shades, how bright it is beside it,
/// and two of colour. All are logarithms.
pub(super) const FEATURES: usize = 4;
pub(super) type Features = [f32; FEATURES];
const BINS: usize = 32;
/// Share of a distribution that is spread evenly: no value is impossible, so no one feature decides alone.
const EVEN: f32 = 0.04;
/// Differences in shading below this are noise.
const SHADING_FLOOR: f32 = 0.02;

/// The background as the border of the frame shows it.
pub(super) struct Background {
    surfaces: Vec<Shading>,
    /// Light below this is noise.
    floor: f32,
}

impl Background {
    /// From the cells of the border; also tells which of them belong to the background's surfaces.
    pub(super) fn new(cells: &Cells, border: &[usize], floor: f32) -> (Self, Vec<bool>) {
        let (surfaces, explained) = surfaces(&Series::new(cells, border, floor));
        (Self { surfaces, floor }, explained)
    }

    /// What cells are judged by.
    pub(super) fn features(&self, cells: &Cells) -> Vec<Features> {
        let parts = on_all_cores(cells.len().div_ceil(PART), |part| {
            let mut rest = vec![0.0; cells.images];
            (part * PART..cells.len().min((part + 1) * PART))
                .map(|cell| self.features_of(cells, cell, &mut rest))
                .collect::<Vec<Features>>()
        });
        parts.into_iter().flatten().collect()
    }

    /// What one cell is judged by; `rest` is room for one number an image.
    fn features_of(&self, cells: &Cells, cell: usize, rest: &mut [f32]) -> Features {
        let place = cells.grid.centre(cells.places[cell]);
        let (mut unlike, mut level) = (f32::MAX, 0.0);
        for surface in &self.surfaces {
            for (value, light) in rest.iter_mut().zip(cells.light(cell)) {
                *value = libm::logf(light + self.floor);
            }
            surface.add_to(place, -1.0, rest);
            let (half, middle) = spread(rest);
            if half < unlike {
                (unlike, level) = (half, middle);
            }
        }
        let chroma_floor = 2.0 * self.floor;
        let [r, g, b] = cells.colours[cell].map(|value| libm::logf(value + chroma_floor));
        [libm::logf(unlike + SHADING_FLOOR), level, r - g, b - g]
    }
}

/// The ranges that the features' distributions are counted over.
pub(super) struct Bins {
    low: Features,
    scale: Features,
}

impl Bins {
    /// Over nearly all of some values.
    pub(super) fn new(features: &[Features]) -> Self {
        // Of a bin: finer differences are noise or texture.
        const NARROWEST: Features = [0.14, 0.07, 0.04, 0.04];
        let (mut low, mut scale) = ([0.0; FEATURES], [0.0; FEATURES]);
        for feature in 0..FEATURES {
            let mut values: Vec<f32> = features.iter().map(|cell| cell[feature]).collect();
            values.sort_unstable_by(f32::total_cmp);
            let (first, last) = (
                values[values.len() / 500],
                values[values.len() - 1 - values.len() / 500],
            );
            let width = ((last - first) / BINS as f32).max(NARROWEST[feature]);
            low[feature] = (first + last - width * BINS as f32) / 2.0;
            scale[feature] = 1.0 / width;
        }
        Self { low, scale }
    }

    fn bin(&self, feature: usize, value: f32) -> usize {
        // A cast of a negative number gives 0.
        (((value - self.low[feature]) * self.scale[feature]) as usize).min(BINS - 1)
    }
}

/// Logarithms of the features' densities in one kind of cells, relative to an even one.
#[derive(Clone)]
pub(super) struct Densities([[f32; BINS]; FEATURES]);

impl Densities {
    /// Of cells with weights.
    pub(super) fn new(bins: &Bins, cells: impl Iterator<Item = (Features, f32)>) -> Self {
        let mut counts = [[0.0f32; BINS]; FEATURES];
        let mut total = 0.0;
        for (features, weight) in cells {
            total += weight;
            for (feature, value) in features.into_iter().enumerate() {
                counts[feature][bins.bin(feature, value)] += weight;
            }
        }
        if total <= 0.0 {
            // Nothing is known.
            return Self([[0.0; BINS]; FEATURES]);
        }
        for counts in &mut counts {
            for _ in 0..2 {
                *counts = smoothed(counts);
            }
            for count in counts.iter_mut() {
                let density = *count / total * BINS as f32;
                *count = libm::logf((1.0 - EVEN) * density + EVEN);
            }
        }
        Self(counts)
    }

    /// By how much more likely, as a logarithm, features are here than there.
    pub(super) fn ratio(&self, there: &Self, bins: &Bins, features: Features) -> f32 {
        let all = features.into_iter().enumerate();
        all.map(|(feature, value)| {
            let bin = bins.bin(feature, value);
            self.0[feature][bin] - there.0[feature][bin]
        })
        .sum()
    }
}

fn smoothed(counts: &[f32; BINS]) -> [f32; BINS] {
    std::array::from_fn(|bin| {
        let (before, after) = (bin.saturating_sub(1), (bin + 1).min(BINS - 1));
        (counts[before] + 2.0 * counts[bin] + counts[after]) / 4.0
    })
}
