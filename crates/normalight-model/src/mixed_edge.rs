use crate::SearchSpace;
use crate::layers::Form;
use crate::operation::OperationLayer;
use crate::relaxation::EdgeWeights;
use burn::module::Module;
use burn::tensor::{Device, Tensor};

/// An edge with all operations of the search space, added up by their weights.
#[derive(Module, Debug)]
pub(crate) struct MixedEdge {
    operations: Vec<OperationLayer>,
    stride: usize,
    /// Only one in so many channels goes through the operations (Xu et al. 2020).
    channel_divisor: usize,
}

impl MixedEdge {
    pub(crate) fn new(space: &SearchSpace, width: usize, stride: usize, device: &Device) -> Self {
        let channels = width / space.channel_divisor;
        let layers = space
            .operations
            .iter()
            .map(|&one| OperationLayer::new(one, channels, stride, Form::Relaxed, device));
        Self {
            operations: layers.collect(),
            stride,
            channel_divisor: space.channel_divisor,
        }
    }

    /// # Shapes
    /// - input: `[batch, height, width, channels]`
    /// - output: `[batch, height / stride, width / stride, channels]`
    pub(crate) fn forward(&self, input: Tensor<4>, weights: &EdgeWeights) -> Tensor<4> {
        let output = if self.channel_divisor == 1 {
            self.mixed(input, weights)
        } else {
            self.partly_mixed(input, weights)
        };
        match &weights.share {
            Some(share) => output * share.clone().reshape([1, 1, 1, 1]),
            None => output,
        }
    }

    fn mixed(&self, input: Tensor<4>, weights: &EdgeWeights) -> Tensor<4> {
        let [batch, height, width, channels] = input.dims();
        let outputs = self.operations.iter().zip(&weights.operations);
        let sum = outputs
            .filter_map(|(operation, weight)| operation.forward_weighted(input.clone(), weight))
            .reduce(|sum, output| sum + output);
        sum.unwrap_or_else(|| {
            let (height, width) = (height.div_ceil(self.stride), width.div_ceil(self.stride));
            Tensor::zeros([batch, height, width, channels], &input.device())
        })
    }

    /// The first channels go through the operations, the others pass by (through a maximum over 2x2 pixels at
    /// stride 2); then all are shuffled, so that the next edge takes others.
    fn partly_mixed(&self, input: Tensor<4>, weights: &EdgeWeights) -> Tensor<4> {
        let [batch, height, width, channels] = input.dims();
        let taken = channels / self.channel_divisor;
        let slice = |from: usize, to: usize| {
            let whole = [0..batch, 0..height, 0..width];
            let [batch, height, width] = whole;
            input.clone().slice([batch, height, width, from..to])
        };
        let mixed = self.mixed(slice(0, taken), weights);
        let mut passed = slice(taken, channels);
        if self.stride == 2 {
            let rest = channels - taken;
            let (height, width) = (height / 2, width / 2);
            let rows = passed.reshape([batch * height, 2, width * 2 * rest]);
            let rows = rows.max_dim(1).reshape([batch * height * width, 2, rest]);
            passed = rows.max_dim(1).reshape([batch, height, width, rest]);
        }
        let both = Tensor::cat(vec![mixed, passed], 3);
        let [batch, height, width, channels] = both.dims();
        both.reshape([batch * height * width, self.channel_divisor, taken])
            .swap_dims(1, 2)
            .reshape([batch, height, width, channels])
    }
}
