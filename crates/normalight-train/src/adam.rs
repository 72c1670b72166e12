use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::tensor::{Gradients, Tensor, TensorData};
use std::collections::BTreeMap;

const BETA_1: f32 = 0.9;
const BETA_2: f32 = 0.999;
const EPSILON: f32 = 1e-8;

/// Adam (Kingma & Ba 2015) with the gradient clipped by its norm over all weights.
///
/// The state lives on the host under the weights' names, so that a checkpoint is plain numbers and
/// a resumed run continues exactly.
#[derive(Debug, Default)]
pub(crate) struct Adam {
    pub(crate) step: i32,
    /// First and second moments by name.
    pub(crate) moments: BTreeMap<String, [Vec<f32>; 2]>,
}

impl Adam {
    /// One step; returns the updated network and the norm of the gradient before clipping.
    pub(crate) fn step<M: Module>(
        &mut self,
        network: M,
        gradients: &Gradients,
        rate: f32,
        clip: f32,
    ) -> (M, f32) {
        let mut collector = Collector {
            gradients,
            path: Vec::new(),
            found: BTreeMap::new(),
        };
        network.visit(&mut collector);
        let found = collector.found;
        let square: f64 = found
            .values()
            .flatten()
            .map(|&value| f64::from(value).powi(2))
            .sum();
        let norm = square.sqrt() as f32;
        self.step += 1;
        let mut updater = Updater {
            adam: self,
            found,
            scale: (clip / norm.max(1e-12)).min(1.0),
            rate,
            path: Vec::new(),
        };
        (network.map(&mut updater), norm)
    }
}

/// Reads the gradient of every weight to the host.
struct Collector<'a> {
    gradients: &'a Gradients,
    path: Vec<String>,
    found: BTreeMap<String, Vec<f32>>,
}

impl ModuleVisitor for Collector<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        if let Some(gradient) = param.val().grad(self.gradients) {
            self.found.insert(self.path.join("."), host(gradient));
        }
    }
}

struct Updater<'a> {
    adam: &'a mut Adam,
    found: BTreeMap<String, Vec<f32>>,
    scale: f32,
    rate: f32,
    path: Vec<String>,
}

impl ModuleMapper for Updater<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let path = self.path.join(".");
        let Some(gradient) = self.found.remove(&path) else {
            return param;
        };
        let tensor = param.val();
        let (shape, device) = (tensor.dims(), tensor.device());
        let mut weights = host(tensor);
        let [first, second] = self
            .adam
            .moments
            .entry(path)
            .or_insert_with(|| [vec![0.0; weights.len()], vec![0.0; weights.len()]]);
        let step = self.adam.step;
        let rate = self.rate / (1.0 - BETA_1.powi(step));
        let correction = 1.0 / (1.0 - BETA_2.powi(step));
        for (((weight, gradient), first), second) in
            weights.iter_mut().zip(gradient).zip(first).zip(second)
        {
            let gradient = gradient * self.scale;
            *first += (1.0 - BETA_1) * (gradient - *first);
            *second += (1.0 - BETA_2) * (gradient * gradient - *second);
            *weight -= rate * *first / ((*second * correction).sqrt() + EPSILON);
        }
        let tensor = Tensor::<D>::from_data(TensorData::new(weights, shape), &device);
        Param::initialized(param.id, tensor.require_grad())
    }
}

/// A tensor's values; training tensors are f32 by construction.
pub(crate) fn host<const D: usize>(tensor: Tensor<D>) -> Vec<f32> {
    tensor
        .into_data()
        .convert::<f32>()
        .try_to_vec::<f32>()
        .unwrap_or_default()
}
