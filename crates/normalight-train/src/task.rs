use crate::batch::Batch;
use crate::{TrainError, TrainRecipe};
use burn::module::Module;
use burn::tensor::{Device, Tensor};
use normalight_synth::{Framing, Sample};

/// What the loop needs to know of a network.
pub(crate) trait Task: Sized {
    /// The network being trained.
    type Network: Module + std::fmt::Debug;

    /// A network with random weights.
    fn network(recipe: &TrainRecipe, device: &Device) -> Result<Self::Network, TrainError>;

    /// What the network is shown: whole objects or crops.
    const FRAMING: Framing;

    /// Adds a sample to a batch.
    fn append(recipe: &TrainRecipe, sample: &Sample, seed: u64, batch: &mut Batch);

    /// Input channels of the network.
    fn channels(recipe: &TrainRecipe) -> usize;

    /// Loss of a batch: `[1]`.
    fn loss(
        recipe: &TrainRecipe,
        network: &Self::Network,
        batch: &Batch,
        device: &Device,
    ) -> Tensor<1>;

    /// Mean error in degrees on whole unseen objects, through the pipeline that users run.
    fn validate(
        recipe: &TrainRecipe,
        network: &Self::Network,
        objects: &[Sample],
        device: &Device,
    ) -> Result<f32, TrainError>;

    /// The weights file of a network.
    fn bytes(recipe: &TrainRecipe, network: &Self::Network) -> Result<Vec<u8>, TrainError>;
}
