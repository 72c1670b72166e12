//! Parts of a training step by themselves, for measuring their speed.
use crate::normal_task::NormalTask;
use crate::samples::SampleMaker;
use crate::source::Source;
use crate::task::Task;
use crate::{NetworkRecipe, TrainError, TrainRecipe};
use burn::module::Module;
use burn::tensor::Gradients;
use normalight_run::{BatchMaker, Optimiser, OptimiserRecipe, RunError, StepsOn};
use std::sync::Arc;

/// The optimiser as training uses it.
#[derive(Debug)]
pub struct OptimiserStep {
    optimiser: Optimiser,
    recipe: OptimiserRecipe,
}

impl OptimiserStep {
    /// Before its first step.
    pub fn new(recipe: OptimiserRecipe) -> Self {
        Self {
            optimiser: Optimiser::new(StepsOn::Host),
            recipe,
        }
    }

    /// Gradients to the host, clipping, the step, weights back to the device.
    pub fn take<M: Module>(&mut self, network: M, gradients: &Gradients) -> M {
        let gradients = self.optimiser.gradients(&network, gradients);
        let rate = self.recipe.learning_rate;
        self.optimiser.step(network, gradients, rate, &self.recipe)
    }
}

/// Samples of a normal network's recipe as training gets them, on the calling thread.
pub struct SampleSource {
    maker: SampleMaker<NormalTask>,
    steps: std::ops::RangeFrom<usize>,
}

impl SampleSource {
    /// # Errors
    /// What is wrong with the recipe or its files.
    pub fn new(recipe: &TrainRecipe) -> Result<Self, TrainError> {
        recipe.validate()?;
        let NetworkRecipe::Normal(settings) = &recipe.network else {
            return Err(TrainError::Run(RunError::Value {
                field: "network",
                found: recipe.network.kind().name().to_owned(),
                expected: "normal",
            }));
        };
        let source = Arc::new(Source::open(recipe, NormalTask::FRAMING)?);
        Ok(Self {
            maker: SampleMaker::new(NormalTask::new(settings), recipe, &source, None),
            steps: 0..,
        })
    }

    /// Makes the batches of all steps that share their scenes; returns the number of samples.
    ///
    /// # Errors
    /// Files that cannot be read.
    pub fn group(&mut self) -> Result<usize, TrainError> {
        let mut samples = 0;
        for step in self.steps.by_ref().take(self.maker.together()) {
            samples += self.maker.make(step)?.samples;
        }
        Ok(samples)
    }
}
