use crate::batch::Batch;
use crate::predicted::Predicted;
use crate::{TrainError, TrainRecipe};
use burn::module::Module;
use burn::tensor::{Device, Tensor};
use normalight_model::Weights;
use normalight_synth::{Framing, Sample};
use std::collections::BTreeMap;

/// Errors on unseen objects.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Validation {
    /// Mean error in degrees; it decides which weights are the best.
    pub(crate) degrees: f32,
    /// More about it, by name.
    pub(crate) figures: BTreeMap<String, f32>,
}

/// What is particular to the training of one of the networks.
pub(crate) trait Task: Sized + 'static {
    /// The network being trained, with whatever helps it while it is.
    type Network: Module + std::fmt::Debug + 'static;

    /// A network with random weights.
    fn network(recipe: &TrainRecipe, device: &Device) -> Result<Self::Network, TrainError>;

    /// Puts the values of a weights file into a network.
    fn start_from(
        recipe: &TrainRecipe,
        network: Self::Network,
        weights: &Weights,
        device: &Device,
    ) -> Result<Self::Network, TrainError>;

    /// What the network is shown: whole objects or crops.
    const FRAMING: Framing;

    /// Adds a sample to a batch. `predicted`: what networks say about it, where the recipe asks them.
    fn append(
        recipe: &TrainRecipe,
        sample: &Sample,
        predicted: Option<&Predicted>,
        seed: u64,
        batch: &mut Batch,
    );

    /// Input channels of the network.
    fn channels(recipe: &TrainRecipe) -> usize;

    /// Loss of a batch: `[1]`.
    fn loss(
        recipe: &TrainRecipe,
        network: &Self::Network,
        batch: &Batch,
        device: &Device,
    ) -> Tensor<1>;

    /// Weight of a part of a batch in the loss of the whole: the number of things its loss is a mean over.
    fn weight(part: &Batch) -> f32;

    /// Errors on whole unseen objects, through the pipeline that users run.
    fn validate(
        recipe: &TrainRecipe,
        network: &Self::Network,
        objects: &[Sample],
        device: &Device,
    ) -> Result<Validation, TrainError>;

    /// The weights file of a network.
    fn bytes(recipe: &TrainRecipe, network: &Self::Network) -> Result<Vec<u8>, TrainError>;
}
