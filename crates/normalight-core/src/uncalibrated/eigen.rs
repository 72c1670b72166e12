//! Eigenvectors of symmetric matrices.

/// Eigenvalues, the largest first, and their eigenvectors, by Jacobi's rotations (Golub and Van Loan, "Matrix
/// Computations", 8.5): of a few rows.
pub(crate) fn eigenpairs(mut m: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let size = m.len();
    let mut vectors: Vec<Vec<f64>> = (0..size).map(|k| unit(size, k)).collect();
    // Converges quadratically: ten rounds are many.
    for _ in 0..50 {
        let trace: f64 = (0..size).map(|k| m[k][k].abs()).sum();
        let mut rotated = false;
        for p in 0..size {
            for q in p + 1..size {
                if m[p][q].abs() <= 1e-17 * trace || !m[p][q].is_finite() {
                    continue;
                }
                rotated = true;
                let ratio = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                let tangent = 1f64.copysign(ratio) / (ratio.abs() + ratio.hypot(1.0));
                let cosine = 1.0 / tangent.hypot(1.0);
                let sine = tangent * cosine;
                let turn = |a: &mut f64, b: &mut f64| {
                    (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
                };
                for row in &mut m {
                    let (left, right) = row.split_at_mut(q);
                    turn(&mut left[p], &mut right[0]);
                }
                for rows in [&mut m, &mut vectors] {
                    let (upper, lower) = rows.split_at_mut(q);
                    for (a, b) in upper[p].iter_mut().zip(&mut lower[0]) {
                        turn(a, b);
                    }
                }
            }
        }
        if !rotated {
            break;
        }
    }
    let values = (0..size).map(|k| m[k][k]);
    let mut pairs: Vec<(f64, Vec<f64>)> = values.zip(vectors).collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

/// The `count` largest eigenvalues and their vectors of a matrix without negative ones, by orthogonal iteration with
/// Ritz vectors (Golub and Van Loan, 8.2): of many rows.
pub(super) fn leading(m: &[Vec<f64>], count: usize) -> Vec<(f64, Vec<f64>)> {
    let size = m.len();
    // Some more than asked converge faster, as those beyond decide the rate.
    let width = (2 * count).min(size);
    // Any start that no eigenvector is likely to be orthogonal to.
    let mut basis: Vec<Vec<f64>> = (0..width)
        .map(|k| {
            (0..size)
                .map(|j| (1.0 + (j * (2 * k + 1)) as f64).sin())
                .collect()
        })
        .collect();
    let mut pairs: Vec<(f64, Vec<f64>)> = Vec::new();
    for _ in 0..200 {
        orthonormalise(&mut basis);
        let images: Vec<Vec<f64>> = basis
            .iter()
            .map(|vector| m.iter().map(|row| dot(row, vector)).collect())
            .collect();
        let small = basis
            .iter()
            .map(|a| images.iter().map(|b| dot(a, b)).collect())
            .collect();
        let before: Vec<f64> = pairs.iter().map(|(value, _)| *value).collect();
        let ritz = eigenpairs(small);
        let combined = |rows: &[Vec<f64>], shares: &[f64]| -> Vec<f64> {
            (0..size)
                .map(|j| {
                    rows.iter()
                        .zip(shares)
                        .map(|(row, share)| row[j] * share)
                        .sum()
                })
                .collect()
        };
        pairs = ritz
            .iter()
            .map(|(value, shares)| (*value, combined(&basis, shares)))
            .collect();
        basis = ritz
            .iter()
            .map(|(_, shares)| combined(&images, shares))
            .collect();
        let largest = pairs[0].0.abs();
        let still = |(a, b): (&f64, &(f64, Vec<f64>))| (a - b.0).abs() <= 1e-15 * largest;
        if !before.is_empty() && before.iter().zip(&pairs).take(count).all(still) {
            break;
        }
    }
    pairs.truncate(count);
    pairs
}

/// Gram and Schmidt, twice for accuracy; vectors that depend on those before become unit vectors.
fn orthonormalise(basis: &mut [Vec<f64>]) {
    for k in 0..basis.len() {
        let (before, rest) = basis.split_at_mut(k);
        let vector = &mut rest[0];
        for attempt in 0..=before.len() + 1 {
            let start = dot(vector, vector).sqrt();
            for _ in 0..2 {
                for other in &*before {
                    let share = dot(vector, other);
                    for (value, other) in vector.iter_mut().zip(other) {
                        *value -= share * other;
                    }
                }
            }
            let length = dot(vector, vector).sqrt();
            if length > 1e-12 * start && length > 0.0 {
                for value in vector.iter_mut() {
                    *value /= length;
                }
                break;
            }
            *vector = unit(vector.len(), attempt % vector.len());
        }
    }
}

fn unit(size: usize, place: usize) -> Vec<f64> {
    (0..size).map(|j| f64::from(u8::from(j == place))).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A symmetric matrix with the eigenvalues 1, 1/4, 1/9, ...: `H D H` with a Householder reflection `H`.
    fn known(size: usize) -> Vec<Vec<f64>> {
        let axis: Vec<f64> = (0..size).map(|k| 1.0 + (k % 3) as f64).collect();
        let square = dot(&axis, &axis);
        let h = |i: usize, j: usize| f64::from(u8::from(i == j)) - 2.0 * axis[i] * axis[j] / square;
        let value = |k: usize| 1.0 / ((k + 1) as f64).powi(2);
        (0..size)
            .map(|i| {
                (0..size)
                    .map(|j| (0..size).map(|k| h(i, k) * value(k) * h(j, k)).sum())
                    .collect()
            })
            .collect()
    }

    #[test]
    fn eigenvectors_of_known_matrices() {
        for (size, count) in [(2, 2), (6, 6), (3, 3), (40, 4), (5, 4)] {
            let m = known(size);
            let found = match count == size {
                true => eigenpairs(m.clone()),
                false => leading(&m, count),
            };
            assert_eq!(found.len(), count);
            for (k, (value, vector)) in found.iter().enumerate() {
                assert!((value - 1.0 / ((k + 1) as f64).powi(2)).abs() < 1e-12);
                assert!((dot(vector, vector) - 1.0).abs() < 1e-12);
                for (row, entry) in m.iter().zip(vector) {
                    assert!(
                        (dot(row, vector) - value * entry).abs() < 1e-6,
                        "{size} {k}"
                    );
                }
            }
        }
    }

    #[test]
    fn matrices_of_low_rank_end() {
        let m = vec![vec![1.0; 7]; 7];
        let found = leading(&m, 4);
        assert!((found[0].0 - 7.0).abs() < 1e-12 && found[1].0.abs() < 1e-12);
        assert!(leading(&vec![vec![0.0; 5]; 5], 4)[0].0.abs() < 1e-12);
    }
}
