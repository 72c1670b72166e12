//! Whether pictures are shaded as one surface is.
use super::view::Picture;

/// Dimensions in which the shading of a matte surface lies (fewer where few pictures would be
/// explained by as many whatever they show), and rounds of the iteration.
const DIMENSIONS: usize = 3;
const ROUNDS: usize = 60;

/// The part of the pictures' light that the three directions in which they extend most do not
/// explain, 0 to 1: what lies over each other pixel by pixel and is shaded by three numbers a pixel
/// (Shashua 1997) leaves little, edges that lie beside each other leave more.
///
/// It tells a camera that moved from light that moved: a shadow's border on a smooth ball wanders as
/// the ball would, but laid over each other such pictures are explained worse. Each picture counts
/// equally, its brightest hundredth as the rest.
pub(super) fn unexplained(pictures: &[Picture]) -> f32 {
    let columns: Vec<Vec<f32>> = pictures.iter().filter_map(normalised).collect();
    let count = columns.len();
    let mut products = vec![vec![0.0f64; count]; count];
    for a in 0..count {
        for b in 0..=a {
            let pairs = columns[a].iter().zip(&columns[b]);
            let product = f64::from(pairs.map(|(a, b)| a * b).sum::<f32>());
            (products[a][b], products[b][a]) = (product, product);
        }
    }
    let trace: f64 = (0..count).map(|at| products[at][at]).sum();
    if count < 2 || trace <= 0.0 {
        return 0.0;
    }
    let dimensions = ((count - 1) / 2).clamp(1, DIMENSIONS);
    (1.0 - largest(&products, dimensions) / trace).max(0.0) as f32
}

/// Unit energy; `None` of a black picture.
fn normalised(picture: &Picture) -> Option<Vec<f32>> {
    let bright = super::edges::bright_value(&picture.light);
    let light: Vec<f32> = picture
        .light
        .iter()
        .map(|light| light.min(bright))
        .collect();
    let energy: f32 = light.iter().map(|light| light * light).sum();
    (energy > 0.0).then(|| light.iter().map(|light| light / energy.sqrt()).collect())
}

/// Sum of the largest eigenvalues of a symmetric matrix without negative ones, by orthogonal
/// iteration (Golub and Van Loan, 7.3).
fn largest(matrix: &[Vec<f64>], dimensions: usize) -> f64 {
    let size = matrix.len();
    // Any start that no eigenvector is likely to be orthogonal to.
    let start = |axis: usize| (0..size).map(move |at| 1.0 + ((at * (axis + 2)) % 5) as f64 * 0.3);
    let mut axes: Vec<Vec<f64>> = (0..dimensions).map(|axis| start(axis).collect()).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut sum = 0.0;
    for _ in 0..ROUNDS {
        for axis in &mut axes {
            *axis = matrix.iter().map(|row| dot(row, axis)).collect();
        }
        for at in 0..axes.len() {
            let (before, rest) = axes.split_at_mut(at);
            let axis = &mut rest[0];
            for other in before {
                let along = dot(axis, other);
                axis.iter_mut()
                    .zip(&*other)
                    .for_each(|(value, other)| *value -= along * other);
            }
            let length = dot(axis, axis).sqrt().max(1e-12);
            axis.iter_mut().for_each(|value| *value /= length);
        }
        sum = axes
            .iter()
            .map(|axis| {
                matrix
                    .iter()
                    .zip(axis)
                    .map(|(row, at)| at * dot(row, axis))
                    .sum::<f64>()
            })
            .sum();
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_three_of_known_eigenvalues() {
        let mut matrix = vec![vec![0.0; 5]; 5];
        for (at, value) in [7.0, 1.0, 0.5, 4.0, 2.0].into_iter().enumerate() {
            matrix[at][at] = value;
        }
        assert!((largest(&matrix, 3) - 13.0).abs() < 1e-6);
    }

    #[test]
    fn three_numbers_a_pixel_explain_a_matte_plane_but_no_moved_one() {
        let shot = |index: usize, shift: usize| Picture {
            width: 40,
            height: 1,
            light: (0..40)
                .map(|x| {
                    let normal = |k: usize| 1.0 + ((x + shift) * (k + 3) % 11) as f32 / 11.0;
                    (0..3)
                        .map(|k| normal(k) * ((index + 2 * k) % 5 + 1) as f32)
                        .sum()
                })
                .collect(),
        };
        let still: Vec<Picture> = (0..8).map(|k| shot(k, 0)).collect();
        let moved: Vec<Picture> = (0..8).map(|k| shot(k, k % 3)).collect();
        let (still, moved) = (unexplained(&still), unexplained(&moved));
        // One pixel in a hundred is cut, which is one here.
        assert!(still < 1e-3 && moved > 10.0 * still, "{still} {moved}");
    }
}
