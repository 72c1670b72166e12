use crate::flex::{ConvolutionOps, backward};
use crate::geometry::Geometry;
use burn::backend::autodiff::Autodiff;
use burn::backend::autodiff::checkpoint::base::Checkpointer;
use burn::backend::autodiff::checkpoint::strategy::CheckpointStrategy;
use burn::backend::autodiff::grads::Gradients;
use burn::backend::autodiff::ops::{Backward, Ops, OpsKind};
use burn::backend::ops::FloatTensorOps;
use burn::backend::tensor::FloatTensor;
use burn::backend::{Flex, TensorMetadata};
use burn::tensor::TensorData;

/// What the backward pass of a convolution needs.
#[derive(Debug, Clone)]
struct Convolution {
    input: FloatTensor<Flex>,
    weight: FloatTensor<Flex>,
    output: FloatTensor<Flex>,
    stride: usize,
    slope: f32,
}

#[derive(Debug)]
struct ConvolutionBackward;

impl Backward<Flex, 3> for ConvolutionBackward {
    type State = Convolution;

    fn backward(
        self,
        ops: Ops<Self::State, 3>,
        gradients: &mut Gradients,
        _checkpointer: &mut Checkpointer,
    ) {
        let gradient = gradients.consume::<Flex>(&ops.node);
        let state = ops.state;
        let (shape_in, shape_weight) = (state.input.shape(), state.weight.shape());
        let geometry = Geometry::new(shape_in.dims(), shape_weight.dims(), state.stride);
        let [of_input, of_weight, of_bias] = ops.parents;
        let found = backward(
            &geometry,
            state.input.to_contiguous().storage(),
            state.weight.to_contiguous().storage(),
            state.output.to_contiguous().storage(),
            gradient.to_contiguous().storage(),
            state.slope,
            of_input.is_some(),
        );
        let device = Default::default();
        let tensor = |values: Vec<f32>, shape: Vec<usize>| {
            Flex::float_from_data(TensorData::new(values, shape), &device)
        };
        if let (Some(node), Some(values)) = (of_input, found.input) {
            gradients.register::<Flex>(node.id, tensor(values, shape_in.to_vec()));
        }
        if let Some(node) = of_weight {
            gradients.register::<Flex>(node.id, tensor(found.weight, shape_weight.to_vec()));
        }
        if let Some(node) = of_bias {
            let shape = vec![geometry.channels_out];
            gradients.register::<Flex>(node.id, tensor(found.bias, shape));
        }
    }
}

impl<C: CheckpointStrategy> ConvolutionOps for Autodiff<Flex, C> {
    fn convolution(
        input: FloatTensor<Self>,
        weight: FloatTensor<Self>,
        bias: FloatTensor<Self>,
        stride: usize,
        slope: f32,
    ) -> FloatTensor<Self> {
        let nodes = [input.node(), weight.node(), bias.node()];
        let output = Flex::convolution(
            input.primitive().clone(),
            weight.primitive().clone(),
            bias.primitive().clone(),
            stride,
            slope,
        );
        match ConvolutionBackward
            .prepare::<C>(nodes)
            .compute_bound()
            .stateful()
        {
            OpsKind::Tracked(prepared) => prepared.finish(
                Convolution {
                    input: input.primitive().clone(),
                    weight: weight.primitive().clone(),
                    output: output.clone(),
                    stride,
                    slope,
                },
                output,
            ),
            OpsKind::UnTracked(prepared) => prepared.finish(output),
        }
    }
}
