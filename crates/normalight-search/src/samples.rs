use burn::tensor::Device;
use normalight_run::BatchMaker;
use normalight_train::{Batch, Predictor, SampleMaker, Source, Task, TrainError, TrainRecipe};
use std::sync::Arc;

/// What a search takes in at one step: a batch of either half of the data.
pub(super) struct SplitBatch {
    /// For the network's weights.
    pub(super) training: Batch,
    /// For the architecture.
    pub(super) validation: Batch,
}

/// Makes them.
pub(super) struct HalvesMaker<T> {
    training: SampleMaker<T>,
    validation: SampleMaker<T>,
}

impl<T: Task> HalvesMaker<T> {
    /// Opens what the recipe names; also gives the source of the second half.
    pub(super) fn open(
        task: &T,
        recipe: &TrainRecipe,
        device: &Device,
    ) -> Result<(Self, Arc<Source>), TrainError> {
        let halves = Source::halves(recipe)?.map(Arc::new);
        let predictor = Predictor::of(recipe, device)?;
        let [training, validation] = halves
            .each_ref()
            .map(|half| SampleMaker::new(task.clone(), recipe, half, predictor.clone()));
        let [_, second] = halves;
        let maker = Self {
            training,
            validation,
        };
        Ok((maker, second))
    }
}

impl<T: Task> BatchMaker for HalvesMaker<T> {
    type Batch = SplitBatch;
    type Error = TrainError;

    fn for_thread(&self) -> Self {
        Self {
            training: self.training.for_thread(),
            validation: self.validation.for_thread(),
        }
    }

    fn together(&self) -> usize {
        self.training.together()
    }

    fn make(&mut self, step: usize) -> Result<SplitBatch, TrainError> {
        Ok(SplitBatch {
            training: self.training.make(step)?,
            validation: self.validation.make(step)?,
        })
    }
}
