//! Convolutions with bias and leaky ReLU: the fastest way for each, on all cores.
use crate::cpu::buffer::Buffer;
use crate::cpu::geometry::{Filter, Geometry, Part, PartGradients};
use crate::cpu::window::add;
use crate::cpu::{direct, winograd};
use rayon::prelude::*;

/// Parts that a batch's gradients are summed in: fixed, so that the sum does not depend on the
/// number of threads.
pub(crate) const PARTS: usize = 8;

/// # Shapes
/// - input: `[batch, height, width, channels_in]`
/// - weight: `[channels_out, channels_in, size, size]`
/// - bias: `[channels_out]`
/// - output: `[batch, out_height, out_width, channels_out]`
pub(crate) fn forward(
    geometry: &Geometry,
    input: &[f32],
    weight: &[f32],
    bias: &[f32],
    slope: f32,
) -> Buffer {
    let geometry = &geometry.joined(PARTS);
    let weight = channels_out_last(geometry, weight);
    let mut output = Buffer::recycled(geometry.batch * geometry.image_out());
    if winograd::suits(geometry) {
        let points = winograd::transform_weights(&weight);
        let grid = winograd::TileRows::new(geometry);
        let rows = geometry.batch * grid.per_image;
        let floats = |row: usize| {
            let rows =
                row / grid.per_image * geometry.height() + grid.out_rows(geometry, row).start;
            rows * geometry.width() * geometry.channels_out
        };
        let mut blocks = Vec::new();
        let mut rest: &mut [f32] = &mut output;
        for first in (0..rows).step_by(grid.block) {
            let end = rows.min(first + grid.block);
            let (block, later) = rest.split_at_mut(floats(end) - floats(first));
            blocks.push((first..end, block));
            rest = later;
        }
        let filter = Filter {
            weight: &points,
            bias,
            slope,
        };
        blocks.into_par_iter().for_each(|(rows, output)| {
            winograd::forward(geometry, rows, input, &filter, output);
        });
        return output;
    }
    let line = geometry.out_width() * geometry.channels_out;
    let rows = direct::block(geometry).min(geometry.out_height());
    let filter = Filter {
        weight: &weight,
        bias,
        slope,
    };
    output
        .par_chunks_exact_mut(geometry.image_out())
        .zip(input.par_chunks_exact(geometry.image_in()))
        .for_each(|(output, image)| {
            let blocks = output.par_chunks_mut(rows * line).enumerate();
            blocks.for_each(|(block, output)| {
                let first = block * rows;
                let rows = first..first + output.len() / line;
                direct::forward(geometry, rows, image, &filter, output);
            });
        });
    output
}

/// The gradients of a convolution.
pub(crate) struct Gradients {
    /// As the input, when asked for.
    pub(crate) input: Option<Buffer>,
    /// `[channels_out, channels_in, size, size]`, when asked for.
    pub(crate) weight: Option<Buffer>,
    /// `[channels_out]`.
    pub(crate) bias: Buffer,
}

/// What a convolution's gradients are computed from.
pub(crate) struct Backward<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) input: &'a [f32],
    pub(crate) weight: &'a [f32],
    /// The activation's sign is that of its output.
    pub(crate) output: &'a [f32],
    pub(crate) gradient: &'a [f32],
    pub(crate) slope: f32,
    pub(crate) wants_input: bool,
    pub(crate) wants_weight: bool,
    pub(crate) wants_bias: bool,
}

impl Backward<'_> {
    pub(crate) fn gradients(&self) -> Gradients {
        let geometry = &self.geometry.joined(PARTS);
        let by_winograd = winograd::suits(geometry);
        let transposed = if by_winograd {
            winograd::transform_weights(&taps_first(geometry, self.weight))
        } else {
            channels_in_last(geometry, self.weight)
        };
        let weights = if self.wants_weight {
            transposed.len()
        } else {
            0
        };
        let (size_in, size_out) = (geometry.image_in(), geometry.image_out());
        let part = geometry.batch.div_ceil(PARTS).max(1);
        let parts = geometry.batch.div_ceil(part);
        let mut grad_input = self
            .wants_input
            .then(|| Buffer::recycled(geometry.batch * size_in));
        // Without gradients of the input, as many empty parts.
        let grad_inputs: Vec<&mut [f32]> = match &mut grad_input {
            Some(values) => values.chunks_mut(part * size_in).collect(),
            None => (0..parts).map(|_| Default::default()).collect(),
        };
        let sums: Vec<(Buffer, Buffer)> = grad_inputs
            .into_par_iter()
            .zip(self.input.par_chunks(part * size_in))
            .zip(self.output.par_chunks(part * size_out))
            .zip(self.gradient.par_chunks(part * size_out))
            .map(|(((grad_input, input), output), gradient)| {
                let mut grad_weight = Buffer::zeros(weights);
                let mut grad_bias = Buffer::zeros(geometry.channels_out);
                let part = Part {
                    geometry,
                    input,
                    transposed: &transposed,
                    output,
                    gradient,
                    slope: self.slope,
                    wants_bias: self.wants_bias,
                };
                let mut gradients = PartGradients {
                    weight: &mut grad_weight,
                    bias: &mut grad_bias,
                    input: grad_input,
                };
                if by_winograd {
                    winograd::add_gradients(&part, &mut gradients);
                } else {
                    direct::add_gradients(&part, &mut gradients);
                }
                (grad_weight, grad_bias)
            })
            .collect();
        let (mut grad_weight, grad_bias) = sum_parts(sums);
        if by_winograd && self.wants_weight {
            grad_weight = winograd::transform_weight_gradients(&grad_weight);
        }
        let weight = self.wants_weight;
        Gradients {
            input: grad_input,
            weight: weight.then(|| channels_first(geometry, &grad_weight)),
            bias: grad_bias,
        }
    }
}

/// Sums of the parts' gradients of weight and bias, always in the same order.
pub(crate) fn sum_parts(parts: Vec<(Buffer, Buffer)>) -> (Buffer, Buffer) {
    let mut parts = parts.into_iter();
    let (mut weight, mut bias) = parts
        .next()
        .unwrap_or_else(|| (Buffer::zeros(0), Buffer::zeros(0)));
    pulp::Arch::new().dispatch(|| {
        for (part_of_weight, part_of_bias) in parts {
            add(&mut weight, &part_of_weight);
            add(&mut bias, &part_of_bias);
        }
    });
    (weight, bias)
}

/// `[size, size, channels_in, channels_out]`.
pub(crate) fn channels_out_last(geometry: &Geometry, weight: &[f32]) -> Buffer {
    let mut out = Buffer::recycled(weight.len());
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    for_each_weight(geometry, |first, tap, channel_in, channel_out| {
        out[(tap * channels_in + channel_in) * channels_out + channel_out] = weight[first];
    });
    out
}

/// `[channels_out, size, size, channels_in]`.
pub(crate) fn channels_in_last(geometry: &Geometry, weight: &[f32]) -> Buffer {
    let mut out = Buffer::recycled(weight.len());
    let (taps, channels_in) = (geometry.size * geometry.size, geometry.channels_in);
    for_each_weight(geometry, |first, tap, channel_in, channel_out| {
        out[(channel_out * taps + tap) * channels_in + channel_in] = weight[first];
    });
    out
}

/// `[size, size, channels_out, channels_in]`.
fn taps_first(geometry: &Geometry, weight: &[f32]) -> Buffer {
    let mut out = Buffer::recycled(weight.len());
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    for_each_weight(geometry, |first, tap, channel_in, channel_out| {
        out[(tap * channels_out + channel_out) * channels_in + channel_in] = weight[first];
    });
    out
}

/// `[channels_out, channels_in, size, size]` from `[size, size, channels_in, channels_out]`.
pub(crate) fn channels_first(geometry: &Geometry, weight: &[f32]) -> Buffer {
    let mut out = Buffer::recycled(weight.len());
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    for_each_weight(geometry, |first, tap, channel_in, channel_out| {
        out[first] = weight[(tap * channels_in + channel_in) * channels_out + channel_out];
    });
    out
}

/// Visits the weights in the order `[channels_out, channels_in, size, size]`.
fn for_each_weight(geometry: &Geometry, mut visit: impl FnMut(usize, usize, usize, usize)) {
    let taps = geometry.size * geometry.size;
    let mut first = 0;
    for channel_out in 0..geometry.channels_out {
        for channel_in in 0..geometry.channels_in {
            for tap in 0..taps {
                visit(first, tap, channel_in, channel_out);
                first += 1;
            }
        }
    }
}
