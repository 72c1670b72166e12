//! A batch divided among devices.

use crate::batch::Batch;
use crate::task::Task;

/// The samples of a batch in up to `count` parts of nearly the same size, none empty.
pub(super) fn divided(batch: &Batch, count: usize) -> Vec<Batch> {
    let count = count.min(batch.samples);
    let part = |index: usize| {
        let [from, to] = [index, index + 1].map(|border| border * batch.samples / count);
        let of = |values: &[f32]| {
            let each = values.len() / batch.samples;
            values[from * each..to * each].to_vec()
        };
        Batch {
            samples: to - from,
            images: batch.images,
            size: batch.size,
            channels: batch.channels,
            input: of(&batch.input),
            target: of(&batch.target),
        }
    };
    (0..count).map(part).collect()
}

/// Parts with their share of the whole loss. Parts without any (crops beside the object) are left
/// out: their own loss is 0/0.
pub(super) fn shares<T: Task>(parts: Vec<Batch>) -> Vec<(Batch, f32)> {
    let weights: Vec<f32> = parts.iter().map(T::weight).collect();
    let whole: f32 = weights.iter().sum();
    let shares = weights.iter().map(|weight| weight / whole);
    // Where no part has any, all stay, and the loss is no number, as on one device.
    let some = |(_, share): &(Batch, f32)| *share != 0.0;
    parts.into_iter().zip(shares).filter(some).collect()
}
