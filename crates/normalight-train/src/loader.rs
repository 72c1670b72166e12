use crate::batch::Batch;
use crate::task::Task;
use crate::{TrainError, TrainRecipe};
use normalight_synth::{Framing, Renderer, Sample, Scene};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

/// Batches rendered ahead.
const AHEAD: usize = 6;

/// Seeds of validation objects start here, far from any training object.
const VALIDATION_SEEDS: u64 = 1 << 40;

/// Renders the batches of the steps from `first` on, on a thread of its own.
///
/// Batch `k` is the same whatever was rendered before, so that a resumed run sees the samples that
/// an uninterrupted one would have seen.
pub(crate) fn start<T: Task>(
    recipe: &TrainRecipe,
    renderer: &Arc<Renderer>,
    first: usize,
) -> Receiver<Batch> {
    let (sender, receiver) = sync_channel(AHEAD);
    let (recipe, renderer) = (recipe.clone(), Arc::clone(renderer));
    std::thread::spawn(move || {
        let mut source = Source::new(&recipe, &renderer, T::FRAMING);
        for step in first..recipe.steps {
            // The receiver is gone when training stopped: nothing left to do.
            if sender.send(batch::<T>(&recipe, &mut source, step)).is_err() {
                return;
            }
        }
    });
    receiver
}

/// The samples of a run in their order.
struct Source<'a> {
    recipe: &'a TrainRecipe,
    renderer: &'a Renderer,
    framing: Framing,
    /// Number of the group of scenes in hand: as many as a batch has samples, so that the samples of a
    /// batch are of different scenes while each scene gives several.
    group: Option<usize>,
    scenes: Vec<Scene>,
}

impl<'a> Source<'a> {
    fn new(recipe: &'a TrainRecipe, renderer: &'a Renderer, framing: Framing) -> Self {
        Self {
            recipe,
            renderer,
            framing,
            group: None,
            scenes: Vec::new(),
        }
    }

    /// Sample `k` of a step.
    fn sample(&mut self, step: usize, k: usize, images: usize) -> Sample {
        let (recipe, renderer) = (self.recipe, self.renderer);
        if self.framing == Framing::WholeObject {
            let scene = renderer.whole_scene(seed(recipe, step, k), images, recipe.size);
            return scene.whole(images);
        }
        let parts = renderer.recipe().sampling.crops_per_scene;
        let group = step / parts;
        if self.group != Some(group) {
            let most = recipe.images[1];
            self.scenes = (0..recipe.batch)
                .map(|k| renderer.crop_scene(seed(recipe, group, k), most, recipe.size))
                .collect();
            self.group = Some(group);
        }
        self.scenes[k].crop(step % parts, images)
    }
}

fn seed(recipe: &TrainRecipe, major: usize, minor: usize) -> u64 {
    (recipe.seed << 44) + (major * recipe.batch + minor) as u64
}

fn batch<T: Task>(recipe: &TrainRecipe, source: &mut Source, step: usize) -> Batch {
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
        let sample = source.sample(step, k, images);
        T::append(recipe, &sample, seed(recipe, step, k), &mut batch);
        batch.samples += 1;
    }
    batch
}

/// The renderer of a recipe's scenes.
///
/// # Errors
/// [`TrainError::Synth`]: the files that the recipe names.
pub(crate) fn renderer(recipe: &TrainRecipe) -> Result<Arc<Renderer>, TrainError> {
    Ok(Arc::new(Renderer::new(recipe.scene.clone())?))
}

/// Whole unseen objects of 12 images each, for validation.
pub(crate) fn validation_objects(
    recipe: &TrainRecipe,
    renderer: &Renderer,
    pixels: usize,
) -> Vec<Sample> {
    (0..recipe.validation_objects as u64)
        .map(|k| renderer.sample(VALIDATION_SEEDS + k, 12, pixels, Framing::WholeObject))
        .collect()
}
