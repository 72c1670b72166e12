use crate::Operation;
use crate::layers::{FactorizedReduce, Form, NormedConv, depthwise};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::tensor::{Device, Tensor, activation};
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
    fn new(channels: usize, kernel: usize, stride: usize, form: Form, device: &Device) -> Self {
        let pointwise = || NormedConv::pointwise([channels, channels], 1, form, device);
        Self {
            first_depthwise: depthwise(channels, kernel, stride, device),
            first_pointwise: pointwise(),
            second_depthwise: depthwise(channels, kernel, 1, device),
            second_pointwise: pointwise(),
        }
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        self.second_pointwise.forward(self.up_to_last(input))
    }

    fn forward_weighted(&self, input: Tensor<4>, weight: &Tensor<1>) -> Tensor<4> {
        let before = self.up_to_last(input);
        self.second_pointwise.forward_weighted(before, weight)
    }

    /// All but the last 1x1 convolution.
    fn up_to_last(&self, input: Tensor<4>) -> Tensor<4> {
        let stride = self.first_depthwise.stride[0];
        let first = depthwise_relu(input, self.first_depthwise.weight.val(), stride);
        let middle = self.first_pointwise.forward(first);
        depthwise_relu(middle, self.second_depthwise.weight.val(), 1)
    }
}

/// ReLU, 3x3 convolution, batch norm.
#[derive(Module, Debug)]
pub(crate) struct PlainConv {
    conv: NormedConv,
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

/// One of the operations of the search space, with its weights.
#[derive(Module, Debug)]
pub struct OperationLayer {
    kind: Kind,
}

#[derive(Module, Debug)]
enum Kind {
    Separable(SeparableConv),
    Convolution(PlainConv),
    Skip(SkipConnection),
    Zero(NoConnection),
}

impl OperationLayer {
    /// An operation as it is trained on an edge by itself, with random weights.
    pub fn trained(operation: Operation, channels: usize, stride: usize, device: &Device) -> Self {
        Self::new(operation, channels, stride, Form::Affine, device)
    }

    pub(crate) fn new(
        operation: Operation,
        channels: usize,
        stride: usize,
        form: Form,
        device: &Device,
    ) -> Self {
        let separable =
            |kernel| Kind::Separable(SeparableConv::new(channels, kernel, stride, form, device));
        let kind = match operation {
            Operation::Separable1 => separable(1),
            Operation::Separable3 => separable(3),
            Operation::Separable5 => separable(5),
            Operation::Convolution3 => Kind::Convolution(PlainConv {
                conv: NormedConv::new([channels, channels], 3, stride, form, device),
            }),
            Operation::Skip => Kind::Skip(SkipConnection {
                reduce: (stride == 2)
                    .then(|| FactorizedReduce::new([channels, channels], form, device)),
            }),
            Operation::Zero => Kind::Zero(NoConnection { stride }),
        };
        Self { kind }
    }

    /// Applies it.
    ///
    /// # Shapes
    /// - input: `[batch, height, width, channels]`
    /// - output: `[batch, height / stride, width / stride, channels]`
    pub fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        match &self.kind {
            Kind::Separable(separable) => separable.forward(input),
            Kind::Convolution(plain) => plain.conv.forward(activation::relu(input)),
            Kind::Skip(skip) => match &skip.reduce {
                Some(reduce) => reduce.forward(input),
                None => input,
            },
            Kind::Zero(zero) => {
                let [batch, height, width, channels] = input.dims();
                let (height, width) = (height.div_ceil(zero.stride), width.div_ceil(zero.stride));
                let shape = [batch, height, width, channels];
                Tensor::zeros(shape, &input.device())
            }
        }
    }

    /// [`Self::forward`] times a number, `[1]`; nothing for zeros.
    pub(crate) fn forward_weighted(
        &self,
        input: Tensor<4>,
        weight: &Tensor<1>,
    ) -> Option<Tensor<4>> {
        match &self.kind {
            Kind::Separable(separable) => Some(separable.forward_weighted(input, weight)),
            Kind::Convolution(plain) => {
                let input = activation::relu(input);
                Some(plain.conv.forward_weighted(input, weight))
            }
            Kind::Skip(skip) => Some(match &skip.reduce {
                Some(reduce) => reduce.forward_weighted(input, weight),
                None => input * weight.clone().reshape([1, 1, 1, 1]),
            }),
            Kind::Zero(_) => None,
        }
    }

    pub(crate) fn folded(&self) -> Self {
        let kind = match &self.kind {
            Kind::Convolution(plain) => Kind::Convolution(PlainConv {
                conv: plain.conv.folded(),
            }),
            Kind::Separable(separable) => Kind::Separable(SeparableConv {
                first_depthwise: separable.first_depthwise.clone(),
                first_pointwise: separable.first_pointwise.folded(),
                second_depthwise: separable.second_depthwise.clone(),
                second_pointwise: separable.second_pointwise.folded(),
            }),
            Kind::Skip(skip) => Kind::Skip(SkipConnection {
                reduce: skip.reduce.as_ref().map(FactorizedReduce::folded),
            }),
            Kind::Zero(_) => self.kind.clone(),
        };
        Self { kind }
    }
}
