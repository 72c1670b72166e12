mod fused;
mod pixel_branch;
mod plain;
mod staged;

pub use fused::FusedFeatures;

use crate::cell::{CellLayer, CellPlan, CellRow, forward_row};
use crate::layers::{
    Form, convolution, convolve, convolve_doubled, convolve_leaky, convolve_row, doubled_by,
    transposed_doubling, unit_length,
};
use crate::{
    CellNormal, ModelError, NormalArchitecture, NormalBody, NormalGenotype, Relaxation,
    SearchSpace, Upsampling,
};
use burn::module::Module;
use burn::nn::conv::{Conv2d, ConvTranspose2d};
use burn::tensor::{Device, Tensor};
use normalight_kernels::max_over_images;
use plain::PlainBody;
use staged::StagedBody;

/// The normal estimation network: per-image features, their maximum over all images, and a regressor of unit normals.
#[derive(Module, Debug)]
pub struct NormalNetwork {
    body: Body,
    /// Weights of the operations, in a network that is searched.
    relaxation: Option<Relaxation>,
}

#[derive(Module, Debug)]
enum Body {
    Plain(PlainBody),
    Cells(CellBody),
    Staged(StagedBody),
}

#[derive(Module, Debug)]
struct CellBody {
    stem: Vec<Conv2d>,
    features: Vec<CellLayer>,
    feature_up: UpLayer,
    feature_conv: Conv2d,
    /// Whether `feature_conv` doubles the size, too.
    second_up: bool,
    fused: Vec<Conv2d>,
    regressor: Vec<CellLayer>,
    regressor_up: UpLayer,
    output: Conv2d,
}

/// Doubles the size, perhaps, and changes the width.
#[derive(Module, Debug)]
enum UpLayer {
    Transposed(ConvTranspose2d),
    Nearest(Conv2d),
    /// The size stays.
    Same(Conv2d),
}

impl UpLayer {
    fn new(channels: [usize; 2], upsampling: Upsampling, device: &Device) -> Self {
        match upsampling {
            Upsampling::Transposed => Self::Transposed(transposed_doubling(channels, device)),
            Upsampling::Nearest => Self::Nearest(convolution(channels, 3, 1, device)),
        }
    }

    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        match self {
            Self::Transposed(conv) => doubled_by(conv, input),
            Self::Nearest(conv) => convolve_doubled(conv, input),
            Self::Same(conv) => convolve_leaky(conv, input),
        }
    }
}

impl NormalNetwork {
    /// Side lengths of inputs must be multiples of this.
    pub const ALIGNMENT: usize = 8;

    /// Builds the network with random weights; `folded` builds the form that is stored, without
    /// normalisation layers.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn new(
        architecture: &NormalArchitecture,
        folded: bool,
        device: &Device,
    ) -> Result<Self, ModelError> {
        architecture.validate()?;
        let channels = architecture.input_channels();
        let form = if folded { Form::Folded } else { Form::Affine };
        let body = match &architecture.body {
            NormalBody::Plain(plain) => Body::Plain(PlainBody::new(plain, channels, device)),
            NormalBody::Staged(staged) => {
                Body::Staged(StagedBody::new(staged, channels, form, device))
            }
            NormalBody::Cells(cells) => {
                let plans = cells.genotype.required()?.cells().map(CellPlan::Chosen);
                Body::Cells(CellBody::new(cells, plans, channels, form, device))
            }
        };
        Ok(Self {
            body,
            relaxation: None,
        })
    }

    /// Builds the network of a search: cells with all edges and operations of the space instead of those of
    /// the architecture's genotype.
    ///
    /// # Errors
    /// [`ModelError::Architecture`], also for a plain network.
    pub fn relaxed(
        architecture: &NormalArchitecture,
        space: &SearchSpace,
        device: &Device,
    ) -> Result<Self, ModelError> {
        architecture.validate()?;
        let NormalBody::Cells(cells) = &architecture.body else {
            return Err(ModelError::no_cells());
        };
        space.validate_for(cells.width)?;
        let plans = [0, 1, 2].map(|cell| CellPlan::Relaxed(space, cell));
        let channels = architecture.input_channels();
        let count = NormalGenotype::CELLS.len();
        Ok(Self {
            body: Body::Cells(CellBody::new(cells, plans, channels, Form::Relaxed, device)),
            relaxation: Some(Relaxation::new(space, count, device)),
        })
    }

    /// Weights of the operations, in a network that is searched.
    pub fn relaxation(&self) -> Option<&Relaxation> {
        self.relaxation.as_ref()
    }

    /// The same, to change them.
    pub fn relaxation_mut(&mut self) -> Option<&mut Relaxation> {
        self.relaxation.as_mut()
    }

    /// Runs a row of cells.
    fn row(&self, cells: &[CellLayer], stem: Tensor<4>) -> Tensor<4> {
        let mixture = self.relaxation.as_ref().map(Relaxation::mixture);
        forward_row(cells, stem, mixture.as_ref())
    }

    /// How often the features of all images are computed before normals can be: more than once where images exchange.
    pub fn passes(&self) -> usize {
        match &self.body {
            Body::Staged(staged) => staged.passes(),
            Body::Plain(_) | Body::Cells(_) => 1,
        }
    }

    /// What the network keeps of the images of `stacks` stacks, which lie one after the other with as many images each.
    ///
    /// # Shapes
    /// - input: `[stacks * images, height, width, 6 or 7]`: normalised RGB, light direction, perhaps the mask; sides
    ///   multiples of [`NormalNetwork::ALIGNMENT`]
    ///
    /// # Panics
    /// If the number of images is not a multiple of `stacks`.
    pub fn fuse(&self, input: Tensor<4>, stacks: usize) -> FusedFeatures {
        let mut kept: Vec<FusedFeatures> = Vec::new();
        for _ in 1..self.passes() {
            kept.push(self.fuse_after(input.clone(), stacks, &kept));
        }
        self.fuse_after(input, stacks, &kept)
    }

    /// The same in one of [`NormalNetwork::passes`], after what earlier passes kept of all images of the stacks: in the first
    /// of nothing.
    ///
    /// # Shapes
    /// Those of [`NormalNetwork::fuse`].
    ///
    /// # Panics
    /// As [`NormalNetwork::fuse`].
    pub fn fuse_after(
        &self,
        input: Tensor<4>,
        stacks: usize,
        before: &[FusedFeatures],
    ) -> FusedFeatures {
        match &self.body {
            Body::Plain(plain) => plain.fuse(input, stacks),
            Body::Staged(staged) => staged.fuse(input, stacks, before),
            Body::Cells(cells) => {
                let images = input.dims()[0] / stacks;
                let row = self.row(&cells.features, convolve_row(&cells.stem, input));
                let features = cells.feature_up.forward(row);
                let features = if cells.second_up {
                    convolve_doubled(&cells.feature_conv, features)
                } else {
                    convolve_leaky(&cells.feature_conv, features)
                };
                FusedFeatures {
                    features: max_over_images(features, stacks),
                    sum: None,
                    pixels: None,
                    images,
                }
            }
        }
    }

    /// Unit normals from what was kept of the images.
    ///
    /// # Shapes
    /// - output: `[stacks, height, width, 3]`
    pub fn regress(&self, fused: FusedFeatures) -> Tensor<4> {
        let raw = match &self.body {
            Body::Plain(plain) => plain.regress(fused),
            Body::Staged(staged) => staged.regress(fused),
            Body::Cells(cells) => {
                let row = self.row(&cells.regressor, convolve_row(&cells.fused, fused.features));
                convolve(&cells.output, cells.regressor_up.forward(row))
            }
        };
        unit_length(raw)
    }

    /// The same function with every normalisation layer folded into its convolution.
    pub fn folded(&self) -> Self {
        let mut network = self.clone();
        match &mut network.body {
            Body::Plain(_) => {}
            Body::Staged(staged) => *staged = staged.folded(),
            Body::Cells(cells) => {
                let fold = |cells: &[CellLayer]| cells.iter().map(CellLayer::folded).collect();
                cells.features = fold(&cells.features);
                cells.regressor = fold(&cells.regressor);
            }
        }
        network
    }
}

impl CellBody {
    fn new(
        cells: &CellNormal,
        [normal, reduction, regressor]: [CellPlan; 3],
        channels: usize,
        form: Form,
        device: &Device,
    ) -> Self {
        let width = cells.width;
        let conv = |channels, stride| convolution(channels, 3, stride, device);
        let stem = vec![
            conv([channels, 2 * width], cells.stem_strides[0]),
            conv([2 * width, 3 * width], cells.stem_strides[1]),
        ];
        let mut row = CellRow::new(3 * width, width, form, device);
        let features = row.features(normal, reduction, cells.reductions);
        let mut regressor_row = CellRow::new(3 * width, width, form, device);
        let regressor: Vec<CellLayer> = (0..3).map(|_| regressor_row.normal(regressor)).collect();
        let mut fused = vec![conv([4 * width, 3 * width], 1)];
        if cells.fused_convolutions == 2 {
            fused.insert(0, conv([4 * width, 4 * width], 1));
        }
        let feature_channels = [row.last, 4 * width];
        Self {
            stem,
            feature_up: match cells.doublings() {
                0 => UpLayer::Same(conv(feature_channels, 1)),
                _ => UpLayer::new(feature_channels, cells.upsampling, device),
            },
            feature_conv: conv([4 * width, 4 * width], 1),
            second_up: cells.doublings() == 2,
            features,
            fused,
            regressor_up: UpLayer::new([regressor_row.last, 2 * width], cells.upsampling, device),
            regressor,
            output: conv([2 * width, 3], 1),
        }
    }
}
