//! Newton-Schulz iterations on our own matrix product.
use crate::cpu::product::{Finish, Left, Product, Right};
use crate::operations::NEWTON_SCHULZ;
use rayon::prelude::*;

/// Rows of the output that one thread computes at a time: whole register tiles.
const BLOCK: usize = 16;

/// Replaces a matrix of `[rows, columns]`, `rows <= columns`, whose singular values are at most 1 by a nearly orthogonal
/// one with the same singular vectors.
pub(crate) fn orthogonalise(matrix: &mut Vec<f32>, [rows, columns]: [usize; 2], steps: usize) {
    let [a, b, c] = NEWTON_SCHULZ;
    let mut transposed = vec![0.0; rows * columns];
    let [mut square, mut fourth] = [0; 2].map(|_| vec![0.0; rows * rows]);
    let mut next = vec![0.0; rows * columns];
    for _ in 0..steps {
        transpose(matrix, [rows, columns], &mut transposed);
        symmetric_product(matrix, &transposed, [rows, columns], &mut square);
        // The transpose of a symmetric matrix is the matrix.
        symmetric_product(&square, &square, [rows, rows], &mut fourth);
        for (fourth, square) in fourth.iter_mut().zip(&square) {
            *fourth = b * square + c * *fourth;
        }
        next.par_chunks_mut(BLOCK * columns)
            .zip(fourth.par_chunks(BLOCK * rows))
            .zip(matrix.par_chunks(BLOCK * columns))
            .for_each(|((next, factors), before)| {
                for (next, before) in next.iter_mut().zip(before) {
                    *next = a * before;
                }
                Product {
                    size: [factors.len() / rows, columns],
                    counts: [1, rows],
                    left: Left::rows(factors, rows),
                    right: Right::rows(matrix, columns),
                    output: next,
                    output_row: columns,
                    finish: Finish::Added,
                }
                .compute();
            });
        std::mem::swap(matrix, &mut next);
    }
}

/// `left` of `[rows, inner]` times its transpose.
fn symmetric_product(
    left: &[f32],
    transposed: &[f32],
    [rows, inner]: [usize; 2],
    output: &mut [f32],
) {
    output
        .par_chunks_mut(BLOCK * rows)
        .enumerate()
        .for_each(|(block, output)| {
            // What lies left of the diagonal's block is copied from its mirror image below.
            let first = block * BLOCK;
            Product {
                size: [output.len() / rows, rows - first],
                counts: [1, inner],
                left: Left::rows(&left[first * inner..], inner),
                right: Right::rows(&transposed[first..], rows),
                output: &mut output[first..],
                output_row: rows,
                finish: Finish::Stored,
            }
            .compute();
        });
    for row in BLOCK..rows {
        for column in 0..row / BLOCK * BLOCK {
            output[row * rows + column] = output[column * rows + row];
        }
    }
}

fn transpose(from: &[f32], [rows, columns]: [usize; 2], to: &mut [f32]) {
    for (row, values) in from.chunks_exact(columns).enumerate() {
        for (column, value) in values.iter().enumerate() {
            to[column * rows + row] = *value;
        }
    }
}
