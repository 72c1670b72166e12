//! The gradients of a network on the host.
use crate::named_tensors::{NamedTensors, host};
use burn::module::{Module, ModuleVisitor, Param};
use burn::tensor::{Element, Gradients, Tensor};
use std::collections::BTreeMap;

/// Gradients by the names of the weights.
pub struct HostGradients {
    pub(super) values: NamedTensors,
    /// Norm over all weights.
    pub norm: f32,
}

impl HostGradients {
    /// Of every weight of a network that has one.
    pub fn new<M: Module>(network: &M, gradients: &Gradients) -> Self {
        Self::from_values(collect_gradients(network, gradients))
    }

    /// The gradients of those weights for which `wanted` holds.
    pub fn only(mut self, wanted: impl Fn(&str) -> bool) -> Self {
        self.values.retain(|name, _| wanted(name));
        Self::from_values(self.values)
    }

    /// Of values by name.
    pub fn from_values(values: NamedTensors) -> Self {
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

/// Reads the gradient of every weight that has one to the host, by the weights' names.
pub fn collect_gradients<M: Module, E: Element>(
    network: &M,
    gradients: &Gradients,
) -> BTreeMap<String, Vec<E>> {
    let mut collector = Collector {
        gradients,
        path: Vec::new(),
        found: BTreeMap::new(),
    };
    network.visit(&mut collector);
    collector.found
}

struct Collector<'a, E> {
    gradients: &'a Gradients,
    path: Vec<String>,
    found: BTreeMap<String, Vec<E>>,
}

impl<E: Element> ModuleVisitor for Collector<'_, E> {
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
