use super::DepthMap;
use super::map::centred;
use crate::{NormalMap, Vec3};

/// Terms of a polynomial of second degree: 1, x, y, x^2, x y, y^2.
const TERMS: usize = 6;

/// The bow of a nearly flat object: the paraboloid that fits its heights best. Errors of lights and
/// normals that change slowly over the image add up to one; RTI calls its removal flattening.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bow {
    coefficients: [f64; TERMS],
    /// Length that coordinates are divided by.
    unit: f64,
}

impl Bow {
    /// The least-squares paraboloid of a depth map over its mask.
    pub fn of(depth: &DepthMap) -> Self {
        let (width, height) = (depth.width(), depth.height());
        let unit = width.max(height) as f64 / 2.0;
        let mut matrix = [[0.0f64; TERMS]; TERMS];
        let mut rhs = [0.0f64; TERMS];
        for pixel in depth.mask().pixels() {
            let terms = terms(centred(pixel, width, height).map(|at| f64::from(at) / unit));
            for row in 0..TERMS {
                for column in 0..TERMS {
                    matrix[row][column] += terms[row] * terms[column];
                }
                rhs[row] += terms[row] * f64::from(depth.heights()[pixel]);
            }
        }
        Self {
            coefficients: solved(matrix, rhs),
            unit,
        }
    }

    /// The heights without the bow.
    pub fn removed_from_depth(&self, depth: &DepthMap) -> DepthMap {
        let (width, height) = (depth.width(), depth.height());
        let heights = depth.heights().iter().enumerate().map(|(pixel, &value)| {
            let terms = terms(centred(pixel, width, height).map(|at| f64::from(at) / self.unit));
            let bow: f64 = terms
                .iter()
                .zip(self.coefficients)
                .map(|(t, c)| t * c)
                .sum();
            (f64::from(value) - bow) as f32
        });
        depth.clone().with_heights(heights.collect())
    }

    /// The normals without the bow: its slopes are taken off theirs. Those that do not face the camera stay.
    pub fn removed_from_normals(&self, normals: &NormalMap) -> NormalMap {
        let (width, height) = (normals.width(), normals.height());
        let [_, x1, y1, xx, xy, yy] = self.coefficients;
        let flat = normals
            .normals()
            .iter()
            .enumerate()
            .map(|(pixel, &normal)| {
                if normal.z <= 0.0 {
                    return normal;
                }
                let [x, y] = centred(pixel, width, height).map(|at| f64::from(at) / self.unit);
                let slopes = [x1 + 2.0 * xx * x + xy * y, y1 + xy * x + 2.0 * yy * y];
                let [right, up] = slopes.map(|slope| (slope / self.unit) as f32);
                normal + Vec3::new(right, up, 0.0) * normal.z
            });
        NormalMap::new(width, height, flat.collect())
    }
}

fn terms([x, y]: [f64; 2]) -> [f64; TERMS] {
    [1.0, x, y, x * x, x * y, y * y]
}

/// Gaussian elimination of a positive matrix; unknowns about which it says nothing are zero.
fn solved(mut matrix: [[f64; TERMS]; TERMS], mut rhs: [f64; TERMS]) -> [f64; TERMS] {
    let least = 1e-12 * (0..TERMS).map(|k| matrix[k][k]).fold(0.0, f64::max);
    for pivot in 0..TERMS {
        if matrix[pivot][pivot] <= least {
            continue;
        }
        for row in pivot + 1..TERMS {
            let factor = matrix[row][pivot] / matrix[pivot][pivot];
            let above = matrix[pivot];
            for (value, above) in matrix[row].iter_mut().zip(above).skip(pivot) {
                *value -= factor * above;
            }
            rhs[row] -= factor * rhs[pivot];
        }
    }
    let mut solution = [0.0; TERMS];
    for row in (0..TERMS).rev() {
        if matrix[row][row] > least {
            let known: f64 = (row + 1..TERMS)
                .map(|column| matrix[row][column] * solution[column])
                .sum();
            solution[row] = (rhs[row] - known) / matrix[row][row];
        }
    }
    solution
}
