//! ReLU and depthwise convolution in one operation.
//!
//! Rows are flat, `[columns, channels]`, and the weights are repeated along them, so that vectors are full however few
//! channels there are. For stride 2 the columns of the copied rows are sorted by parity first; then neighbouring outputs
//! see neighbouring inputs again.
mod row;
mod sizes;
mod weight_sums;

pub(crate) use sizes::Depthwise;

use crate::cpu::buffer::Buffer;
use crate::cpu::convolution::PARTS;
use crate::cpu::vectors::run;
use rayon::prelude::*;
use row::Row;
use weight_sums::WeightSums;

impl Depthwise {
    /// Weights along a row: `[taps, period]`.
    ///
    /// # Shapes
    /// - weight: `[channels, size, size]`
    fn repeated(&self, weight: &[f32]) -> Buffer {
        let period = self.period();
        let mut repeated = Buffer::recycled(self.taps() * period);
        for (tap, row) in repeated.chunks_exact_mut(period).enumerate() {
            for (place, value) in row.iter_mut().enumerate() {
                *value = weight[place % self.channels * self.taps() + tap];
            }
        }
        repeated
    }

    /// An image after ReLU with zeros around it: `[rows, stride, columns, channels]`.
    fn copy(&self, image: &[f32], out: &mut [f32]) {
        let (channels, padding) = (self.channels, self.size / 2);
        out.fill(0.0);
        pulp::Arch::new().dispatch(|| {
            let lines = out.chunks_exact_mut(self.line()).skip(padding);
            for (line, row) in lines.zip(image.chunks_exact(self.width * channels)) {
                for (x, pixel) in row.chunks_exact(channels).enumerate() {
                    // Beyond the last tap of the last output there may be a column that nobody sees.
                    let to = self.column(x + padding);
                    if (x + padding) / self.stride >= self.columns() {
                        continue;
                    }
                    for (value, input) in line[to..to + channels].iter_mut().zip(pixel) {
                        // NaN stays.
                        *value = if *input < 0.0 { 0.0 } else { *input };
                    }
                }
            }
        });
    }

    /// # Shapes
    /// - input: `[batch, height, width, channels]`
    /// - weight: `[channels, size, size]`
    /// - output: `[batch, out_height, out_width, channels]`
    pub(crate) fn forward(&self, input: &[f32], weight: &[f32]) -> Buffer {
        let weight = self.repeated(weight);
        let mut output = Buffer::recycled(self.batch * self.image_out());
        output
            .par_chunks_exact_mut(self.image_out())
            .zip(input.par_chunks_exact(self.image_in()))
            .for_each(|(output, image)| {
                let mut patch = Buffer::recycled(self.rows() * self.line());
                self.copy(image, &mut patch);
                let outputs = output.chunks_exact_mut(self.out_width() * self.channels);
                for (y, output) in outputs.enumerate() {
                    let taps = (0..self.taps()).map(|tap| {
                        let (row, column) = (tap / self.size, tap % self.size);
                        let from = (y * self.stride + row) * self.line() + self.column(column);
                        (from, tap * self.period())
                    });
                    run(Row::new(&patch, &weight, self.period(), output, taps));
                }
            });
        output
    }

    /// Gradients of input and weight (`[channels, size, size]`; zeros when it is not asked for).
    pub(crate) fn backward(
        &self,
        input: &[f32],
        weight: &[f32],
        gradient: &[f32],
        wants_weight: bool,
    ) -> (Buffer, Buffer) {
        let repeated = self.repeated(weight);
        let part = self.batch.div_ceil(PARTS).max(1);
        let mut grad_input = Buffer::recycled(self.batch * self.image_in());
        let sums: Vec<Buffer> = grad_input
            .par_chunks_mut(part * self.image_in())
            .zip(input.par_chunks(part * self.image_in()))
            .zip(gradient.par_chunks(part * self.image_out()))
            .map(|((grad_input, input), gradient)| {
                let mut sums = Buffer::zeros(self.taps() * self.period());
                let mut patch = Buffer::recycled(self.rows() * self.line());
                let images = grad_input
                    .chunks_exact_mut(self.image_in())
                    .zip(input.chunks_exact(self.image_in()))
                    .zip(gradient.chunks_exact(self.image_out()));
                for ((grad_image, image), gradient) in images {
                    if wants_weight {
                        self.copy(image, &mut patch);
                        run(WeightSums {
                            depthwise: self,
                            patch: &patch,
                            gradient,
                            sums: &mut sums,
                        });
                    }
                    self.image_gradient(image, gradient, &repeated, grad_image);
                }
                sums
            })
            .collect();
        let mut grad_weight = Buffer::zeros(weight.len());
        for sums in sums {
            for (tap, row) in sums.chunks_exact(self.period()).enumerate() {
                for (place, value) in row.iter().enumerate() {
                    grad_weight[place % self.channels * self.taps() + tap] += value;
                }
            }
        }
        (grad_input, grad_weight)
    }

    fn image_gradient(
        &self,
        image: &[f32],
        gradient: &[f32],
        weight: &[f32],
        grad_image: &mut [f32],
    ) {
        let (channels, padding) = (self.channels, self.size / 2);
        // Zeros left and right of the gradient's rows, so that every tap finds something.
        let beside = (self.size - 1) / self.stride * channels;
        let width = self.out_width() * channels;
        let padded = width + 2 * beside;
        let mut gradients = Buffer::zeros(self.out_height() * padded);
        for (padded, row) in gradients
            .chunks_exact_mut(padded)
            .zip(gradient.chunks_exact(width))
        {
            padded[beside..beside + width].copy_from_slice(row);
        }
        let columns = self.columns() * channels;
        let mut line = Buffer::recycled(self.line());
        let rows = grad_image
            .chunks_exact_mut(self.width * channels)
            .zip(image.chunks_exact(self.width * channels));
        for (y, (grad_row, row)) in rows.enumerate() {
            let padded_row = y + padding;
            for (parity, line) in line.chunks_exact_mut(columns).enumerate() {
                let taps = (0..self.taps()).filter_map(|tap| {
                    let (row, column) = (tap / self.size, tap % self.size);
                    let above = padded_row.checked_sub(row)?;
                    let fits = above % self.stride == 0
                        && above / self.stride < self.out_height()
                        && column % self.stride == parity;
                    let from = above / self.stride * padded + beside;
                    fits.then(|| {
                        let from = from - column / self.stride * channels;
                        (from, tap * self.period())
                    })
                });
                run(Row::new(&gradients, weight, self.period(), line, taps));
            }
            pulp::Arch::new().dispatch(|| {
                let pixels = grad_row
                    .chunks_exact_mut(channels)
                    .zip(row.chunks_exact(channels));
                for (x, (grad_pixel, pixel)) in pixels.enumerate() {
                    if (x + padding) / self.stride >= self.columns() {
                        grad_pixel.fill(0.0);
                        continue;
                    }
                    let from = self.column(x + padding);
                    let line = &line[from..from + channels];
                    for ((value, found), input) in grad_pixel.iter_mut().zip(line).zip(pixel) {
                        *value = if *input > 0.0 { *found } else { 0.0 };
                    }
                }
            });
        }
    }
}
