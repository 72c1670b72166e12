use crate::batch::Batch;
use crate::{NetworkRecipe, TrainError};
use burn::module::Module;
use burn::tensor::{Device, Tensor};
use normalight_core::Light;
use normalight_model::Weights;
use normalight_run::Validation;
use normalight_synth::{Framing, Sample};

/// What is particular to the training of one of the networks, with its settings.
pub trait Task: Clone + Send + Sync + 'static {
    /// The network being trained, with whatever helps it while it is.
    type Network: Module + std::fmt::Debug + 'static;

    /// That of a recipe, if it trains this network.
    fn of(network: &NetworkRecipe) -> Option<Self>;

    /// A network with random weights.
    fn network(&self, device: &Device) -> Result<Self::Network, TrainError>;

    /// Puts the values of a weights file into a network.
    fn start_from(
        &self,
        network: Self::Network,
        weights: &Weights,
        device: &Device,
    ) -> Result<Self::Network, TrainError>;

    /// The network of a weights file, for validation: layers without normalisation, and nothing that only helps training.
    ///
    /// # Errors
    /// Another network or architecture than the recipe's.
    fn stored(&self, weights: &Weights, device: &Device) -> Result<Self::Network, TrainError>;

    /// What the network is shown: whole objects or crops.
    const FRAMING: Framing;

    /// Adds a sample to a batch. `predicted`: its lights as a light network sees them.
    fn append(&self, sample: &Sample, predicted: Option<&[Light]>, seed: u64, batch: &mut Batch);

    /// Input channels of the network.
    fn channels(&self) -> usize;

    /// Loss of a batch: `[1]`.
    fn loss(&self, network: &Self::Network, batch: &Batch, device: &Device) -> Tensor<1>;

    /// Weight of a part of a batch in the loss of the whole: the number of things its loss is a mean over.
    fn weight(part: &Batch) -> f32;

    /// Errors on whole unseen objects, through the pipeline that users run.
    fn validate(
        &self,
        network: &Self::Network,
        objects: &[Sample],
        device: &Device,
    ) -> Result<Validation, TrainError>;

    /// The weights file of a network.
    fn bytes(&self, network: &Self::Network) -> Result<Vec<u8>, TrainError>;
}
