//! Three dimensions through rows with gaps.
use super::eigen::principal;
use glam::{DMat3, DVec3};

/// Alternations; later ones change nothing that counts.
const STEPS: usize = 10;
/// Keeps rows of few samples solvable; samples are about 1.
const RIDGE: f64 = 1e-6;

/// The squares that three dimensions leave, as shares of the squares around each row's mean.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beside {
    /// Of all rows together.
    pub(super) sum: f64,
    /// Of the median row.
    pub(super) median: f64,
}

/// Fits rows of equal length by alternating least squares: axes for the columns, three numbers for
/// each row, of the samples that are there. `None` where rows do not vary.
pub(super) fn beside_three(rows: &[Vec<Option<f64>>]) -> Option<Beside> {
    let rows: Vec<Vec<Option<f64>>> = rows.iter().map(|row| scaled(row)).collect();
    let filled: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| row.iter().map(|value| value.unwrap_or(1.0)).collect())
        .collect();
    let first = principal(&filled);
    let mut axes: Vec<DVec3> = (0..filled.first()?.len())
        .map(|column| DVec3::from_array([0, 1, 2].map(|k| first[k][column])))
        .collect();
    for _ in 0..STEPS {
        let numbers: Vec<DVec3> = rows.iter().map(|row| solved(row, &axes)).collect();
        for (column, axis) in axes.iter_mut().enumerate() {
            let values: Vec<Option<f64>> = rows.iter().map(|row| row[column]).collect();
            *axis = solved(&values, &numbers);
        }
        orthonormalise(&mut axes);
    }
    let mut shares = Vec::with_capacity(rows.len());
    let (mut left, mut all) = (0.0, 0.0);
    for row in &rows {
        let numbers = solved(row, &axes);
        let seen = || {
            row.iter()
                .zip(&axes)
                .filter_map(|(v, axis)| Some(((*v)?, axis)))
        };
        let count = seen().count() as f64;
        let mean = seen().map(|(value, _)| value).sum::<f64>() / count;
        let beside: f64 = seen()
            .map(|(v, axis)| (v - numbers.dot(*axis)).powi(2))
            .sum();
        let around: f64 = seen().map(|(v, _)| (v - mean).powi(2)).sum();
        left += beside;
        all += around;
        if around > 0.0 {
            shares.push(beside / around);
        }
    }
    shares.sort_by(f64::total_cmp);
    let median = *shares.get(shares.len() / 2)?;
    Some(Beside {
        sum: left / all,
        median,
    })
}

/// A row of mean 1.
fn scaled(row: &[Option<f64>]) -> Vec<Option<f64>> {
    let seen = row.iter().flatten();
    let mean = seen.clone().sum::<f64>() / seen.count().max(1) as f64;
    row.iter()
        .map(|value| value.map(|value| value / mean))
        .collect()
}

/// Three numbers whose products with the vectors are nearest to the values that are there.
fn solved(values: &[Option<f64>], vectors: &[DVec3]) -> DVec3 {
    let mut products = DMat3::from_diagonal(DVec3::splat(RIDGE));
    let mut sums = DVec3::ZERO;
    for (value, vector) in values.iter().zip(vectors) {
        if let Some(value) = value {
            let [x, y, z] = vector.to_array();
            products += DMat3::from_cols(*vector * x, *vector * y, *vector * z);
            sums += *value * *vector;
        }
    }
    products.inverse() * sums
}

/// Makes the three columns of the axes unit vectors at right angles (Gram and Schmidt).
fn orthonormalise(axes: &mut [DVec3]) {
    for k in 0..3 {
        for before in 0..k {
            let along: f64 = axes.iter().map(|axis| axis[k] * axis[before]).sum();
            for axis in axes.iter_mut() {
                axis[k] -= along * axis[before];
            }
        }
        let length = axes
            .iter()
            .map(|axis| axis[k] * axis[k])
            .sum::<f64>()
            .sqrt();
        for axis in axes.iter_mut() {
            axis[k] /= length.max(f64::MIN_POSITIVE);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::beside_three;

    /// Rows of three numbers times fixed columns, `more` of a fourth, with every seventh sample missing.
    fn rows(more: f64) -> Vec<Vec<Option<f64>>> {
        let value = |row: usize, column: usize| {
            let angle = column as f64 * 0.7;
            let [a, b] = [row as f64 * 0.37, row as f64 * 0.61].map(f64::sin);
            1.0 + 0.3 * a * angle.cos() + 0.3 * b * angle.sin() + more * (3.0 * angle + a).cos()
        };
        let row = |row: usize| -> Vec<Option<f64>> {
            (0..12)
                .map(|column| (!(5 * row + column).is_multiple_of(7)).then(|| value(row, column)))
                .collect()
        };
        (0..200).map(row).collect()
    }

    #[test]
    fn three_dimensions_leave_nothing() {
        let three = beside_three(&rows(0.0)).unwrap();
        assert!(three.sum < 1e-9 && three.median < 1e-9, "{three:?}");
        let more = beside_three(&rows(0.1)).unwrap();
        assert!(more.sum > 1e-3 && more.median > 1e-3, "{more:?}");
    }
}
