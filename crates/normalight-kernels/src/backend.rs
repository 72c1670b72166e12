//! The operations as extensions of Burn's backends.
#[cfg(feature = "autodiff")]
mod autodiff;

use crate::cpu::buffer::Buffer;
use crate::cpu::depthwise::Depthwise;
use crate::cpu::geometry::Geometry;
use crate::cpu::normalise::{self, Moments};
use crate::cpu::{convolution, max_over_images, transposed};
use crate::settings::Convolution;
use burn::backend::tensor::FloatTensor;
use burn::backend::{Backend, Flex, TensorMetadata, backend_extension};
use burn::tensor::{DType, TensorData};

/// Our operations, by backend; the functions of this crate's root describe them.
#[backend_extension(Flex, Autodiff: cfg(feature = "autodiff"))]
pub(crate) trait KernelBackend: Backend {
    fn convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        how: Convolution,
    ) -> FloatTensor<Self>;

    fn transposed_convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        slope: f32,
    ) -> FloatTensor<Self>;

    fn depthwise_relu(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        stride: usize,
    ) -> FloatTensor<Self>;

    /// `[2, channels]`, mean and variance; without gradients.
    fn channel_moments(input: FloatTensor<Self>) -> FloatTensor<Self>;

    /// `moments` as from `channel_moments`.
    fn batch_norm(
        input: FloatTensor<Self>,
        moments: FloatTensor<Self>,
        gamma: FloatTensor<Self>,
        beta: FloatTensor<Self>,
        epsilon: f32,
    ) -> FloatTensor<Self>;

    fn max_over_images(input: FloatTensor<Self>, samples: usize) -> FloatTensor<Self>;
}

type FlexTensor = FloatTensor<Flex>;

/// A tensor of our own memory.
fn tensor(values: Buffer, shape: &[usize]) -> FlexTensor {
    let data = TensorData::from_bytes(values.into_bytes(), shape.to_vec(), DType::F32);
    FlexTensor::from_data(data)
}

fn small_tensor(values: Vec<f32>, shape: &[usize]) -> FlexTensor {
    FlexTensor::from_data(TensorData::new(values, shape.to_vec()))
}

fn dims(tensor: &FlexTensor) -> [usize; 4] {
    tensor.shape().dims()
}

/// Sizes of a convolution from its tensors.
fn geometry(input: &FlexTensor, weight: &FlexTensor, how: &Convolution) -> Geometry {
    let [batch, stored_height, stored_width, channels_in] = dims(input);
    let [channels_out, _, size, _] = dims(weight);
    Geometry {
        batch,
        channels_in,
        channels_out,
        stored_height,
        stored_width,
        zoom: how.upsampling,
        size,
        stride: how.stride,
        origin: how.shift as isize - (size / 2) as isize,
    }
}

/// Sizes of the convolution that a transposed one is the transpose of.
fn transposed_geometry(input: &FlexTensor, weight: &FlexTensor) -> Geometry {
    let [batch, height, width, channels_out] = dims(input);
    let [_, channels_in, size, _] = dims(weight);
    let stride = 2;
    Geometry {
        batch,
        channels_in,
        channels_out,
        stored_height: stride * height,
        stored_width: stride * width,
        zoom: 1,
        size,
        stride,
        origin: -1,
    }
}

fn depthwise(input: &FlexTensor, weight: &FlexTensor, stride: usize) -> Depthwise {
    let [batch, height, width, channels] = dims(input);
    Depthwise {
        batch,
        height,
        width,
        channels,
        size: dims(weight)[2],
        stride,
    }
}

/// Mean and variance from `[2, channels]`.
fn split_moments(both: &FlexTensor) -> Moments {
    let both = both.to_contiguous();
    let values: &[f32] = both.storage();
    let (mean, variance) = values.split_at(values.len() / 2);
    Moments {
        mean: mean.to_vec(),
        variance: variance.to_vec(),
    }
}

/// The maximum and which image it came from.
fn max_with_index(input: &FlexTensor, samples: usize) -> (FlexTensor, Vec<u32>) {
    let [rows, height, width, channels] = dims(input);
    let size = height * width * channels;
    let (largest, which) =
        max_over_images::forward(input.to_contiguous().storage(), rows / samples, size);
    (tensor(largest, &[samples, height, width, channels]), which)
}

impl KernelBackend for Flex {
    fn convolution(
        input: FlexTensor,
        weight: FlexTensor,
        bias: FlexTensor,
        how: Convolution,
    ) -> FlexTensor {
        let geometry = geometry(&input, &weight, &how);
        let output = convolution::forward(
            &geometry,
            input.to_contiguous().storage(),
            weight.to_contiguous().storage(),
            bias.to_contiguous().storage(),
            how.slope,
        );
        let (height, width) = (geometry.out_height(), geometry.out_width());
        tensor(
            output,
            &[geometry.batch, height, width, geometry.channels_out],
        )
    }

    fn transposed_convolution(
        input: FlexTensor,
        weight: FlexTensor,
        bias: FlexTensor,
        slope: f32,
    ) -> FlexTensor {
        let geometry = transposed_geometry(&input, &weight);
        let output = transposed::forward(
            &geometry,
            input.to_contiguous().storage(),
            weight.to_contiguous().storage(),
            bias.to_contiguous().storage(),
            slope,
        );
        let (height, width) = (geometry.height(), geometry.width());
        tensor(
            output,
            &[geometry.batch, height, width, geometry.channels_in],
        )
    }

    fn depthwise_relu(input: FlexTensor, weight: FlexTensor, stride: usize) -> FlexTensor {
        let sizes = depthwise(&input, &weight, stride);
        let output = sizes.forward(
            input.to_contiguous().storage(),
            weight.to_contiguous().storage(),
        );
        let (height, width) = (sizes.out_height(), sizes.out_width());
        tensor(output, &[sizes.batch, height, width, sizes.channels])
    }

    fn channel_moments(input: FlexTensor) -> FlexTensor {
        let channels = dims(&input)[3];
        let moments = normalise::moments(input.to_contiguous().storage(), channels);
        let mut both = moments.mean;
        both.extend(moments.variance);
        small_tensor(both, &[2, channels])
    }

    fn batch_norm(
        input: FlexTensor,
        moments: FlexTensor,
        gamma: FlexTensor,
        beta: FlexTensor,
        epsilon: f32,
    ) -> FlexTensor {
        let (scale, shift) = normalise::factors(
            &split_moments(&moments),
            gamma.to_contiguous().storage(),
            beta.to_contiguous().storage(),
            epsilon,
        );
        let output = normalise::scaled(input.to_contiguous().storage(), &scale, &shift);
        tensor(output, &dims(&input))
    }

    fn max_over_images(input: FlexTensor, samples: usize) -> FlexTensor {
        max_with_index(&input, samples).0
    }
}
