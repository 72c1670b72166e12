use crate::TrainRecipe;
use crate::batch::Batch;
use crate::task::Task;
use normalight_synth::{Framing, Sample, render_sample};
use std::sync::mpsc::{Receiver, sync_channel};

/// Batches rendered ahead.
const AHEAD: usize = 6;

/// Seeds of validation objects start here, far from any training object.
const VALIDATION_SEEDS: u64 = 1 << 40;

/// Renders the batches of the steps from `first` on, on a thread of its own.
///
/// Batch `k` is the same whatever was rendered before, so that a resumed run sees the samples that
/// an uninterrupted one would have seen.
pub(crate) fn start<T: Task>(recipe: &TrainRecipe, first: usize) -> Receiver<Batch> {
    let (sender, receiver) = sync_channel(AHEAD);
    let recipe = recipe.clone();
    std::thread::spawn(move || {
        for step in first..recipe.steps {
            // The receiver is gone when training stopped: nothing left to do.
            if sender.send(batch::<T>(&recipe, step)).is_err() {
                return;
            }
        }
    });
    receiver
}

fn seed(recipe: &TrainRecipe, major: usize, minor: usize) -> u64 {
    (recipe.seed << 44) + (major * recipe.batch + minor) as u64
}

fn batch<T: Task>(recipe: &TrainRecipe, step: usize) -> Batch {
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
        let seed = seed(recipe, step, k);
        let sample = render_sample(&recipe.scene, seed, images, recipe.size, T::FRAMING);
        T::append(recipe, &sample, seed, &mut batch);
        batch.samples += 1;
    }
    batch
}

/// Whole unseen objects of 12 images each, for validation.
pub(crate) fn validation_objects(recipe: &TrainRecipe, pixels: usize) -> Vec<Sample> {
    (0..recipe.validation_objects as u64)
        .map(|k| {
            let seed = VALIDATION_SEEDS + k;
            render_sample(&recipe.scene, seed, 12, pixels, Framing::WholeObject)
        })
        .collect()
}
