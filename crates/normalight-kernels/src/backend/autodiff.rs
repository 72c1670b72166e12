//! The operations with gradients.
use super::{
    FlexTensor, KernelBackend, depthwise, dims, geometry, max_with_index, small_tensor,
    split_moments, tensor, transposed_geometry,
};
use crate::cpu::{convolution, max_over_images, normalise, transposed};
use crate::settings::Convolution;
use burn::backend::autodiff::Autodiff;
use burn::backend::autodiff::checkpoint::base::Checkpointer;
use burn::backend::autodiff::checkpoint::strategy::CheckpointStrategy;
use burn::backend::autodiff::grads::Gradients;
use burn::backend::autodiff::ops::{Backward, Ops, OpsKind};
use burn::backend::tensor::FloatTensor;
use burn::backend::{AutodiffBackend, Flex};
use std::fmt::Debug;

/// Records an operation: `$backward` with its state if a parent wants gradients.
macro_rules! recorded {
    ($backward:expr, $strategy:ty, [$($parent:expr),+], $state:expr, $output:expr) => {{
        let nodes = [$($parent.node()),+];
        match $backward.prepare::<$strategy>(nodes).compute_bound().stateful() {
            OpsKind::Tracked(prepared) => prepared.finish($state, $output),
            OpsKind::UnTracked(prepared) => prepared.finish($output),
        }
    }};
}

/// A convolution and what its gradients need.
#[derive(Debug, Clone)]
struct Convolved<How> {
    input: FlexTensor,
    weight: FlexTensor,
    output: FlexTensor,
    how: How,
}

/// Hands the gradients of a convolution to the parents that want them: input, weight and bias. A macro, because the type
/// of the parents has no public name.
macro_rules! handed_over {
    ($state:expr, $found:expr, $parents:expr, $gradients:expr) => {{
        let (state, found, [grad_input, grad_weight, grad_bias]) = ($state, $found, $parents);
        if let (Some(node), Some(values)) = (grad_input, found.input) {
            $gradients.register::<Flex>(node.id, tensor(values, &dims(&state.input)));
        }
        if let (Some(node), Some(values)) = (grad_weight, found.weight) {
            $gradients.register::<Flex>(node.id, tensor(values, &dims(&state.weight)));
        }
        if let Some(node) = grad_bias {
            let shape = [found.bias.len()];
            $gradients.register::<Flex>(node.id, tensor(found.bias, &shape));
        }
    }};
}

#[derive(Debug)]
struct ConvolutionBackward;

impl Backward<Flex, 3> for ConvolutionBackward {
    type State = Convolved<Convolution>;

    fn backward(
        self,
        ops: Ops<Self::State, 3>,
        gradients: &mut Gradients,
        _checkpointer: &mut Checkpointer,
    ) {
        let gradient = gradients.consume::<Flex>(&ops.node).to_contiguous();
        let state = ops.state;
        let geometry = geometry(&state.input, &state.weight, &state.how);
        let found = convolution::Backward {
            geometry: &geometry,
            input: state.input.to_contiguous().storage(),
            weight: state.weight.to_contiguous().storage(),
            output: state.output.to_contiguous().storage(),
            gradient: gradient.storage(),
            slope: state.how.slope,
            wants_input: ops.parents[0].is_some(),
            wants_weight: ops.parents[1].is_some(),
            wants_bias: ops.parents[2].is_some(),
        }
        .gradients();
        handed_over!(state, found, ops.parents, gradients);
    }
}

#[derive(Debug)]
struct TransposedBackward;

impl Backward<Flex, 3> for TransposedBackward {
    type State = Convolved<f32>;

    fn backward(
        self,
        ops: Ops<Self::State, 3>,
        gradients: &mut Gradients,
        _checkpointer: &mut Checkpointer,
    ) {
        let gradient = gradients.consume::<Flex>(&ops.node).to_contiguous();
        let state = ops.state;
        let geometry = transposed_geometry(&state.input, &state.weight);
        let found = transposed::Backward {
            geometry: &geometry,
            input: state.input.to_contiguous().storage(),
            weight: state.weight.to_contiguous().storage(),
            output: state.output.to_contiguous().storage(),
            gradient: gradient.storage(),
            slope: state.how,
        }
        .gradients();
        handed_over!(state, found, ops.parents, gradients);
    }
}

/// A depthwise convolution: input, weight and stride.
#[derive(Debug)]
struct DepthwiseBackward;

impl Backward<Flex, 2> for DepthwiseBackward {
    type State = (FlexTensor, FlexTensor, usize);

    fn backward(
        self,
        ops: Ops<Self::State, 2>,
        gradients: &mut Gradients,
        _checkpointer: &mut Checkpointer,
    ) {
        let gradient = gradients.consume::<Flex>(&ops.node).to_contiguous();
        let (input, weight, stride) = ops.state;
        let (found_input, found_weight) = depthwise(&input, &weight, stride).backward(
            input.to_contiguous().storage(),
            weight.to_contiguous().storage(),
            gradient.storage(),
            ops.parents[1].is_some(),
        );
        let [grad_input, grad_weight] = ops.parents;
        if let Some(node) = grad_input {
            gradients.register::<Flex>(node.id, tensor(found_input, &dims(&input)));
        }
        if let Some(node) = grad_weight {
            gradients.register::<Flex>(node.id, tensor(found_weight, &dims(&weight)));
        }
    }
}

/// What the gradients of a batch normalisation need.
#[derive(Debug, Clone)]
struct Normalised {
    input: FlexTensor,
    /// `[2, channels]`.
    moments: FlexTensor,
    gamma: FlexTensor,
    epsilon: f32,
}

#[derive(Debug)]
struct NormalisationBackward;

impl Backward<Flex, 3> for NormalisationBackward {
    type State = Normalised;

    fn backward(
        self,
        ops: Ops<Self::State, 3>,
        gradients: &mut Gradients,
        _checkpointer: &mut Checkpointer,
    ) {
        let gradient = gradients.consume::<Flex>(&ops.node).to_contiguous();
        let state = ops.state;
        let found = normalise::backward(
            state.input.to_contiguous().storage(),
            gradient.storage(),
            &split_moments(&state.moments),
            state.gamma.to_contiguous().storage(),
            state.epsilon,
        );
        let channels = [found.gamma.len()];
        let [grad_input, grad_gamma, grad_beta] = ops.parents;
        if let Some(node) = grad_input {
            gradients.register::<Flex>(node.id, tensor(found.input, &dims(&state.input)));
        }
        if let Some(node) = grad_gamma {
            gradients.register::<Flex>(node.id, small_tensor(found.gamma, &channels));
        }
        if let Some(node) = grad_beta {
            gradients.register::<Flex>(node.id, small_tensor(found.beta, &channels));
        }
    }
}

/// A maximum: which image has it, and the input's shape.
#[derive(Debug)]
struct MaxBackward;

impl Backward<Flex, 1> for MaxBackward {
    type State = (Vec<u32>, [usize; 4], usize);

    fn backward(
        self,
        ops: Ops<Self::State, 1>,
        gradients: &mut Gradients,
        _checkpointer: &mut Checkpointer,
    ) {
        let gradient = gradients.consume::<Flex>(&ops.node).to_contiguous();
        let (which, shape, samples) = ops.state;
        let [rows, height, width, channels] = shape;
        let size = height * width * channels;
        if let [Some(node)] = ops.parents {
            let found = max_over_images::backward(gradient.storage(), &which, rows / samples, size);
            gradients.register::<Flex>(node.id, tensor(found, &shape));
        }
    }
}

impl<C: CheckpointStrategy> KernelBackend for Autodiff<Flex, C> {
    fn convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        how: Convolution,
    ) -> FloatTensor<Self> {
        let output = Flex::convolution(
            input.primitive().clone(),
            weight.primitive().clone(),
            bias.primitive().clone(),
            how,
        );
        let state = Convolved {
            input: input.primitive().clone(),
            weight: weight.primitive().clone(),
            output: output.clone(),
            how,
        };
        recorded!(ConvolutionBackward, C, [input, weight, bias], state, output)
    }

    fn transposed_convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        slope: f32,
    ) -> FloatTensor<Self> {
        let output = Flex::transposed_convolution(
            input.primitive().clone(),
            weight.primitive().clone(),
            bias.primitive().clone(),
            slope,
        );
        let state = Convolved {
            input: input.primitive().clone(),
            weight: weight.primitive().clone(),
            output: output.clone(),
            how: slope,
        };
        recorded!(TransposedBackward, C, [input, weight, bias], state, output)
    }

    fn depthwise_relu(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        stride: usize,
    ) -> FloatTensor<Self> {
        let (plain, plain_weight) = (input.primitive().clone(), weight.primitive().clone());
        let output = Flex::depthwise_relu(plain.clone(), plain_weight.clone(), stride);
        let state = (plain, plain_weight, stride);
        recorded!(DepthwiseBackward, C, [input, weight], state, output)
    }

    fn channel_moments(input: FloatTensor<Self>) -> FloatTensor<Self> {
        Self::from_inner(Flex::channel_moments(input.primitive().clone()))
    }

    fn batch_norm(
        input: FloatTensor<Self>,
        moments: FloatTensor<Self>,
        gamma: FloatTensor<Self>,
        beta: FloatTensor<Self>,
        epsilon: f32,
    ) -> FloatTensor<Self> {
        let state = Normalised {
            input: input.primitive().clone(),
            moments: moments.primitive().clone(),
            gamma: gamma.primitive().clone(),
            epsilon,
        };
        let output = Flex::batch_norm(
            state.input.clone(),
            state.moments.clone(),
            state.gamma.clone(),
            beta.primitive().clone(),
            epsilon,
        );
        recorded!(
            NormalisationBackward,
            C,
            [input, gamma, beta],
            state,
            output
        )
    }

    fn max_over_images(input: FloatTensor<Self>, samples: usize) -> FloatTensor<Self> {
        let shape = dims(input.primitive());
        let (output, which) = max_with_index(input.primitive(), samples);
        let state = (which, shape, samples);
        recorded!(MaxBackward, C, [input], state, output)
    }
}
