//! How weights follow their gradients.
mod adam;
mod gradients;
mod muon;
mod recipe;

pub use gradients::{HostGradients, collect_gradients};
pub use recipe::{Decay, DepthwiseRule, MuonRecipe, OptimiserKind, OptimiserRecipe, Schedule};

use crate::named_tensors::{NamedTensors, host, put, take};
use adam::AdamStep;
use burn::module::{Module, ModuleMapper, Param};
use burn::tensor::{Tensor, TensorData};
use muon::{MuonStep, Shape};
use std::collections::BTreeMap;

/// Adam or Muon, as the recipe says, with the gradient clipped by its norm over all weights.
///
/// The state lives on the host under the weights' names, so that a checkpoint is plain numbers and
/// a resumed run continues exactly.
#[derive(Debug, Clone, Default)]
pub struct Optimiser {
    step: i32,
    /// Adam's first and second moments by name.
    moments: BTreeMap<String, [Vec<f32>; 2]>,
    /// Muon's momentum by name, of those weights that are its.
    momentum: NamedTensors,
}

impl Optimiser {
    /// One step: the updated network. `rate`: the learning rate of Adam, from which Muon's follows.
    pub fn step<M: Module>(
        &mut self,
        network: M,
        gradients: HostGradients,
        rate: f32,
        recipe: &OptimiserRecipe,
    ) -> M {
        self.step = self.step.saturating_add(1);
        let mut updater = Updater {
            optimiser: self,
            scale: (recipe.clip / gradients.norm.max(1e-12)).min(1.0),
            found: gradients.values,
            rate,
            recipe,
            path: Vec::new(),
        };
        network.map(&mut updater)
    }

    /// Adds the state to a checkpoint.
    pub fn save(&self, tensors: &mut NamedTensors) {
        for order in [0, 1] {
            let moments = self.moments.iter();
            let moments = moments.map(|(name, both)| (name.clone(), both[order].clone()));
            put(tensors, &format!("moment{order}"), moments.collect());
        }
        put(tensors, "momentum", self.momentum.clone());
    }

    /// Takes the state out of a checkpoint made after `step` steps.
    ///
    /// # Errors
    /// The name of a moment that is missing or of another size.
    pub fn load(tensors: &mut NamedTensors, step: usize) -> Result<Self, String> {
        let first = take(tensors, "moment0");
        let mut second = take(tensors, "moment1");
        let mut moments = BTreeMap::new();
        for (name, first) in first {
            match second.remove(&name) {
                Some(second) if second.len() == first.len() => {
                    moments.insert(name, [first, second]);
                }
                _ => return Err(format!("moment of {name} is missing")),
            }
        }
        Ok(Self {
            step: i32::try_from(step).unwrap_or(i32::MAX),
            moments,
            momentum: take(tensors, "momentum"),
        })
    }
}

struct Updater<'a> {
    optimiser: &'a mut Optimiser,
    found: NamedTensors,
    scale: f32,
    rate: f32,
    recipe: &'a OptimiserRecipe,
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
        let (dims, device) = (tensor.dims(), tensor.device());
        let mut weights = host(tensor);
        let shape = match self.recipe.kind {
            OptimiserKind::Adam => None,
            OptimiserKind::Muon => Shape::of(&path, &dims, &self.recipe.muon),
        };
        if let Some(shape) = shape {
            let momentum = self.optimiser.momentum.entry(path);
            let momentum = momentum.or_insert_with(|| vec![0.0; weights.len()]);
            let step = MuonStep {
                rate: self.rate * self.recipe.muon.rate_factor,
                scale: self.scale,
                shape,
                // Where the network is, so that a GPU's products stay there.
                device: device.clone().inner(),
            };
            step.apply(self.recipe, &mut weights, &gradient, momentum);
        } else {
            let moments = self.optimiser.moments.entry(path);
            let moments =
                moments.or_insert_with(|| [vec![0.0; weights.len()], vec![0.0; weights.len()]]);
            let step = AdamStep {
                step: self.optimiser.step,
                rate: self.rate,
                scale: self.scale,
                is_kernel: D > 1,
            };
            step.apply(self.recipe, &mut weights, &gradient, moments);
        }
        let tensor = Tensor::<D>::from_data(TensorData::new(weights, dims), &device);
        Param::initialized(param.id, tensor.require_grad())
    }
}
