use crate::geometry::Geometry;
use crate::matrix::{Before, View, product};
use crate::unfolded::{fold, unfold};
use burn::backend::ops::FloatTensorOps;
use burn::backend::tensor::FloatTensor;
use burn::backend::{Backend, Flex, TensorMetadata, backend_extension};
use burn::tensor::TensorData;
use rayon::prelude::*;

/// Parts that a batch's gradients are summed in: fixed, so that the sum does not depend on the
/// number of threads.
const PARTS: usize = 8;

/// The convolution of [`convolution`](crate::convolution), by backend.
#[backend_extension(Flex, Autodiff: cfg(feature = "autodiff"))]
pub(crate) trait ConvolutionOps: Backend {
    /// See [`convolution`](crate::convolution).
    fn convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        stride: usize,
        slope: f32,
    ) -> FloatTensor<Self>;
}

impl ConvolutionOps for Flex {
    fn convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        stride: usize,
        slope: f32,
    ) -> FloatTensor<Self> {
        let geometry = Geometry::new(input.shape().dims(), weight.shape().dims(), stride);
        let output = forward(
            &geometry,
            input.to_contiguous().storage(),
            weight.to_contiguous().storage(),
            bias.to_contiguous().storage(),
            slope,
        );
        let shape = [
            geometry.batch,
            geometry.channels_out,
            geometry.out_height(),
            geometry.out_width(),
        ];
        Self::float_from_data(TensorData::new(output, shape), &Default::default())
    }
}

/// Images side by side; within one, blocks of rows are unfolded and multiplied by the weights.
fn forward(
    geometry: &Geometry,
    input: &[f32],
    weight: &[f32],
    bias: &[f32],
    slope: f32,
) -> Vec<f32> {
    let (area, taps, channels) = (geometry.out_area(), geometry.taps(), geometry.channels_out);
    let mut output = vec![0.0; geometry.batch * geometry.image_out()];
    let one = |buffer: &mut Vec<f32>, (output, image): (&mut [f32], &[f32])| {
        for rows in geometry.blocks() {
            let start = rows.start * geometry.out_width();
            let columns = rows.len() * geometry.out_width();
            buffer.resize(taps * columns, 0.0);
            unfold(geometry, image, rows, buffer);
            product(
                [channels, columns, taps],
                &mut output[start..],
                area,
                Before::Overwritten,
                View::rows(weight, taps),
                View::rows(buffer, columns),
            );
        }
        for (plane, bias) in output.chunks_exact_mut(area).zip(bias) {
            for value in plane {
                let sum = *value + bias;
                *value = if sum > 0.0 { sum } else { slope * sum };
            }
        }
    };
    let images = input.par_chunks_exact(geometry.image_in());
    output
        .par_chunks_exact_mut(geometry.image_out())
        .zip(images)
        .for_each_init(Vec::new, one);
    output
}

/// The gradients of a convolution.
pub(crate) struct Gradients {
    /// `[batch, channels_in, height, width]`, when asked for.
    pub(crate) input: Option<Vec<f32>>,
    /// `[channels_out, channels_in, size, size]`.
    pub(crate) weight: Vec<f32>,
    /// `[channels_out]`.
    pub(crate) bias: Vec<f32>,
}

/// Gradients from the output and its gradient: the activation's sign is that of its output.
pub(crate) fn backward(
    geometry: &Geometry,
    input: &[f32],
    weight: &[f32],
    output: &[f32],
    gradient: &[f32],
    slope: f32,
    wants_input: bool,
) -> Gradients {
    let (size_in, size_out) = (geometry.image_in(), geometry.image_out());
    let part = geometry.batch.div_ceil(PARTS).max(1);
    let mut of_input = vec![
        0.0;
        if wants_input {
            geometry.batch * size_in
        } else {
            0
        }
    ];
    // Without gradients of the input, as many empty parts.
    let parts = geometry.batch.div_ceil(part);
    let mut input_parts: Vec<&mut [f32]> = if wants_input {
        of_input.chunks_mut(part * size_in).collect()
    } else {
        (0..parts).map(|_| Default::default()).collect()
    };
    let sums: Vec<(Vec<f32>, Vec<f32>)> = input_parts
        .par_iter_mut()
        .zip(input.par_chunks(part * size_in))
        .zip(output.par_chunks(part * size_out))
        .zip(gradient.par_chunks(part * size_out))
        .map(|(((of_input, input), output), gradient)| {
            backward_part(geometry, weight, input, output, gradient, slope, of_input)
        })
        .collect();
    let mut of_weight = vec![0.0; geometry.channels_out * geometry.taps()];
    let mut of_bias = vec![0.0; geometry.channels_out];
    for (weight, bias) in sums {
        for (sum, value) in of_weight.iter_mut().zip(weight) {
            *sum += value;
        }
        for (sum, value) in of_bias.iter_mut().zip(bias) {
            *sum += value;
        }
    }
    Gradients {
        input: wants_input.then_some(of_input),
        weight: of_weight,
        bias: of_bias,
    }
}

/// Gradients of some images: of weight and bias summed, of the input (unless empty) in place.
fn backward_part(
    geometry: &Geometry,
    weight: &[f32],
    input: &[f32],
    output: &[f32],
    gradient: &[f32],
    slope: f32,
    of_input: &mut [f32],
) -> (Vec<f32>, Vec<f32>) {
    let (area, taps, channels) = (geometry.out_area(), geometry.taps(), geometry.channels_out);
    let (size_in, size_out) = (geometry.image_in(), geometry.image_out());
    let mut of_weight = vec![0.0; channels * taps];
    let mut of_bias = vec![0.0; channels];
    let mut before = vec![0.0; size_out];
    let mut buffer = Vec::new();
    let images = input
        .chunks_exact(size_in)
        .zip(output.chunks_exact(size_out))
        .zip(gradient.chunks_exact(size_out));
    for (index, ((image, output), gradient)) in images.enumerate() {
        for ((value, gradient), output) in before.iter_mut().zip(gradient).zip(output) {
            *value = if *output > 0.0 {
                *gradient
            } else {
                slope * gradient
            };
        }
        for (sum, plane) in of_bias.iter_mut().zip(before.chunks_exact(area)) {
            *sum += plane.iter().sum::<f32>();
        }
        for rows in geometry.blocks() {
            let start = rows.start * geometry.out_width();
            let columns = rows.len() * geometry.out_width();
            buffer.resize(taps * columns, 0.0);
            unfold(geometry, image, rows.clone(), &mut buffer);
            let block = View::rows(&before[start..], area);
            product(
                [channels, taps, columns],
                &mut of_weight,
                taps,
                Before::Added,
                block,
                View::rows(&buffer, columns).transposed(),
            );
            if of_input.is_empty() {
                continue;
            }
            product(
                [taps, columns, channels],
                &mut buffer,
                columns,
                Before::Overwritten,
                View::rows(weight, taps).transposed(),
                block,
            );
            let target = &mut of_input[index * size_in..(index + 1) * size_in];
            fold(geometry, &buffer, rows, target);
        }
    }
    (of_weight, of_bias)
}
