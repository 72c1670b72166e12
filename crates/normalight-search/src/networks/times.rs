//! The time of each candidate, where time is what should be small.
use super::halving::{NetworkSearchEvent, Observe};
use super::recipe::{IMAGES, NetworkSearchRecipe};
use super::space::Candidate;
use crate::folder::Folder;
use burn::tensor::{Device, Tensor};
use normalight_model::{LightNetwork, NormalNetwork};
use normalight_run::seeded;
use normalight_train::{NetworkRecipe, TrainError, TrainRecipe};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::time::Instant;

const TIMES: &str = "times.json";
/// Side in pixels of the pictures that the time of a normal network is measured with.
const SIDE: usize = 128;
/// Measurements, of which the shortest counts, in turns over the candidates.
const TIMED: usize = 5;

/// Microseconds by the candidate's number.
pub(super) type Times = BTreeMap<usize, u64>;

/// Those that the folder keeps.
pub(super) fn kept(folder: &Folder) -> Result<Option<Times>, TrainError> {
    folder.read_json(TIMES)
}

/// New ones, which the folder then keeps; `Break` when it was stopped.
pub(super) fn measured(
    folder: &Folder,
    candidates: &[Candidate],
    recipe: &NetworkSearchRecipe,
    device: &Device,
    observe: Observe<'_>,
) -> Result<ControlFlow<(), Times>, TrainError> {
    let mut shortest = Times::new();
    for turn in 1..=TIMED {
        let note = format!(
            "measures the time of {} networks, {turn} of {TIMED}",
            candidates.len()
        );
        if observe(NetworkSearchEvent::Note(note)).is_break() {
            return Ok(ControlFlow::Break(()));
        }
        for (place, candidate) in candidates.iter().enumerate() {
            let took = microseconds(&candidate.trained_as(&recipe.training)?, device)?;
            let best = shortest.entry(place + 1).or_insert(u64::MAX);
            *best = (*best).min(took);
        }
    }
    folder.write_json(TIMES, &shortest)?;
    Ok(ControlFlow::Continue(shortest))
}

/// Microseconds of a network for ten images, as it is stored: random weights take as long as any.
fn microseconds(recipe: &TrainRecipe, device: &Device) -> Result<u64, TrainError> {
    let white =
        |side: usize, channels: usize| Tensor::<4>::ones([IMAGES, side, side, channels], device);
    let timed = |work: &dyn Fn() -> f32| {
        // Buffers are made the first time.
        work();
        let start = Instant::now();
        let sum = work();
        // Reading a number back waits for the device.
        std::hint::black_box(sum);
        start.elapsed().as_micros() as u64
    };
    Ok(match &recipe.network {
        NetworkRecipe::Normal(settings) => {
            let network = seeded(device, recipe.seed, || {
                NormalNetwork::new(&settings.architecture, true, device)
            })?;
            let input = white(SIDE, settings.architecture.input_channels());
            timed(&|| {
                network
                    .regress(network.fuse(input.clone(), 1))
                    .sum()
                    .into_scalar()
            })
        }
        NetworkRecipe::Light(settings) => {
            let network = seeded(device, recipe.seed, || {
                LightNetwork::new(&settings.architecture, true, device)
            })?;
            let input = white(settings.architecture.input_size, 4);
            timed(&|| {
                let own = network.features(input.clone());
                let fused = own.clone().max_dim(0).expand(own.dims());
                network.classify(own, fused).sum().into_scalar()
            })
        }
    })
}
