//! From a recipe to batches of samples.
use crate::batch::Batch;
use crate::predicted::{Prediction, Predictor};
use crate::source::Source;
use crate::task::Task;
use crate::{TrainError, TrainRecipe};
use normalight_run::BatchMaker;
use normalight_synth::{Framing, Sample, Scene};
use std::sync::Arc;

/// Makes the batches of one network's training.
pub struct SampleMaker<T> {
    task: T,
    recipe: Arc<TrainRecipe>,
    source: Arc<Source>,
    predictor: Option<Predictor>,
    /// Number of the group of scenes in hand: as many as a batch has samples, so that the samples of a
    /// batch are of different scenes while each scene gives several.
    group: Option<usize>,
    scenes: Vec<(Scene, Option<Prediction>)>,
}

/// Number of the first scene of a step's batch; the others follow it.
pub fn first_scene(recipe: &TrainRecipe, framing: Framing, step: usize) -> u64 {
    match framing {
        Framing::WholeObject => seed(recipe, step, 0),
        Framing::Crop => seed(recipe, step / recipe.scene.sampling.crops_per_scene, 0),
    }
}

fn seed(recipe: &TrainRecipe, major: usize, minor: usize) -> u64 {
    (recipe.seed << 44) + (major * recipe.batch + minor) as u64
}

impl<T: Task> SampleMaker<T> {
    /// `predictor`: for a recipe that asks for predicted lights.
    pub fn new(
        task: T,
        recipe: &TrainRecipe,
        source: &Arc<Source>,
        predictor: Option<Predictor>,
    ) -> Self {
        Self {
            task,
            recipe: Arc::new(recipe.clone()),
            source: Arc::clone(source),
            predictor,
            group: None,
            scenes: Vec::new(),
        }
    }

    fn scene(&self, number: u64, images: usize) -> Result<Scene, TrainError> {
        let recipe = &self.recipe;
        self.source.scene(recipe, number, images, T::FRAMING)
    }

    /// Sample `k` of a step, and the lights that a network predicts for it.
    fn sample(
        &mut self,
        step: usize,
        k: usize,
        images: usize,
    ) -> Result<(Sample, Option<Vec<normalight_core::Light>>), TrainError> {
        let recipe = Arc::clone(&self.recipe);
        if T::FRAMING == Framing::WholeObject {
            let scene = self.scene(seed(&recipe, step, k), images)?;
            return Ok((scene.whole(images), None));
        }
        let parts = recipe.scene.sampling.crops_per_scene;
        let group = step / parts;
        if self.group != Some(group) {
            // Before the new scenes take their memory.
            self.scenes.clear();
            for k in 0..recipe.batch {
                let scene = self.scene(seed(&recipe, group, k), recipe.images[1])?;
                let predict = self.predictor.as_mut().map(|one| one.predict(&scene));
                self.scenes.push((scene, predict.transpose()?));
            }
            self.group = Some(group);
        }
        let (scene, prediction) = &self.scenes[k];
        let sample = scene.crop(step % parts, images);
        let predicted = prediction.as_ref().map(|one| one.lights(&sample));
        Ok((sample, predicted))
    }
}

impl<T: Task> BatchMaker for SampleMaker<T> {
    type Batch = Batch;
    type Error = TrainError;

    fn for_thread(&self) -> Self {
        Self::new(
            self.task.clone(),
            &self.recipe,
            &self.source,
            self.predictor.clone(),
        )
    }

    fn together(&self) -> usize {
        match T::FRAMING {
            Framing::WholeObject => 1,
            Framing::Crop => self.recipe.scene.sampling.crops_per_scene,
        }
    }

    fn make(&mut self, step: usize) -> Result<Batch, TrainError> {
        let recipe = Arc::clone(&self.recipe);
        let [fewest, most] = recipe.images;
        // A cheap scramble of the step: any fixed order of counts would do.
        let images = fewest + step.wrapping_mul(2_654_435_761) / 7 % (most - fewest + 1);
        let mut batch = Batch {
            samples: 0,
            images,
            size: recipe.size,
            channels: self.task.channels(),
            input: Vec::new(),
            target: Vec::new(),
        };
        for k in 0..recipe.batch {
            let (sample, predicted) = self.sample(step, k, images)?;
            if sample.lights.len() != images || sample.size != recipe.size {
                return Err(TrainError::Sample {
                    found: [sample.lights.len(), sample.size],
                    expected: [images, recipe.size],
                });
            }
            let seed = seed(&recipe, step, k);
            self.task
                .append(&sample, predicted.as_deref(), seed, &mut batch);
            batch.samples += 1;
        }
        Ok(batch)
    }
}
