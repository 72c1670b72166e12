//! Transposed convolutions: the transposes of strided ones, with bias and leaky ReLU.
use crate::cpu::buffer::Buffer;
use crate::cpu::convolution::{
    Gradients, PARTS, channels_first, channels_in_last, channels_out_last, sum_parts,
};
use crate::cpu::direct::{self, add_to_image, add_to_weight, before_activation};
use crate::cpu::geometry::{Filter, Geometry};
use rayon::prelude::*;

/// `geometry` is that of the convolution whose transpose is computed: its output is our input.
///
/// # Shapes
/// - input: `[batch, height, width, channels_in]`
/// - weight: `[channels_in, channels_out, size, size]`
/// - output: `[batch, stride * height, stride * width, channels_out]`
pub(crate) fn forward(
    geometry: &Geometry,
    input: &[f32],
    weight: &[f32],
    bias: &[f32],
    slope: f32,
) -> Buffer {
    let transposed = channels_in_last(geometry, weight);
    let mut output = Buffer::recycled(geometry.batch * geometry.image_in());
    output
        .par_chunks_exact_mut(geometry.image_in())
        .zip(input.par_chunks_exact(geometry.image_out()))
        .for_each(|(output, image)| {
            for pixel in output.chunks_exact_mut(bias.len()) {
                pixel.copy_from_slice(bias);
            }
            add_to_image(geometry, &transposed, image, output);
            for value in output {
                *value = if *value > 0.0 { *value } else { slope * *value };
            }
        });
    output
}

/// What the gradients of [`forward`] are computed from.
pub(crate) struct Backward<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) input: &'a [f32],
    pub(crate) weight: &'a [f32],
    /// The activation's sign is that of its output.
    pub(crate) output: &'a [f32],
    pub(crate) gradient: &'a [f32],
    pub(crate) slope: f32,
}

impl Backward<'_> {
    pub(crate) fn gradients(&self) -> Gradients {
        let geometry = self.geometry;
        let filter = Filter {
            weight: &channels_out_last(geometry, self.weight),
            bias: &Buffer::zeros(geometry.channels_out),
            slope: 1.0,
        };
        let (size_in, size_out) = (geometry.image_out(), geometry.image_in());
        let part = geometry.batch.div_ceil(PARTS).max(1);
        let mut grad_input = Buffer::recycled(geometry.batch * size_in);
        let sums: Vec<(Buffer, Buffer)> = grad_input
            .par_chunks_mut(part * size_in)
            .zip(self.input.par_chunks(part * size_in))
            .zip(self.output.par_chunks(part * size_out))
            .zip(self.gradient.par_chunks(part * size_out))
            .map(|(((grad_input, input), output), gradient)| {
                let mut grad_weight = Buffer::zeros(self.weight.len());
                let mut grad_bias = Buffer::zeros(geometry.channels_in);
                let mut before = Buffer::recycled(size_out);
                let images = grad_input
                    .chunks_exact_mut(size_in)
                    .zip(input.chunks_exact(size_in))
                    .zip(output.chunks_exact(size_out))
                    .zip(gradient.chunks_exact(size_out));
                for (((grad_image, image), output), gradient) in images {
                    before_activation(output, gradient, self.slope, &mut grad_bias, &mut before);
                    add_to_weight(geometry, &before, image, &mut grad_weight);
                    let rows = 0..geometry.out_height();
                    direct::forward(geometry, rows, &before, &filter, grad_image);
                }
                (grad_weight, grad_bias)
            })
            .collect();
        let (grad_weight, bias) = sum_parts(sums);
        Gradients {
            input: Some(grad_input),
            weight: Some(channels_first(geometry, &grad_weight)),
            bias,
        }
    }
}
