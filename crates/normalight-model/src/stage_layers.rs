//! Stages of a network, with their weights.
use crate::layers::{
    Form, LEAK, NormedConv, convolution, convolve_as, depthwise, doubled_by, leaky,
    transposed_doubling,
};
use crate::{LayerKind, Stage};
use burn::module::Module;
use burn::nn::conv::{Conv2d, ConvTranspose2d};
use burn::tensor::{Device, Tensor};
use normalight_kernels::depthwise_relu;

/// What the first layer of a stage does to the size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Resize {
    Keep,
    Halve,
    Double,
}

/// The layers of a stage.
#[derive(Module, Debug)]
pub(crate) struct StageLayers {
    layers: Vec<StageLayer>,
    residual: bool,
}

#[derive(Module, Debug)]
struct StageLayer {
    depthwise: Option<Conv2d>,
    to_width: ToWidth,
    /// The layer's input is enlarged by this: 1 or 2.
    upsampling: usize,
}

/// The convolution to a layer's width.
#[derive(Module, Debug)]
enum ToWidth {
    Biased(Conv2d),
    Normed(NormedConv),
    /// It doubles the size itself.
    Transposed(ConvTranspose2d),
}

/// Stages one after the other, on maps of `width` channels: what the first and what each of the others does to the size.
/// `sees_input`: the maps come from outside.
pub(crate) fn stage_row(
    mut width: usize,
    stages: &[Stage],
    (resizes, sees_input): ([Resize; 2], bool),
    form: Form,
    device: &Device,
) -> Vec<StageLayers> {
    let layers = stages.iter().enumerate().map(|(place, stage)| {
        let how = (resizes[usize::from(place > 0)], sees_input && place == 0);
        let from = std::mem::replace(&mut width, stage.width);
        StageLayers::new(from, stage, how, form, device)
    });
    layers.collect()
}

pub(crate) fn forward_stages<'a>(
    stages: impl IntoIterator<Item = &'a StageLayers>,
    input: Tensor<4>,
) -> Tensor<4> {
    let stages = stages.into_iter();
    stages.fold(input, |input, stage| stage.forward(input))
}

pub(crate) fn folded_stages(stages: &[StageLayers]) -> Vec<StageLayers> {
    stages.iter().map(StageLayers::folded).collect()
}

impl StageLayers {
    /// With random weights. `is_first`: the stage sees what comes from outside, whose signs a ReLU would take away.
    fn new(
        channels: usize,
        stage: &Stage,
        (resize, is_first): (Resize, bool),
        form: Form,
        device: &Device,
    ) -> Self {
        let layer = |place: usize| {
            let from = if place == 0 { channels } else { stage.width };
            let resize = if place == 0 { resize } else { Resize::Keep };
            let kind = match stage.kind {
                LayerKind::Separable3 | LayerKind::Separable5 if is_first && place == 0 => {
                    LayerKind::Convolution3
                }
                kind => kind,
            };
            StageLayer::new(
                [from, stage.width],
                (kind, resize),
                stage.normalised,
                form,
                device,
            )
        };
        Self {
            layers: (0..stage.layers).map(layer).collect(),
            residual: stage.residual,
        }
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let mut layers = self.layers.iter();
        let first = layers
            .next()
            .map_or(input.clone(), |layer| layer.forward(input));
        layers.fold(first, |input, layer| match self.residual {
            true => input.clone() + layer.forward(input),
            false => layer.forward(input),
        })
    }

    fn folded(&self) -> Self {
        let layers = self.layers.iter().map(|layer| StageLayer {
            depthwise: layer.depthwise.clone(),
            to_width: match &layer.to_width {
                ToWidth::Normed(normed) => ToWidth::Normed(normed.folded()),
                other @ (ToWidth::Biased(_) | ToWidth::Transposed(_)) => other.clone(),
            },
            upsampling: layer.upsampling,
        });
        Self {
            layers: layers.collect(),
            residual: self.residual,
        }
    }
}

impl StageLayer {
    fn new(
        channels: [usize; 2],
        (kind, resize): (LayerKind, Resize),
        normalised: bool,
        form: Form,
        device: &Device,
    ) -> Self {
        let stride = if resize == Resize::Halve { 2 } else { 1 };
        let spatial = kind
            .depthwise()
            .map(|size| depthwise(channels[0], size, stride, device));
        let size = match kind {
            LayerKind::Convolution3 | LayerKind::Transposed4 => 3,
            LayerKind::Separable3 | LayerKind::Separable5 | LayerKind::Pointwise => 1,
        };
        let doubles = resize == Resize::Double;
        let transposed = doubles && kind == LayerKind::Transposed4;
        // Where there is a depthwise convolution it has the stride.
        let stride = if spatial.is_some() { 1 } else { stride };
        Self {
            depthwise: spatial,
            to_width: match (transposed, normalised) {
                (true, _) => ToWidth::Transposed(transposed_doubling(channels, device)),
                (_, true) => ToWidth::Normed(NormedConv::new(channels, size, stride, form, device)),
                _ => ToWidth::Biased(convolution(channels, size, stride, device)),
            },
            upsampling: if doubles { 2 } else { 1 },
        }
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        let input = match &self.depthwise {
            Some(conv) => depthwise_relu(input, conv.weight.val(), conv.stride[0]),
            None => input,
        };
        match &self.to_width {
            ToWidth::Biased(conv) => convolve_as(conv, input, self.upsampling, LEAK),
            ToWidth::Normed(normed) => leaky(normed.forward_enlarged(input, self.upsampling)),
            ToWidth::Transposed(conv) => doubled_by(conv, input),
        }
    }
}
