//! What several devices compute together against what one does alone.
use super::*;
use crate::light_task::LightTask;
use crate::normal_task::NormalTask;
use crate::samples::SampleMaker;
use crate::source::Source;
use crate::{NormalSettings, TrainRecipe};
use normalight_model::{CellNormal, Genotypes, NormalBody, Upsampling};
use normalight_run::host;
use normalight_run::{BatchMaker, Optimiser, StepGradients, StepsOn, seeded};
use std::sync::Arc;

/// A main device, and another of a different kind: what belongs to one cannot be used on the other.
#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
fn devices() -> [Device; 2] {
    [Device::flex().autodiff(), Device::ndarray().autodiff()]
}

/// An odd number of samples, so that parts differ in size.
fn recipe(network: &str, size: usize) -> TrainRecipe {
    let text =
        format!("network = \"{network}\"\nsteps = 3\nsize = {size}\nbatch = 5\nimages = [3, 4]\n");
    TrainRecipe::parse("recipe.toml", &text).unwrap()
}

fn batches<T: Task>(task: &T, recipe: &TrainRecipe) -> Vec<Batch> {
    let source = Arc::new(Source::open(recipe, T::FRAMING).unwrap());
    let mut maker = SampleMaker::new(task.clone(), recipe, &source, None);
    (0..recipe.steps)
        .map(|step| maker.make(step).unwrap())
        .collect()
}

/// The gradient of every weight, or the weights themselves.
struct Values<'a>(Option<&'a Gradients>, Vec<Vec<f32>>);

impl ModuleVisitor for Values<'_> {
    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        let values = match self.0 {
            Some(gradients) => param.val().grad(gradients),
            None => Some(param.val()),
        };
        self.1.push(values.map_or(Vec::new(), host));
    }
}

fn values<M: Module>(network: &M, gradients: Option<&Gradients>) -> Vec<Vec<f32>> {
    let mut values = Values(gradients, Vec::new());
    network.visit(&mut values);
    values.1
}

/// Distance of two lists relative to the second one's length.
fn apart(one: &[f32], two: &[f32]) -> f32 {
    assert_eq!(one.len(), two.len());
    let norm = |values: &mut dyn Iterator<Item = f32>| values.map(|v| v * v).sum::<f32>().sqrt();
    norm(&mut one.iter().zip(two).map(|(a, b)| a - b)) / norm(&mut two.iter().copied())
}

/// Three steps with gradients from several devices, each beside what one device finds for the same weights.
///
/// Two networks that walk apart would not do: the optimiser gives every direction of an update the same length, also those
/// that are rounding alone, and what is next to nothing after the first step is a hundredth of a gradient after the third.
fn compare<T: Task>(recipe: &TrainRecipe, main: &Device, others: &[Device]) {
    let task = &T::of(&recipe.network).unwrap();
    let mut replicas = Replicas::new(task, main, others);
    let mut network = seeded(main, recipe.seed, || task.network(main)).unwrap();
    let mut optimisers = [(); 2].map(|()| Optimiser::new(StepsOn::Host));
    for batch in &batches(task, recipe) {
        let loss = task.loss(&network, batch, main);
        let gradients = loss.backward();
        let loss = scalar(loss);
        let (summed_loss, summed) = replicas.gradients(&network, batch);
        assert!((summed_loss - loss).abs() < 1e-4 * loss.abs());
        let expected = values(&network, Some(&gradients));
        let found = values(&network, Some(&summed));
        assert!(expected.iter().all(|gradient| !gradient.is_empty()));
        for (found, expected) in found.iter().zip(&expected) {
            let apart = apart(found, expected);
            assert!(apart < 1e-2, "a gradient is off by {apart} of its length");
        }
        let start = values(&network, None).concat();
        let [alone, together] = [gradients, summed]
            .map(|gradients| StepGradients::new(StepsOn::Host, &network, &gradients));
        let [first, second] = &mut optimisers;
        let alone = first.step(network.clone(), alone, 1e-3, &recipe.optimiser);
        network = second.step(network, together, 1e-3, &recipe.optimiser);
        let [alone, together] = [&alone, &network].map(|network| -> Vec<f32> {
            let weights = values(network, None).concat();
            weights.iter().zip(&start).map(|(w, s)| w - s).collect()
        });
        let apart = apart(&together, &alone);
        assert!(apart < 3e-2, "the steps differ by {apart} of their length");
    }
}

#[test]
fn parts_of_a_batch_add_up_to_the_whole() {
    let [main, _] = devices();
    let normal = recipe("normal", 16);
    let light = recipe("light", 64);
    for others in 1..3 {
        let others = vec![main.clone(); others];
        compare::<NormalTask>(&normal, &main, &others);
        compare::<LightTask>(&light, &main, &others);
    }
}

#[test]
fn different_and_idle_devices_and_parts_without_an_object_do_no_harm() {
    let [main, other] = devices();
    let recipe = recipe("normal", 16);
    let task = NormalTask::of(&recipe.network).unwrap();
    let mut batch = batches(&task, &recipe).swap_remove(0);
    // The first sample becomes a crop beside the object: no truth, no mask.
    batch.target[..4 * 16 * 16].fill(0.0);
    let network = task.network(&main).unwrap();
    let loss = task.loss(&network, &batch, &main);
    let gradients = loss.backward();
    let mut replicas = Replicas::new(&task, &main, &vec![other; 6]);
    let (summed_loss, summed) = replicas.gradients(&network, &batch);
    assert!((summed_loss - scalar(loss)).abs() < 1e-5);
    let expected = values(&network, Some(&gradients)).concat();
    // Another implementation rounds differently, and a maximum may move to another image.
    assert!(apart(&values(&network, Some(&summed)).concat(), &expected) < 5e-2);
}

#[test]
fn running_statistics_are_those_of_the_main_device() {
    let [main, other] = devices();
    let recipe = recipe("normal", 16);
    let mut settings = NormalSettings::default();
    let paper = Genotypes::from_json(
        "paper",
        include_str!("../../../../models/genotypes/paper.json"),
    )
    .unwrap();
    settings.architecture.body = NormalBody::Cells(CellNormal {
        width: 2,
        stem_strides: [1, 2],
        reductions: 2,
        upsampling: Upsampling::Nearest,
        fused_convolutions: 1,
        genotype: paper.normal.into(),
    });
    let task = NormalTask::new(&settings);
    let network = task.network(&main).unwrap();
    let start = values(&network, None);
    let main_only = network.valid().train();
    let mut replicas = Replicas::new(&task, &main, &[other]);
    for batch in &batches(&task, &recipe) {
        replicas.gradients(&network, batch);
        task.loss(&main_only, &divided(batch, 2)[0], &main);
    }
    let statistics = values(&network.valid(), None);
    assert!(statistics == values(&main_only.valid(), None) && statistics != start);
}

#[test]
#[should_panic(expected = "no memory left")]
fn a_panic_on_another_device_is_not_lost() {
    let [main, _] = devices();
    let recipe = recipe("normal", 16);
    let task = NormalTask::of(&recipe.network).unwrap();
    let network = task.network(&main).unwrap();
    let mut replicas = Replicas::new(&task, &main, &[]);
    replicas.workers.push(Worker {
        jobs: channel().0,
        results: channel().1,
        thread: std::thread::spawn(|| panic!("no memory left")),
    });
    replicas.gradients(&network, &batches(&task, &recipe)[0]);
}
