use crate::cell::{CellLayer, CellPlan, CellRow, forward_row};
use crate::layers::{Form, convolution, convolve_row, leaky};
use crate::stage_layers::{Resize, StageLayers, folded_stages, forward_stages, stage_row};
use crate::{
    CellLight, LightArchitecture, LightBody, LightGenotype, ModelError, PlainLight, Relaxation,
    SearchSpace, Stage, StagedLight,
};
use burn::module::Module;
use burn::nn::conv::Conv2d;
use burn::nn::{Linear, LinearConfig};
use burn::tensor::{Device, Tensor};
use normalight_kernels::channels_first;

/// Image and mask.
const INPUT_CHANNELS: usize = 4;

/// The light calibration network: per-image features, their maximum over all images, and a
/// classifier that sees both.
#[derive(Module, Debug)]
pub struct LightNetwork {
    features: Features,
    classifier: Classifier,
    hidden: Linear,
    output: Linear,
    /// Weights of the operations, in a network that is searched.
    relaxation: Option<Relaxation>,
}

#[derive(Module, Debug)]
enum Features {
    Plain(PlainFeatures),
    Cells(CellFeatures),
    Staged(Vec<StageLayers>),
}

#[derive(Module, Debug)]
struct PlainFeatures {
    convolutions: Vec<Conv2d>,
}

#[derive(Module, Debug)]
struct CellFeatures {
    stem: Vec<Conv2d>,
    cells: Vec<CellLayer>,
}

#[derive(Module, Debug)]
enum Classifier {
    Plain(PlainFeatures),
    Cells(CellClassifier),
    Staged(Vec<StageLayers>),
}

#[derive(Module, Debug)]
struct CellClassifier {
    before: Vec<Conv2d>,
    cells: Vec<CellLayer>,
    after: Vec<Conv2d>,
}

impl PlainFeatures {
    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        convolve_row(&self.convolutions, input)
    }
}

impl LightNetwork {
    /// Builds the network with random weights; `folded` builds the form that is stored, without
    /// normalisation layers.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn new(
        architecture: &LightArchitecture,
        folded: bool,
        device: &Device,
    ) -> Result<Self, ModelError> {
        architecture.validate()?;
        let form = if folded { Form::Folded } else { Form::Affine };
        let layers = match &architecture.body {
            LightBody::Staged(staged) => {
                staged_layers(staged, architecture.input_size, form, device)
            }
            LightBody::Plain(plain) => plain_layers(plain, architecture.input_size, device),
            LightBody::Cells(cells) => {
                let plans = cells.genotype.required()?.cells().map(CellPlan::Chosen);
                cell_layers(cells, plans, architecture.input_size, form, device)
            }
        };
        Ok(Self::with_heads(architecture, layers, None, device))
    }

    /// Builds the network of a search: cells with all edges and operations of the space instead of those of
    /// the architecture's genotype.
    ///
    /// # Errors
    /// [`ModelError::Architecture`], also for a plain network.
    pub fn relaxed(
        architecture: &LightArchitecture,
        space: &SearchSpace,
        device: &Device,
    ) -> Result<Self, ModelError> {
        architecture.validate()?;
        let LightBody::Cells(cells) = &architecture.body else {
            return Err(ModelError::no_cells());
        };
        space.validate_for(cells.width)?;
        let plans = [0, 1, 2, 3].map(|cell| CellPlan::Relaxed(space, cell));
        let side = architecture.input_size;
        let layers = cell_layers(cells, plans, side, Form::Relaxed, device);
        let count = LightGenotype::CELLS.len();
        let relaxation = Relaxation::new(space, count, device);
        Ok(Self::with_heads(
            architecture,
            layers,
            Some(relaxation),
            device,
        ))
    }

    fn with_heads(
        architecture: &LightArchitecture,
        (features, classifier, flat, hidden): (Features, Classifier, usize, usize),
        relaxation: Option<Relaxation>,
        device: &Device,
    ) -> Self {
        let bins = &architecture.bins;
        let classes = bins.classes();
        Self {
            features,
            classifier,
            hidden: LinearConfig::new(flat, hidden).init(device),
            output: LinearConfig::new(hidden, classes).init(device),
            relaxation,
        }
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

    /// Features of every image by itself.
    ///
    /// # Shapes
    /// - input: `[images, size, size, 4]`: RGB divided by the stack's mean, and the mask
    /// - output: `[images, height, width, channels]`
    pub fn features(&self, input: Tensor<4>) -> Tensor<4> {
        match &self.features {
            Features::Plain(plain) => plain.forward(input),
            Features::Staged(stages) => forward_stages(stages, input),
            Features::Cells(cells) => self.row(&cells.cells, convolve_row(&cells.stem, input)),
        }
    }

    /// Class scores (before softmax): azimuth, elevation and intensity side by side.
    ///
    /// # Shapes
    /// - own: `[images, height, width, channels]`
    /// - fused: the maximum over the images of one stack, repeated for each: the same shape
    /// - output: `[images, classes]`
    pub fn classify(&self, own: Tensor<4>, fused: Tensor<4>) -> Tensor<2> {
        let both = Tensor::cat(vec![own, fused], 3);
        let last = match &self.classifier {
            Classifier::Plain(plain) => plain.forward(both),
            Classifier::Staged(stages) => forward_stages(stages, both),
            Classifier::Cells(cells) => {
                let row = self.row(&cells.cells, convolve_row(&cells.before, both));
                convolve_row(&cells.after, row)
            }
        };
        // Weights files have the hidden layer's inputs in this order.
        let flat = channels_first(last).flatten::<2>(1, 3);
        let hidden = leaky(self.hidden.forward(flat));
        self.output.forward(hidden)
    }

    /// The same function with every normalisation layer folded into its convolution.
    pub fn folded(&self) -> Self {
        let fold = |cells: &[CellLayer]| cells.iter().map(CellLayer::folded).collect();
        let mut network = self.clone();
        match &mut network.features {
            Features::Plain(_) => {}
            Features::Cells(features) => features.cells = fold(&features.cells),
            Features::Staged(stages) => *stages = folded_stages(stages),
        }
        match &mut network.classifier {
            Classifier::Plain(_) => {}
            Classifier::Cells(classifier) => classifier.cells = fold(&classifier.cells),
            Classifier::Staged(stages) => *stages = folded_stages(stages),
        }
        network
    }
}

fn staged_layers(
    staged: &StagedLight,
    input_size: usize,
    form: Form,
    device: &Device,
) -> (Features, Classifier, usize, usize) {
    let row = |width: usize, stages: &[Stage], how: ([Resize; 2], bool)| {
        stage_row(width, stages, how, form, device)
    };
    let features = row(INPUT_CHANNELS, &staged.features, ([Resize::Halve; 2], true));
    let both = 2 * staged.features.last().map_or(0, |stage| stage.width);
    let classifier = row(
        both,
        &staged.classifier,
        ([Resize::Keep, Resize::Halve], false),
    );
    (
        Features::Staged(features),
        Classifier::Staged(classifier),
        staged.last(input_size).1,
        staged.hidden,
    )
}

fn plain_layers(
    plain: &PlainLight,
    input_size: usize,
    device: &Device,
) -> (Features, Classifier, usize, usize) {
    let [a, b, c] = plain.widths;
    let features = [
        ([INPUT_CHANNELS, a], 2),
        ([a, b], 2),
        ([b, b], 1),
        ([b, c], 2),
        ([c, c], 1),
    ];
    let classifier = [([2 * c, c], 1), ([c, c], 2), ([c, c], 2)];
    let build = |layers: &[([usize; 2], usize)]| PlainFeatures {
        convolutions: layers
            .iter()
            .map(|&(channels, stride)| convolution(channels, 3, stride, device))
            .collect(),
    };
    let side = input_size / 32;
    (
        Features::Plain(build(&features)),
        Classifier::Plain(build(&classifier)),
        c * side * side,
        plain.hidden,
    )
}

fn cell_layers(
    cells: &CellLight,
    [normal, reduction, classifier_normal, classifier_reduction]: [CellPlan; 4],
    input_size: usize,
    form: Form,
    device: &Device,
) -> (Features, Classifier, usize, usize) {
    let width = cells.width;
    let stem_channels = 3 * width;
    let stem = vec![
        convolution(
            [INPUT_CHANNELS, 2 * width],
            3,
            cells.stem_strides[0],
            device,
        ),
        convolution([2 * width, stem_channels], 3, cells.stem_strides[1], device),
    ];
    let mut row = CellRow::new(stem_channels, width, form, device);
    let features = row.features(normal, reduction, cells.reductions);
    let before = vec![
        convolution([2 * row.last, 4 * width], 3, 1, device),
        convolution([4 * width, stem_channels], 3, 1, device),
    ];
    let mut classifier_row = CellRow::new(stem_channels, width, form, device);
    let classifier = vec![
        classifier_row.normal(classifier_normal),
        classifier_row.reduction(classifier_reduction),
    ];
    let after = vec![
        convolution([classifier_row.last, 4 * width], 3, 2, device),
        convolution([4 * width, 4 * width], 3, 1, device),
    ];
    // Besides the reductions in the features one in the classifier and one stride after it.
    let stem_stride: usize = cells.stem_strides.iter().product();
    let side = (input_size / stem_stride).div_ceil(4 << cells.reductions);
    (
        Features::Cells(CellFeatures {
            stem,
            cells: features,
        }),
        Classifier::Cells(CellClassifier {
            before,
            cells: classifier,
            after,
        }),
        4 * width * side * side,
        cells.hidden,
    )
}
