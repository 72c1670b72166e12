use burn::tensor::Device;
use normalight_model::{
    Cell, Genotypes, LightGenotype, LightNetwork, NormalGenotype, NormalNetwork, Relaxation,
    SearchSpace,
};
use normalight_train::{LightTask, NormalTask, NormalTraining, Task, TrainError};

/// What is particular to the search of one of the networks.
pub(super) trait SearchTask: Task {
    /// Names of its cells.
    const CELLS: &'static [&'static str];

    /// The relaxed network with random weights.
    fn relaxed(&self, space: &SearchSpace, device: &Device) -> Result<Self::Network, TrainError>;

    /// The architecture's parameters.
    fn relaxation(network: &Self::Network) -> &Relaxation;

    /// The same, to change them.
    fn relaxation_mut(network: &mut Self::Network) -> &mut Relaxation;

    /// The genotype file of its cells, in the order of their names.
    fn genotypes(source: String, cells: Vec<Cell>) -> Genotypes;
}

/// For networks that `relaxed` made.
const RELAXED: &str = "a relaxed network has a relaxation";
/// For cells of which there are as many as names.
const AS_MANY: &str = "as many cells as names";

impl SearchTask for LightTask {
    const CELLS: &'static [&'static str] = &LightGenotype::CELLS;

    fn relaxed(&self, space: &SearchSpace, device: &Device) -> Result<LightNetwork, TrainError> {
        Ok(LightNetwork::relaxed(
            &self.settings().architecture,
            space,
            device,
        )?)
    }

    fn relaxation(network: &LightNetwork) -> &Relaxation {
        network.relaxation().expect(RELAXED)
    }

    fn relaxation_mut(network: &mut LightNetwork) -> &mut Relaxation {
        network.relaxation_mut().expect(RELAXED)
    }

    fn genotypes(source: String, cells: Vec<Cell>) -> Genotypes {
        let cells = cells.try_into().expect(AS_MANY);
        Genotypes {
            source,
            light: Some(LightGenotype::from_cells(cells)),
            normal: None,
        }
    }
}

impl SearchTask for NormalTask {
    const CELLS: &'static [&'static str] = &NormalGenotype::CELLS;

    fn relaxed(&self, space: &SearchSpace, device: &Device) -> Result<NormalTraining, TrainError> {
        let network = NormalNetwork::relaxed(&self.settings().architecture, space, device)?;
        Ok(NormalTraining::new(network, self.settings(), device))
    }

    fn relaxation(training: &NormalTraining) -> &Relaxation {
        training.network.relaxation().expect(RELAXED)
    }

    fn relaxation_mut(training: &mut NormalTraining) -> &mut Relaxation {
        training.network.relaxation_mut().expect(RELAXED)
    }

    fn genotypes(source: String, cells: Vec<Cell>) -> Genotypes {
        let cells = cells.try_into().expect(AS_MANY);
        Genotypes {
            source,
            light: None,
            normal: Some(NormalGenotype::from_cells(cells)),
        }
    }
}
