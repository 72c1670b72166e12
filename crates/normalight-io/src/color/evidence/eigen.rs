//! The directions in which rows extend most.

/// The three directions in which rows extend most.
pub(super) fn principal(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let size = rows[0].len();
    let mut products = vec![vec![0.0; size]; size];
    for row in rows {
        for (a, line) in products.iter_mut().enumerate() {
            for (b, sum) in line.iter_mut().enumerate() {
                *sum += row[a] * row[b];
            }
        }
    }
    let mut pairs = eigenpairs(products);
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs.into_iter().take(3).map(|(_, axis)| axis).collect()
}

/// Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations (Golub and Van Loan,
/// 8.5).
fn eigenpairs(mut m: Vec<Vec<f64>>) -> Vec<(f64, Vec<f64>)> {
    let size = m.len();
    // Row k is the k-th vector.
    let mut vectors: Vec<Vec<f64>> = (0..size)
        .map(|k| (0..size).map(|j| f64::from(u8::from(j == k))).collect())
        .collect();
    for _ in 0..30 {
        let mut off = 0.0;
        for p in 0..size {
            for q in p + 1..size {
                if m[p][q] == 0.0 {
                    continue;
                }
                off += m[p][q] * m[p][q];
                let ratio = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                let t = match ratio == 0.0 {
                    true => 1.0,
                    false => ratio.signum() / (ratio.abs() + (ratio * ratio + 1.0).sqrt()),
                };
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for row in &mut m {
                    (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
                }
                for rows in [&mut m, &mut vectors] {
                    let (upper, lower) = rows.split_at_mut(q);
                    for (a, b) in upper[p].iter_mut().zip(&mut lower[0]) {
                        (*a, *b) = (c * *a - s * *b, s * *a + c * *b);
                    }
                }
            }
        }
        let trace: f64 = (0..size).map(|k| m[k][k]).sum();
        if off <= 1e-22 * trace * trace {
            break;
        }
    }
    let values: Vec<f64> = (0..size).map(|k| m[k][k]).collect();
    values.into_iter().zip(vectors).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenpairs_of_a_known_matrix() {
        let m = vec![
            vec![2.0, 1.0, 0.0],
            vec![1.0, 2.0, 0.0],
            vec![0.0, 0.0, 5.0],
        ];
        let mut pairs = eigenpairs(m.clone());
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for ((found, vector), expected) in pairs.iter().zip([1.0, 3.0, 5.0]) {
            assert!((found - expected).abs() < 1e-10);
            for (row, value) in m.iter().zip(vector) {
                let product: f64 = row.iter().zip(vector).map(|(a, b)| a * b).sum();
                assert!((product - expected * value).abs() < 1e-10);
            }
        }
    }
}
