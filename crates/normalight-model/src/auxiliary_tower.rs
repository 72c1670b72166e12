use crate::layers::{
    convolution, convolve, convolve_doubled, convolve_leaky, convolve_row, unit_length,
};
use crate::{NormalArchitecture, NormalBody};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::tensor::{Device, Tensor};

/// A second way from the fused features of a normal network to normals: the regressor without its
/// cells. Its loss reaches the features directly, while they are trained; nothing else needs it, so
/// weights files do not hold it.
///
/// It grows by nearest neighbour whatever the network does.
#[derive(Module, Debug)]
pub struct AuxiliaryTower {
    fused: Vec<Conv2d>,
    up: Conv2d,
    /// Further doublings, where images meet at a quarter of the size or less.
    further: Vec<Conv2d>,
    output: Conv2d,
    /// How often the size doubles.
    doublings: usize,
}

impl AuxiliaryTower {
    /// The tower for the fused features of this network, with random weights.
    pub fn new(architecture: &NormalArchitecture, device: &Device) -> Self {
        // Channels of the fused features, after the second convolution, and at full size.
        let ([fused, middle, full], doublings) = match &architecture.body {
            NormalBody::Plain(plain) => ([plain.widths[1], plain.widths[1], plain.head], 1),
            NormalBody::Cells(cells) => ([4, 3, 2].map(|times| times * cells.width), 1),
            NormalBody::Staged(staged) => {
                let head = staged.fused.last().map_or(0, |stage| stage.width);
                let meeting = staged.meeting_width();
                ([meeting, meeting, head], staged.meeting_halvings())
            }
        };
        let conv = |channels| convolution(channels, 3, 1, device);
        Self {
            fused: vec![conv([fused, fused]), conv([fused, middle])],
            up: conv([middle, full]),
            further: (1..doublings).map(|_| conv([full, full])).collect(),
            doublings,
            output: conv([full, 3]),
        }
    }

    /// Unit normals from the maximum of the features over the images.
    ///
    /// # Shapes
    /// As of [`NormalNetwork::regress`](crate::NormalNetwork::regress).
    pub fn forward(&self, fused: Tensor<4>) -> Tensor<4> {
        let row = convolve_row(&self.fused, fused);
        let grown = match self.doublings {
            0 => convolve_leaky(&self.up, row),
            _ => convolve_doubled(&self.up, row),
        };
        let grown = self
            .further
            .iter()
            .fold(grown, |map, layer| convolve_doubled(layer, map));
        let raw = convolve(&self.output, grown);
        unit_length(raw)
    }
}
