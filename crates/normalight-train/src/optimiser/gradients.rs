//! The gradients of a network on the host.
use crate::named_tensors::NamedTensors;
use burn::module::{Module, ModuleVisitor, Param};
use burn::tensor::{Gradients, Tensor};

/// Gradients by the names of the weights.
pub(crate) struct HostGradients {
    pub(super) values: NamedTensors,
    /// Norm over all weights.
    pub(crate) norm: f32,
}

impl HostGradients {
    pub(crate) fn new<M: Module>(network: &M, gradients: &Gradients) -> Self {
        let mut collector = Collector {
            gradients,
            path: Vec::new(),
            found: NamedTensors::new(),
        };
        network.visit(&mut collector);
        Self::from_values(collector.found)
    }

    /// The gradients of those weights for which `wanted` holds.
    pub(crate) fn only(mut self, wanted: impl Fn(&str) -> bool) -> Self {
        self.values.retain(|name, _| wanted(name));
        Self::from_values(self.values)
    }

    pub(crate) fn from_values(values: NamedTensors) -> Self {
        let square: f64 = values
            .values()
            .flatten()
            .map(|&value| f64::from(value).powi(2))
            .sum();
        Self {
            values,
            norm: square.sqrt() as f32,
        }
    }
}

/// Reads the gradient of every weight to the host.
struct Collector<'a> {
    gradients: &'a Gradients,
    path: Vec<String>,
    found: NamedTensors,
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

/// A tensor's values; training tensors are f32 by construction.
pub(crate) fn host<const D: usize>(tensor: Tensor<D>) -> Vec<f32> {
    tensor
        .into_data()
        .convert::<f32>()
        .try_to_vec::<f32>()
        .unwrap_or_default()
}
