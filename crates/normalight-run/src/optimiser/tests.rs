use super::*;
use crate::named_tensors::collect;
use burn::module::Param;
use burn::tensor::{Tensor, TensorData};

/// A matrix, a depthwise convolution and a bias.
#[derive(Module, Debug)]
struct Layers {
    matrix: Layer<2>,
    depthwise: Layer<4>,
    bias: Param<Tensor<1>>,
}

/// A layer's weight has the name that weights have.
#[derive(Module, Debug)]
struct Layer<const D: usize> {
    weight: Param<Tensor<D>>,
}

/// Numbers without a pattern.
fn tensor<const D: usize>(shape: [usize; D], seed: f32, device: &Device) -> Tensor<D> {
    let count: usize = shape.iter().product();
    let values: Vec<f32> = (0..count).map(|k| (1.7 * k as f32 + seed).sin()).collect();
    Tensor::from_data(TensorData::new(values, shape), device)
}

impl Layers {
    fn new(device: &Device) -> Self {
        Self {
            matrix: Layer {
                weight: Param::from_tensor(tensor([6, 4], 1.0, device)),
            },
            depthwise: Layer {
                weight: Param::from_tensor(tensor([5, 1, 3, 3], 2.0, device)),
            },
            bias: Param::from_tensor(tensor([7], 3.0, device)),
        }
    }

    /// A loss that is not quadratic, other at every step.
    fn loss(&self, step: usize) -> Tensor<1> {
        let seed = step as f32;
        let part = |values: Tensor<1>, seed: f32| {
            let count = values.dims()[0];
            let target = tensor([count], seed, &values.device());
            ((values - target) * 1.3).tanh().square().sum()
        };
        part(self.matrix.weight.val().flatten(0, 1), seed)
            + part(self.depthwise.weight.val().flatten(0, 3), seed + 0.3)
            + part(self.bias.val(), seed + 0.7)
    }
}

fn train(
    (network, optimiser): (Layers, &mut Optimiser),
    steps: std::ops::Range<usize>,
    recipe: &OptimiserRecipe,
) -> Layers {
    let mut network = network;
    for step in steps {
        let gradients = network.loss(step).backward();
        let gradients = optimiser.gradients(&network, &gradients);
        assert!(gradients.norm() > recipe.clip);
        network = optimiser.step(network, gradients, 0.02, recipe);
    }
    network
}

fn recipes() -> Vec<OptimiserRecipe> {
    let mut recipes = Vec::new();
    for kind in [OptimiserKind::Adam, OptimiserKind::Muon] {
        for decay in [Decay::Coupled, Decay::Decoupled] {
            recipes.push(OptimiserRecipe {
                kind,
                muon: MuonRecipe {
                    rate_factor: 2.0,
                    depthwise: DepthwiseRule::Filters,
                    ..MuonRecipe::default()
                },
                weight_decay: 0.1,
                decay,
                clip: 0.5,
                ..OptimiserRecipe::default()
            });
        }
    }
    recipes
}

/// Steps on a device take the network where steps on the host do, and either goes on from the other's state.
#[test]
fn both_places_take_the_same_steps() {
    let plain = Device::flex();
    let device = plain.clone().autodiff();
    for recipe in recipes() {
        let start = collect(&Layers::new(&device));
        let mut ends = Vec::new();
        for (first, then) in [
            (StepsOn::Host, StepsOn::Host),
            (StepsOn::Device, StepsOn::Device),
            (StepsOn::Host, StepsOn::Device),
            (StepsOn::Device, StepsOn::Host),
        ] {
            let mut optimiser = Optimiser::new(first);
            let network = train((Layers::new(&device), &mut optimiser), 0..4, &recipe);
            let mut state = NamedTensors::new();
            optimiser.save(&mut state);
            let mut optimiser = Optimiser::new(then);
            optimiser.load(&mut state, 4, &plain).unwrap();
            assert_eq!((state.len(), optimiser.place()), (0, then));
            let network = train((network, &mut optimiser), 4..8, &recipe);
            ends.push(collect(&network));
        }
        for end in &ends[1..] {
            for (name, expected) in &ends[0] {
                let apart = |other: &[f32]| {
                    let pairs = expected.iter().zip(other);
                    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
                };
                assert!(apart(&start[name]) > 0.02, "{name} has not moved");
                let apart = apart(&end[name]);
                assert!(apart < 2e-5, "{name}: {apart}");
            }
        }
    }
}

#[test]
#[should_panic(expected = "another place")]
fn gradients_of_another_place_are_refused() {
    let device = Device::flex().autodiff();
    let network = Layers::new(&device);
    let gradients = network.loss(0).backward();
    let gradients = StepGradients::new(StepsOn::Host, &network, &gradients);
    let recipe = OptimiserRecipe::default();
    Optimiser::new(StepsOn::Device).step(network, gradients, 0.1, &recipe);
}
