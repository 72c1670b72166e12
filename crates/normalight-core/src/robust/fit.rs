//! A vector of three to samples of one pixel, some of which are wrong.
use glam::{DMat3, DVec3, Vec3};

/// Shares of a pixel's samples, in order of brightness, between which they are kept.
const KEPT: [f32; 2] = [0.1, 0.7];
/// Fewest samples that are fitted robustly.
const FEW: usize = 4;
/// Rounds of reweighting; where the vector comes to rest earlier, fewer.
const ROUNDS: usize = 12;
/// Residuals below this share of the brightest kept sample weigh the same: noise, and 1/0.
const NOISE: f32 = 1e-3;
/// Samples that are added up side by side, so that the compiler can use vectors.
const LANES: usize = 8;

/// Samples that are kept: the least and the most of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kept {
    least: f32,
    most: f32,
}

impl Kept {
    /// Everything that is lit but the darkest tenth and the brightest three tenths; everything that is lit where that leaves
    /// too little.
    pub fn of(values: &[f32]) -> Self {
        let mut sorted = values.to_vec();
        sorted.sort_unstable_by(f32::total_cmp);
        let count = sorted.len();
        let place = |share: f32| share * count as f32 - 0.5;
        let first = (place(KEPT[0]).ceil().max(0.0) as usize).min(count - 1);
        let last = (place(KEPT[1]).floor().max(0.0) as usize).min(count - 1);
        let trimmed = Self {
            least: sorted[first],
            most: sorted[last],
        };
        let kept = sorted.iter().filter(|&&value| trimmed.keeps(value));
        if kept.count() >= FEW {
            return trimmed;
        }
        Self {
            least: 0.0,
            most: f32::INFINITY,
        }
    }

    pub fn keeps(self, value: f32) -> bool {
        value > 0.0 && value >= self.least && value <= self.most
    }
}

/// The weight that turns least squares into least absolute residuals.
pub(crate) fn l1_weight(residual: f32, noise: f32) -> f32 {
    1.0 / residual.abs().max(noise)
}

/// Fits pixels one after the other; keeps its buffers.
#[derive(Debug, Default)]
pub(crate) struct Fitter {
    /// x, y and z of the lights of the kept samples, and the samples; padded to whole lanes with zeros.
    columns: [Vec<f32>; 4],
}

impl Fitter {
    /// The vector `g` for which the sum of `|value - light.g|` over the kept samples is smallest; least squares over all
    /// samples where those do not determine it, zero where these do not either.
    pub fn fit(&mut self, lights: &[Vec3], values: &[f32], kept: Kept) -> Vec3 {
        let count = self.fill(lights, values, |value| kept.keeps(value));
        let robust = (count >= FEW).then(|| self.absolute()).flatten();
        robust
            .or_else(|| {
                self.fill(lights, values, |_| true);
                self.squares(Vec3::ZERO, f32::INFINITY)
            })
            .unwrap_or(Vec3::ZERO)
    }

    /// Takes the samples that are to be kept; how many they are.
    fn fill(&mut self, lights: &[Vec3], values: &[f32], keeps: impl Fn(f32) -> bool) -> usize {
        for column in &mut self.columns {
            column.clear();
        }
        for (light, &value) in lights.iter().zip(values) {
            if keeps(value) {
                let row = [light.x, light.y, light.z, value];
                for (column, number) in self.columns.iter_mut().zip(row) {
                    column.push(number);
                }
            }
        }
        let count = self.columns[0].len();
        for column in &mut self.columns {
            column.resize(count.next_multiple_of(LANES), 0.0);
        }
        count
    }

    fn absolute(&self) -> Option<Vec3> {
        let noise = NOISE * self.columns[3].iter().copied().fold(0.0, f32::max);
        let mut vector = self.squares(Vec3::ZERO, f32::INFINITY)?;
        for _ in 0..ROUNDS {
            let next = self.squares(vector, noise)?;
            let moved = next.distance_squared(vector);
            vector = next;
            // A hundredth of a degree.
            if moved < 3e-8 * vector.length_squared() {
                break;
            }
        }
        Some(vector)
    }

    /// Weighted least squares; weights from the residuals of a vector. `None` where they leave it open.
    fn squares(&self, vector: Vec3, noise: f32) -> Option<Vec3> {
        // xx, xy, xz, yy, yz, zz of the lights, then lights by value.
        let mut sums = [[0.0f32; LANES]; 9];
        let rows = self
            .columns
            .each_ref()
            .map(|column| column.as_chunks::<LANES>().0);
        for (((x, y), z), value) in rows[0].iter().zip(rows[1]).zip(rows[2]).zip(rows[3]) {
            for k in 0..LANES {
                let (x, y, z, value) = (x[k], y[k], z[k], value[k]);
                let residual = value - (x * vector.x + y * vector.y + z * vector.z);
                // Only ratios of weights matter, so that noise / ... keeps them near 1.
                let weight = if noise.is_finite() {
                    noise * l1_weight(residual, noise)
                } else {
                    1.0
                };
                let (wx, wy, wz) = (weight * x, weight * y, weight * z);
                let products = [wx * x, wx * y, wx * z, wy * y, wy * z, wz * z];
                for (sum, product) in sums.iter_mut().zip(products) {
                    sum[k] += product;
                }
                sums[6][k] += wx * value;
                sums[7][k] += wy * value;
                sums[8][k] += wz * value;
            }
        }
        let sums = sums.map(|lanes| lanes.iter().map(|&lane| f64::from(lane)).sum::<f64>());
        let [xx, xy, xz, yy, yz, zz, x, y, z] = sums;
        let gram = DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
        let third = (xx + yy + zz) / 3.0;
        // What is left of the lights may lie in a plane, though all of them do not.
        let determined = gram.determinant() > 1e-6 * third.powi(3);
        let fitted = (gram.inverse() * DVec3::new(x, y, z)).as_vec3();
        (determined && fitted.is_finite()).then_some(fitted)
    }
}
