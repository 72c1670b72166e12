//! Newton-Schulz steps against a singular value decomposition in double precision.
mod common;

use burn::tensor::{Device, Tensor, TensorData};
use common::{random, reference, values};
use normalight_kernels::orthogonalised;

const STEPS: usize = 5;

/// Wide, tall, square, narrower than a vector and no multiple of anything.
const SIZES: [[usize; 2]; 6] = [[16, 54], [64, 288], [130, 37], [48, 48], [3, 27], [1, 9]];

/// Columns of a matrix, turned in pairs until all are orthogonal (one-sided Jacobi, Hestenes 1958): they become `U S`, and
/// `right` their coordinates, `V`, of the singular value decomposition `U S V^T`.
fn decomposed(mut columns: Vec<Vec<f64>>) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let count = columns.len();
    let unit = |k: usize| (0..count).map(|j| f64::from(u8::from(j == k))).collect();
    let mut right: Vec<Vec<f64>> = (0..count).map(unit).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    loop {
        let mut largest = 0.0f64;
        for p in 0..count {
            for q in p + 1..count {
                let (pp, qq) = (dot(&columns[p], &columns[p]), dot(&columns[q], &columns[q]));
                let pq = dot(&columns[p], &columns[q]);
                let cosine = pq.abs() / (pp * qq).sqrt().max(f64::MIN_POSITIVE);
                if cosine < 1e-14 {
                    continue;
                }
                largest = largest.max(cosine);
                let zeta = (qq - pp) / (2.0 * pq);
                let tangent = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                let cos = 1.0 / tangent.hypot(1.0);
                let sin = cos * tangent;
                for both in [&mut columns, &mut right] {
                    let (before, after) = both.split_at_mut(q);
                    for (a, b) in before[p].iter_mut().zip(&mut after[0]) {
                        (*a, *b) = (cos * *a - sin * *b, sin * *a + cos * *b);
                    }
                }
            }
        }
        if largest < 1e-12 {
            return (columns, right);
        }
    }
}

/// What the steps make of a matrix of `[rows, columns]`: the polynomial of every singular value by itself. Also its
/// singular values then.
fn expected(data: &TensorData, [rows, columns]: [usize; 2]) -> (Vec<f64>, Vec<f64>) {
    let values: Vec<f64> = data.iter::<f64>().collect();
    let norm = values.iter().map(|value| value * value).sum::<f64>().sqrt();
    let column = |c: usize| (0..rows).map(|r| values[r * columns + c]).collect();
    // Of the transpose where that has fewer columns.
    let tall = rows >= columns;
    let vectors = match tall {
        true => (0..columns).map(column).collect(),
        false => values.chunks_exact(columns).map(<[f64]>::to_vec).collect(),
    };
    let (scaled, right) = decomposed(vectors);
    let mut result = vec![0.0; rows * columns];
    let mut singular = Vec::new();
    for (scaled, right) in scaled.iter().zip(&right) {
        let length = scaled.iter().map(|value| value * value).sum::<f64>().sqrt();
        let value = (0..STEPS).fold(length / norm, |x, _| {
            3.4445 * x - 4.7750 * x.powi(3) + 2.0315 * x.powi(5)
        });
        singular.push(value);
        for (i, along) in scaled.iter().enumerate() {
            for (j, across) in right.iter().enumerate() {
                let place = if tall {
                    i * columns + j
                } else {
                    j * columns + i
                };
                result[place] += value * along / length * across;
            }
        }
    }
    (result, singular)
}

#[test]
fn singular_values_move_and_vectors_stay() {
    for device in [Device::flex(), reference()] {
        for size in SIZES {
            let data = random(&size, 7);
            let input = Tensor::<2>::from_data(data.clone(), &device);
            let found = values(orthogonalised(input, STEPS));
            let (expected, singular) = expected(&data, size);
            let norm =
                |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>().sqrt();
            let off = norm(&mut found.iter().zip(&expected).map(|(a, b)| f64::from(*a) - b));
            let apart = off / norm(&mut expected.iter().copied());
            assert!(apart < 1e-3, "{size:?}: {apart} on {device:?}");
            // Random matrices have no singular value near zero but square ones.
            let low = if size[0] == size[1] { 0.0 } else { 0.6 };
            assert!(
                singular.iter().all(|value| (low..1.25).contains(value)),
                "{size:?}: {singular:?}"
            );
        }
    }
}

/// Rows of a matrix of rank one, and of nothing: no division by zero.
#[test]
fn matrices_without_full_rank_stay_finite() {
    let device = Device::flex();
    let rank_one: Vec<f32> = (0..64 * 96)
        .map(|k| ((k / 96) as f32).sin() * ((k % 96) as f32).cos())
        .collect();
    let input = Tensor::<2>::from_data(TensorData::new(rank_one.clone(), [64, 96]), &device);
    let found = values(orthogonalised(input * 1e-12, STEPS));
    let length = |values: &[f32]| values.iter().map(|v| v * v).sum::<f32>().sqrt();
    let norm = length(&rank_one);
    // One singular value, which is near 1 after the steps.
    let share: f32 = found.iter().zip(&rank_one).map(|(a, b)| a * b / norm).sum();
    assert!(
        (0.6..1.25).contains(&share) && (length(&found) - share).abs() < 1e-2,
        "{share}"
    );
    let none = values(orthogonalised(Tensor::<2>::zeros([20, 30], &device), STEPS));
    assert!(none.iter().all(|value| *value == 0.0));
}

/// The order of additions does not depend on who does them.
#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let input = Tensor::<2>::from_data(random(&[100, 300], 3), &Device::flex());
            values(orthogonalised(input, STEPS))
        })
    };
    assert_eq!(run(1), run(3));
}
