use crate::Operation;
use crate::layers::{FactorizedReduce, NormedConv, depthwise};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::tensor::{Device, Tensor};
use normalight_kernels::depthwise_relu;

/// A separable convolution as in DARTS: twice ReLU, depthwise k x k, 1x1, batch norm; the first
/// depthwise convolution carries the stride.
#[derive(Module, Debug)]
pub(crate) struct SeparableConv {
    first_depthwise: Conv2d,
    first_pointwise: NormedConv,
    second_depthwise: Conv2d,
    second_pointwise: NormedConv,
}

impl SeparableConv {
    fn new(channels: usize, kernel: usize, stride: usize, folded: bool, device: &Device) -> Self {
        let pointwise = || NormedConv::pointwise([channels, channels], 1, folded, device);
        Self {
            first_depthwise: depthwise(channels, kernel, stride, device),
            first_pointwise: pointwise(),
            second_depthwise: depthwise(channels, kernel, 1, device),
            second_pointwise: pointwise(),
        }
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let half = |depthwise: &Conv2d, pointwise: &NormedConv, input| {
            let stride = depthwise.stride[0];
            pointwise.forward(depthwise_relu(input, depthwise.weight.val(), stride))
        };
        let middle = half(&self.first_depthwise, &self.first_pointwise, input);
        half(&self.second_depthwise, &self.second_pointwise, middle)
    }
}

/// The identity, or a factorised reduction where the edge has stride 2.
#[derive(Module, Debug)]
pub(crate) struct SkipConnection {
    reduce: Option<FactorizedReduce>,
}

/// Zeros of the size that the stride leaves.
#[derive(Module, Debug)]
pub(crate) struct NoConnection {
    stride: usize,
}

/// One of the five operations of the search space, with its weights.
#[derive(Module, Debug)]
pub(crate) enum OperationLayer {
    Separable(SeparableConv),
    Skip(SkipConnection),
    Zero(NoConnection),
}

impl OperationLayer {
    pub(crate) fn new(
        operation: Operation,
        channels: usize,
        stride: usize,
        folded: bool,
        device: &Device,
    ) -> Self {
        let separable =
            |kernel| Self::Separable(SeparableConv::new(channels, kernel, stride, folded, device));
        match operation {
            Operation::Separable1 => separable(1),
            Operation::Separable3 => separable(3),
            Operation::Separable5 => separable(5),
            Operation::Skip => Self::Skip(SkipConnection {
                reduce: (stride == 2)
                    .then(|| FactorizedReduce::new([channels, channels], folded, device)),
            }),
            Operation::Zero => Self::Zero(NoConnection { stride }),
        }
    }

    /// # Shapes
    /// - input: `[batch, height, width, channels]`
    /// - output: `[batch, height / stride, width / stride, channels]`
    pub(crate) fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        match self {
            Self::Separable(separable) => separable.forward(input),
            Self::Skip(skip) => match &skip.reduce {
                Some(reduce) => reduce.forward(input),
                None => input,
            },
            Self::Zero(zero) => {
                let [batch, height, width, channels] = input.dims();
                let (height, width) = (height.div_ceil(zero.stride), width.div_ceil(zero.stride));
                let shape = [batch, height, width, channels];
                Tensor::zeros(shape, &input.device())
            }
        }
    }

    pub(crate) fn folded(&self) -> Self {
        match self {
            Self::Separable(separable) => Self::Separable(SeparableConv {
                first_depthwise: separable.first_depthwise.clone(),
                first_pointwise: separable.first_pointwise.folded(),
                second_depthwise: separable.second_depthwise.clone(),
                second_pointwise: separable.second_pointwise.folded(),
            }),
            Self::Skip(skip) => Self::Skip(SkipConnection {
                reduce: skip.reduce.as_ref().map(FactorizedReduce::folded),
            }),
            Self::Zero(_) => self.clone(),
        }
    }
}
