//! Gradients of the architecture in the bi-level problem of DARTS (Liu et al. 2019): find the architecture that is best
//! on validation data with the weights that are best for it on training data.
use burn::module::{Module, ModuleMapper, ModuleVisitor, Param, ParamId, list_param_ids};
use burn::tensor::{Tensor, TensorData};
use normalight_model::Relaxation;
use normalight_run::collect_gradients;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Length of the step of the finite difference, as in DARTS.
const DIFFERENCE: f64 = 0.01;

/// NamedTensorsF64 of a network by the names of its parts, in double precision.
pub(super) type NamedTensorsF64 = BTreeMap<String, Vec<f64>>;

/// The names of the architecture's parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Alpha(BTreeSet<String>);

impl Alpha {
    /// Those parameters of a network that its relaxation holds.
    pub(super) fn of<M: Module>(network: &M, relaxation: &Relaxation) -> Self {
        let mut namer = Namer {
            wanted: list_param_ids(relaxation).into_iter().collect(),
            path: Vec::new(),
            found: BTreeSet::new(),
        };
        network.visit(&mut namer);
        Self(namer.found)
    }

    pub(super) fn contains(&self, name: &str) -> bool {
        self.0.contains(name)
    }
}

/// Finds the names of some parameters.
struct Namer {
    wanted: HashSet<ParamId>,
    path: Vec<String>,
    found: BTreeSet<String>,
}

impl ModuleVisitor for Namer {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        if self.wanted.contains(&param.id) {
            self.found.insert(self.path.join("."));
        }
    }
}

/// A loss and its gradient.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LossAndGradient {
    pub(super) loss: f64,
    /// By all parameters that have one.
    pub(super) gradient: NamedTensorsF64,
}

impl LossAndGradient {
    pub(super) fn of<M: Module>(network: &M, loss: Tensor<1>) -> Self {
        let gradients = loss.backward();
        Self {
            loss: loss.into_data().iter::<f64>().sum(),
            gradient: collect_gradients(network, &gradients),
        }
    }

    /// The parts of the gradient for which `wanted` holds.
    pub(super) fn only(mut self, wanted: impl Fn(&str) -> bool) -> Self {
        self.gradient.retain(|name, _| wanted(name));
        self
    }
}

/// Gradient of the validation loss by the architecture at the weights as they are: first order.
pub(super) fn first_order<M: Module>(
    network: &M,
    alpha: &Alpha,
    loss: impl Fn(&M) -> Tensor<1>,
) -> LossAndGradient {
    // Nobody asks for the weights' gradients: that saves their share of the backward pass.
    let network = network.clone().map(&mut Freezer {
        alpha,
        path: Vec::new(),
    });
    let loss = loss(&network);
    LossAndGradient::of(&network, loss).only(|name| alpha.contains(name))
}

/// Gradient by the architecture of the validation loss after one plain gradient step of the weights on training data,
/// `L_val(w - rate grad_w L_train(w, alpha), alpha)`: second order. The product with the matrix of second derivatives is a
/// finite difference.
pub(super) fn second_order<M: Module>(
    network: &M,
    alpha: &Alpha,
    rate: f64,
    training: impl Fn(&M) -> Tensor<1>,
    validation: impl Fn(&M) -> Tensor<1>,
) -> LossAndGradient {
    let is_weight = |name: &str| !alpha.contains(name);
    let step = LossAndGradient::of(network, training(network)).only(is_weight);
    let stepped = shifted(network, &step.gradient, -rate);
    let mut slope = LossAndGradient::of(&stepped, validation(&stepped));
    let mut direction = slope.gradient.clone();
    direction.retain(|name, _| is_weight(name));
    let square: f64 = direction
        .values()
        .flatten()
        .map(|value| value * value)
        .sum();
    slope.gradient.retain(|name, _| alpha.contains(name));
    let length = square.sqrt();
    if length.is_finite() && length > 0.0 {
        let epsilon = DIFFERENCE / length;
        for side in [epsilon, -epsilon] {
            let moved = shifted(network, &direction, side);
            let factor = -rate / (2.0 * side);
            add(
                &mut slope.gradient,
                &first_order(&moved, alpha, &training).gradient,
                factor,
            );
        }
    }
    slope
}

fn add(sum: &mut NamedTensorsF64, more: &NamedTensorsF64, factor: f64) {
    for (name, values) in more {
        if let Some(sum) = sum.get_mut(name) {
            for (sum, value) in sum.iter_mut().zip(values) {
                *sum += factor * value;
            }
        }
    }
}

/// The network with a multiple of `direction` added to the parameters that it names.
fn shifted<M: Module>(network: &M, direction: &NamedTensorsF64, factor: f64) -> M {
    network.clone().map(&mut Shifter {
        direction,
        factor,
        path: Vec::new(),
    })
}

struct Shifter<'a> {
    direction: &'a NamedTensorsF64,
    factor: f64,
    path: Vec<String>,
}

impl ModuleMapper for Shifter<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let Some(direction) = self.direction.get(&self.path.join(".")) else {
            return param;
        };
        let tensor = param.val();
        let (shape, device, dtype) = (tensor.dims(), tensor.device(), tensor.dtype());
        let before = tensor.detach().into_data();
        let values: Vec<f64> = before
            .iter::<f64>()
            .zip(direction)
            .map(|(value, step)| value + self.factor * step)
            .collect();
        let data = TensorData::new(values, shape).convert_dtype(dtype);
        let moved = Tensor::from_data(data, (&device, dtype));
        Param::initialized(param.id, moved.require_grad())
    }
}

/// Stops gradients at everything but the architecture.
struct Freezer<'a> {
    alpha: &'a Alpha,
    path: Vec<String>,
}

impl ModuleMapper for Freezer<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        if self.alpha.contains(&self.path.join(".")) {
            return param;
        }
        param.set_require_grad(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use burn::tensor::{DType, Device, activation};

    /// Three operations on one edge, mixed by the softmax of three numbers, and a linear layer.
    #[derive(Module, Debug)]
    struct Tiny {
        relaxation: Param<Tensor<2>>,
        bent: Param<Tensor<2>>,
        straight: Param<Tensor<2>>,
        last: Param<Tensor<2>>,
    }

    /// NamedTensorsF64 between -1 and 1 that follow no pattern.
    fn tensor(size: [usize; 2], seed: f64, device: &Device) -> Tensor<2> {
        let numbers = (0..size[0] * size[1]).map(|k| (1.7 * k as f64 + seed * seed).sin());
        let data = TensorData::new(numbers.collect::<Vec<f64>>(), size);
        Tensor::from_data(data, (device, DType::F64))
    }

    impl Tiny {
        fn new(device: &Device) -> Self {
            let param = |size, seed| Param::from_tensor(tensor(size, seed, device));
            Self {
                relaxation: param([1, 3], 1.0),
                bent: param([3, 3], 2.0),
                straight: param([3, 3], 3.0),
                last: param([3, 2], 4.0),
            }
        }

        /// Mean squared error on data of a seed.
        fn loss(&self, seed: f64, device: &Device) -> Tensor<1> {
            let input = tensor([5, 3], seed, device);
            let truth = tensor([5, 2], seed + 0.5, device);
            let weights = activation::softmax(self.relaxation.val(), 1);
            let weight = |k: usize| weights.clone().slice([0..1, k..k + 1]);
            let bent = input.clone().matmul(self.bent.val()).tanh() * weight(0);
            let straight = input.clone().matmul(self.straight.val()) * weight(1);
            let mixed = bent + straight + input * weight(2);
            (mixed.tanh().matmul(self.last.val()) - truth)
                .square()
                .mean()
        }
    }

    const RATE: f64 = 0.3;

    /// Against central differences of L_val(w - rate grad_w L_train(w, alpha), alpha) over alpha, in double precision.
    #[test]
    fn second_order_as_brute_force_says() {
        let device = Device::flex().autodiff();
        let network = Tiny::new(&device);
        let alpha = Alpha(BTreeSet::from(["relaxation".to_owned()]));
        let [training, validation] = [5.0, 6.0].map(|seed| {
            let device = device.clone();
            move |network: &Tiny| network.loss(seed, &device)
        });
        let after_step = |network: &Tiny| -> f64 {
            let step =
                LossAndGradient::of(network, training(network)).only(|name| !alpha.contains(name));
            let loss = validation(&shifted(network, &step.gradient, -RATE));
            loss.into_data().iter::<f64>().sum()
        };
        const SMALL: f64 = 1e-5;
        let brute: Vec<f64> = (0..3)
            .map(|k| {
                let mut direction = vec![0.0; 3];
                direction[k] = 1.0;
                let direction = NamedTensorsF64::from([("relaxation".to_owned(), direction)]);
                let side = |by: f64| after_step(&shifted(&network, &direction, by));
                (side(SMALL) - side(-SMALL)) / (2.0 * SMALL)
            })
            .collect();
        let length = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>().sqrt();
        let error = |slope: &LossAndGradient| {
            let found = &slope.gradient["relaxation"];
            let off: Vec<f64> = found.iter().zip(&brute).map(|(a, b)| a - b).collect();
            length(&off) / length(&brute)
        };
        let second = second_order(&network, &alpha, RATE, &training, &validation);
        assert_eq!(second.gradient.len(), 1);
        assert!(error(&second) < 1e-4, "{second:?}, {brute:?}");
        let loss = after_step(&network);
        assert!((second.loss - loss).abs() < 1e-12);
        // The first order leaves out what the weights' step does: it is another number here, and right for a rate of 0.
        let first = first_order(&network, &alpha, &validation);
        assert!(error(&first) > 0.05, "{first:?}, {brute:?}");
        let none = second_order(&network, &alpha, 0.0, &training, &validation);
        assert_eq!(none.gradient, first.gradient);
    }
}
