//! Batch normalisation of feature maps (Ioffe & Szegedy 2015): one pass over the values for the statistics, one for the
//! result, forward and backward.
use crate::cpu::buffer::Buffer;
use crate::cpu::vectors::period;
use rayon::prelude::*;

/// Floats that are worked on together: a part of the first-level cache.
const BLOCK: usize = 1 << 12;

/// Mean and variance of every channel over a batch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Moments {
    pub(crate) mean: Vec<f32>,
    /// Divided by the number of values.
    pub(crate) variance: Vec<f32>,
}

/// Values of the channels, repeated until there are `period` of them.
fn repeated(values: &[f32], period: usize) -> Vec<f32> {
    values.iter().copied().cycle().take(period).collect()
}

/// Sums over the repetitions.
fn folded(values: &[f32], channels: usize) -> Vec<f64> {
    let mut sums = vec![0.0; channels];
    for repetition in values.chunks(channels) {
        for (sum, value) in sums.iter_mut().zip(repetition) {
            *sum += f64::from(*value);
        }
    }
    sums
}

/// Floats of a block: whole repetitions.
fn block(period: usize) -> usize {
    (BLOCK / period).max(1) * period
}

/// Mean and variance of every channel.
///
/// Each block is summed by itself around its own mean and the blocks are put together in double precision (Chan et al.
/// 1983), so that neither large means nor large batches cost accuracy.
pub(crate) fn moments(input: &[f32], channels: usize) -> Moments {
    let period = period(channels);
    let parts: Vec<(f64, Vec<f64>, Vec<f64>)> = input
        .par_chunks(block(period))
        .map(|block| {
            let count = (block.len() / channels) as f64;
            let mut sums = vec![0.0f32; period];
            pulp::Arch::new().dispatch(|| {
                for chunk in block.chunks(period) {
                    for (sum, value) in sums.iter_mut().zip(chunk) {
                        *sum += value;
                    }
                }
            });
            let means: Vec<f64> = folded(&sums, channels)
                .into_iter()
                .map(|sum| sum / count)
                .collect();
            let centre: Vec<f32> = means.iter().map(|mean| *mean as f32).collect();
            let centre_repeated = repeated(&centre, period);
            sums.fill(0.0);
            pulp::Arch::new().dispatch(|| {
                for chunk in block.chunks(period) {
                    for ((sum, value), centre) in sums.iter_mut().zip(chunk).zip(&centre_repeated) {
                        let difference = value - centre;
                        *sum += difference * difference;
                    }
                }
            });
            (count, means, folded(&sums, channels))
        })
        .collect();
    let (mut count, mut mean, mut squares) = (0.0, vec![0.0; channels], vec![0.0; channels]);
    for (part_count, part_mean, part_squares) in parts {
        let total = count + part_count;
        for k in 0..channels {
            let difference = part_mean[k] - mean[k];
            squares[k] += part_squares[k] + difference * difference * count * part_count / total;
            mean[k] += difference * part_count / total;
        }
        count = total;
    }
    Moments {
        mean: mean.into_iter().map(|mean| mean as f32).collect(),
        variance: squares
            .into_iter()
            .map(|square| (square / count) as f32)
            .collect(),
    }
}

/// `input * scale + shift`, channel by channel.
pub(crate) fn scaled(input: &[f32], scale: &[f32], shift: &[f32]) -> Buffer {
    let period = period(scale.len());
    let (scale, shift) = (repeated(scale, period), repeated(shift, period));
    let mut output = Buffer::recycled(input.len());
    let block = block(period);
    output
        .par_chunks_mut(block)
        .zip(input.par_chunks(block))
        .for_each(|(output, input)| {
            pulp::Arch::new().dispatch(|| {
                for (output, input) in output.chunks_mut(period).zip(input.chunks(period)) {
                    let factors = scale.iter().zip(&shift);
                    for ((output, input), (scale, shift)) in
                        output.iter_mut().zip(input).zip(factors)
                    {
                        *output = input * scale + shift;
                    }
                }
            });
        });
    output
}

/// Scale and shift of a normalisation: `gamma / deviation` and `beta - mean * scale`.
pub(crate) fn factors(
    moments: &Moments,
    gamma: &[f32],
    beta: &[f32],
    epsilon: f32,
) -> (Vec<f32>, Vec<f32>) {
    let scale: Vec<f32> = gamma
        .iter()
        .zip(&moments.variance)
        .map(|(gamma, variance)| gamma / (variance + epsilon).sqrt())
        .collect();
    let shift = beta
        .iter()
        .zip(&moments.mean)
        .zip(&scale)
        .map(|((beta, mean), scale)| beta - mean * scale)
        .collect();
    (scale, shift)
}

/// Gradients of a normalisation.
pub(crate) struct Gradients {
    pub(crate) input: Buffer,
    pub(crate) gamma: Vec<f32>,
    pub(crate) beta: Vec<f32>,
}

/// Gradients when mean and variance are those of the batch.
pub(crate) fn backward(
    input: &[f32],
    gradient: &[f32],
    moments: &Moments,
    gamma: &[f32],
    epsilon: f32,
) -> Gradients {
    let channels = gamma.len();
    let period = period(channels);
    let inverse: Vec<f32> = moments
        .variance
        .iter()
        .map(|variance| 1.0 / (variance + epsilon).sqrt())
        .collect();
    let (mean, block) = (repeated(&moments.mean, period), block(period));
    let parts: Vec<[Vec<f64>; 2]> = input
        .par_chunks(block)
        .zip(gradient.par_chunks(block))
        .map(|(input, gradient)| {
            let (mut sums, mut products) = (vec![0.0f32; period], vec![0.0f32; period]);
            pulp::Arch::new().dispatch(|| {
                for (input, gradient) in input.chunks(period).zip(gradient.chunks(period)) {
                    let values = input.iter().zip(gradient).zip(&mean);
                    let sums = sums.iter_mut().zip(products.iter_mut());
                    for ((sum, product), ((input, gradient), mean)) in sums.zip(values) {
                        *sum += gradient;
                        *product += gradient * (input - mean);
                    }
                }
            });
            [sums, products].map(|values| folded(&values, channels))
        })
        .collect();
    let mut totals = [vec![0.0; channels], vec![0.0; channels]];
    for part in parts {
        for (total, part) in totals.iter_mut().zip(part) {
            for (total, part) in total.iter_mut().zip(part) {
                *total += part;
            }
        }
    }
    let [grad_beta, products] =
        totals.map(|sums| sums.into_iter().map(|sum| sum as f32).collect::<Vec<_>>());
    let grad_gamma: Vec<f32> = products
        .iter()
        .zip(&inverse)
        .map(|(sum, inverse)| sum * inverse)
        .collect();
    let count = (input.len() / channels) as f32;
    // d input = scale * (d output - mean(d output) - normalised * mean(d output * normalised)), which is
    // scale * d output + slope * input + offset.
    let scale: Vec<f32> = gamma
        .iter()
        .zip(&inverse)
        .map(|(gamma, inverse)| gamma * inverse)
        .collect();
    let slope: Vec<f32> = (0..channels)
        .map(|k| -scale[k] * inverse[k] * grad_gamma[k] / count)
        .collect();
    let offset: Vec<f32> = (0..channels)
        .map(|k| -scale[k] * grad_beta[k] / count)
        .collect();
    let [scale, slope, offset] = [scale, slope, offset].map(|values| repeated(&values, period));
    let mut grad_input = Buffer::recycled(input.len());
    grad_input
        .par_chunks_mut(block)
        .zip(input.par_chunks(block))
        .zip(gradient.par_chunks(block))
        .for_each(|((grad_input, input), gradient)| {
            pulp::Arch::new().dispatch(|| {
                let chunks = grad_input
                    .chunks_mut(period)
                    .zip(input.chunks(period))
                    .zip(gradient.chunks(period));
                for ((grad_input, input), gradient) in chunks {
                    let factors = scale.iter().zip(&slope).zip(&offset).zip(&mean);
                    let values = grad_input.iter_mut().zip(input).zip(gradient);
                    for (((value, input), gradient), (((scale, slope), offset), mean)) in
                        values.zip(factors)
                    {
                        *value = scale * gradient + slope * (input - mean) + offset;
                    }
                }
            });
        });
    Gradients {
        input: grad_input,
        gamma: grad_gamma,
        beta: grad_beta,
    }
}
