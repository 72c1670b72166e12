use crate::batch::Batch;
use crate::source::Source;
use crate::task::Task;
use crate::{TrainError, TrainRecipe};
use normalight_synth::{Framing, Sample, Scene};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

/// Batches made ahead.
const AHEAD: usize = 6;

/// Makes the batches of the steps from `first` on, on a thread of its own; the first error ends it.
///
/// Batch `k` is the same whatever was made before, so that a resumed run sees the samples that an
/// uninterrupted one would have seen.
pub(crate) fn start<T: Task>(
    recipe: &TrainRecipe,
    source: &Arc<Source>,
    first: usize,
) -> Receiver<Result<Batch, TrainError>> {
    let (sender, receiver) = sync_channel(AHEAD);
    let (recipe, source) = (recipe.clone(), Arc::clone(source));
    std::thread::spawn(move || {
        let mut samples = Samples::new(&recipe, &source, T::FRAMING);
        for step in first..recipe.steps {
            let batch = batch::<T>(&recipe, &mut samples, step);
            let failed = batch.is_err();
            // The receiver is gone when training stopped: nothing left to do.
            if sender.send(batch).is_err() || failed {
                return;
            }
        }
    });
    receiver
}

/// The samples of a run in their order.
struct Samples<'a> {
    recipe: &'a TrainRecipe,
    source: &'a Source,
    framing: Framing,
    /// Number of the group of scenes in hand: as many as a batch has samples, so that the samples of a
    /// batch are of different scenes while each scene gives several.
    group: Option<usize>,
    scenes: Vec<Scene>,
}

impl<'a> Samples<'a> {
    fn new(recipe: &'a TrainRecipe, source: &'a Source, framing: Framing) -> Self {
        Self {
            recipe,
            source,
            framing,
            group: None,
            scenes: Vec::new(),
        }
    }

    /// Sample `k` of a step.
    fn get(&mut self, step: usize, k: usize, images: usize) -> Result<Sample, TrainError> {
        let recipe = self.recipe;
        let scene = |number: u64, images: usize| {
            let (source, framing) = (self.source, self.framing);
            source.scene(recipe, number, images, recipe.size, framing)
        };
        if self.framing == Framing::WholeObject {
            return Ok(scene(seed(recipe, step, k), images)?.whole(images));
        }
        let parts = recipe.scene.sampling.crops_per_scene;
        let group = step / parts;
        if self.group != Some(group) {
            let scenes = (0..recipe.batch).map(|k| scene(seed(recipe, group, k), recipe.images[1]));
            self.scenes = scenes.collect::<Result<_, _>>()?;
            self.group = Some(group);
        }
        Ok(self.scenes[k].crop(step % parts, images))
    }
}

fn seed(recipe: &TrainRecipe, major: usize, minor: usize) -> u64 {
    (recipe.seed << 44) + (major * recipe.batch + minor) as u64
}

fn batch<T: Task>(
    recipe: &TrainRecipe,
    samples: &mut Samples,
    step: usize,
) -> Result<Batch, TrainError> {
    let [fewest, most] = recipe.images;
    // A cheap scramble of the step: any fixed order of counts would do.
    let images = fewest + step.wrapping_mul(2_654_435_761) / 7 % (most - fewest + 1);
    let mut batch = Batch {
        samples: 0,
        images,
        size: recipe.size,
        channels: T::channels(recipe),
        input: Vec::new(),
        target: Vec::new(),
    };
    for k in 0..recipe.batch {
        let sample = samples.get(step, k, images)?;
        if sample.lights.len() != images || sample.size != recipe.size {
            return Err(TrainError::Sample {
                found: [sample.lights.len(), sample.size],
                expected: [images, recipe.size],
            });
        }
        T::append(recipe, &sample, seed(recipe, step, k), &mut batch);
        batch.samples += 1;
    }
    batch.finish();
    Ok(batch)
}
