//! Newton-Schulz iterations on our own matrix product.
use crate::cpu::product::{Finish, Left, Product, Right};
use rayon::prelude::*;

/// Rows of the output that one thread computes at a time, whole register tiles; also the side of the squares that are
/// transposed together.
const BLOCK: usize = 16;

/// Products that are added up at a time: so many rows of two vectors stay in the first cache.
const DEPTH: usize = 256;

/// Replaces a matrix of `[rows, columns]`, `rows <= columns`, whose singular values are at most 1 by a nearly orthogonal
/// one with the same singular vectors, by steps of the quintic `a x + b x^3 + c x^5` on the singular values.
pub(crate) fn orthogonalise(
    matrix: &mut Vec<f32>,
    [rows, columns]: [usize; 2],
    [a, b, c]: [f32; 3],
    steps: usize,
) {
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
            let size = [output.len() / rows, rows - first];
            for start in (0..inner).step_by(DEPTH) {
                Product {
                    size,
                    counts: [1, DEPTH.min(inner - start)],
                    left: Left::rows(&left[first * inner + start..], inner),
                    right: Right::rows(&transposed[start * rows + first..], rows),
                    output: &mut output[first..],
                    output_row: rows,
                    finish: match start {
                        0 => Finish::Stored,
                        _ => Finish::Added,
                    },
                }
                .compute();
            }
        });
    for row in BLOCK..rows {
        for column in 0..row / BLOCK * BLOCK {
            output[row * rows + column] = output[column * rows + row];
        }
    }
}

/// By squares, whose lines stay in the first cache.
fn transpose(from: &[f32], [rows, columns]: [usize; 2], to: &mut [f32]) {
    for first_row in (0..rows).step_by(BLOCK) {
        for first in (0..columns).step_by(BLOCK) {
            for row in first_row..rows.min(first_row + BLOCK) {
                for column in first..columns.min(first + BLOCK) {
                    to[column * rows + row] = from[row * columns + column];
                }
            }
        }
    }
}
