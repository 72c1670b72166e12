//! Steps of a search by themselves, for measuring their speed.
use super::learner::SearchLearner;
use super::samples::{HalvesMaker, SplitBatch};
use super::{SearchRecipe, SearchTask};
use burn::tensor::Device;
use normalight_run::{BatchMaker, Learner, StepsOn};
use normalight_train::{LightTask, NetworkRecipe, NormalTask, TrainError};
use std::time::{Duration, Instant};

/// A search that takes steps on batches made beforehand.
pub struct SearchStep<'a> {
    step: Box<dyn FnMut() -> Result<(), TrainError> + 'a>,
    parameters: usize,
    data: Duration,
}

impl<'a> SearchStep<'a> {
    /// Makes network and batches. `device`: a plain one.
    ///
    /// # Errors
    /// What is wrong with the recipe or its files.
    pub fn new(recipe: &'a SearchRecipe, device: &'a Device) -> Result<Self, TrainError> {
        recipe.validate()?;
        match &recipe.training.network {
            NetworkRecipe::Light(settings) => Self::of(LightTask::new(settings), recipe, device),
            NetworkRecipe::Normal(settings) => Self::of(NormalTask::new(settings), recipe, device),
        }
    }

    fn of<T: SearchTask>(
        task: T,
        recipe: &'a SearchRecipe,
        device: &'a Device,
    ) -> Result<Self, TrainError> {
        let mut learner = SearchLearner::new(task.clone(), recipe, device, StepsOn::Host)?;
        let (mut maker, _) = HalvesMaker::open(&task, &recipe.training, device)?;
        let start = Instant::now();
        let batches: Vec<SplitBatch> = (0..maker.together())
            .map(|step| maker.make(step))
            .collect::<Result<_, _>>()?;
        let data = start.elapsed() / batches.len() as u32;
        let parameters = learner.parameters();
        let mut step = 0;
        let step = move || {
            learner.learn(&batches[step % batches.len()], step)?;
            step += 1;
            Ok(())
        };
        Ok(Self {
            step: Box::new(step),
            parameters,
            data,
        })
    }

    /// Takes a step.
    ///
    /// # Errors
    /// Of the device.
    pub fn take(&mut self) -> Result<(), TrainError> {
        (self.step)()
    }

    /// Number of weights of the relaxed network.
    pub fn parameters(&self) -> usize {
        self.parameters
    }

    /// How long one thread made the samples of a step.
    pub fn data(&self) -> Duration {
        self.data
    }
}
