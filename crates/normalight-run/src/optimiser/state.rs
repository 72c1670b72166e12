use super::adam::AdamStep;
use super::muon::{MuonStep, Shape};
use super::place::{Place, StepSettings};
use super::recipe::{OptimiserKind, OptimiserRecipe};
use crate::named_tensors::{NamedTensors, put, take};
use burn::module::{Module, ModuleMapper, Param};
use burn::tensor::{Device, Tensor};
use std::collections::BTreeMap;

/// What an optimiser remembers, in its place.
#[derive(Debug, Clone)]
pub(super) struct State<P: Place> {
    step: i32,
    /// Adam's first and second moments by name.
    moments: BTreeMap<String, [P::Value; 2]>,
    /// Muon's momentum by name, of those weights that are its.
    momentum: BTreeMap<String, P::Value>,
}

/// Gradients by the names of the weights, and their norm over all of them.
#[derive(Debug, Clone)]
pub(super) struct Collected<P: Place> {
    pub(super) values: BTreeMap<String, P::Value>,
    pub(super) norm: f32,
}

impl<P: Place> Collected<P> {
    pub(super) fn new(values: BTreeMap<String, P::Value>) -> Self {
        let norm = P::norm(values.values());
        Self { values, norm }
    }

    /// Those of the weights for which `wanted` holds.
    pub(super) fn only(mut self, wanted: impl Fn(&str) -> bool) -> Self {
        self.values.retain(|name, _| wanted(name));
        Self::new(self.values)
    }
}

impl<P: Place> State<P> {
    pub(super) fn new() -> Self {
        Self {
            step: 0,
            moments: BTreeMap::new(),
            momentum: BTreeMap::new(),
        }
    }

    /// One step: the updated network. `rate`: the learning rate of Adam, from which Muon's follows.
    pub(super) fn step<M: Module>(
        &mut self,
        network: M,
        gradients: Collected<P>,
        rate: f32,
        recipe: &OptimiserRecipe,
    ) -> M {
        self.step = self.step.saturating_add(1);
        let settings = StepSettings {
            recipe,
            rate,
            scale: (recipe.clip / gradients.norm.max(1e-12)).min(1.0),
        };
        let mut updater = Updater {
            state: self,
            found: gradients.values,
            settings,
            path: Vec::new(),
        };
        network.map(&mut updater)
    }

    /// Adds the state to a checkpoint.
    pub(super) fn save(&self, tensors: &mut NamedTensors) {
        for order in [0, 1] {
            let moments = self.moments.iter();
            let moments = moments.map(|(name, both)| (name.clone(), P::to_host(&both[order])));
            put(tensors, &format!("moment{order}"), moments.collect());
        }
        let momentum = self.momentum.iter();
        let momentum = momentum.map(|(name, one)| (name.clone(), P::to_host(one)));
        put(tensors, "momentum", momentum.collect());
    }

    /// Takes the state out of a checkpoint made after `step` steps. `device`: where the network is, without gradients.
    ///
    /// # Errors
    /// The name of a moment that is missing or of another size.
    pub(super) fn load(
        tensors: &mut NamedTensors,
        step: usize,
        device: &Device,
    ) -> Result<Self, String> {
        let first = take(tensors, "moment0");
        let mut second = take(tensors, "moment1");
        let mut moments = BTreeMap::new();
        for (name, first) in first {
            match second.remove(&name) {
                Some(second) if second.len() == first.len() => {
                    let both = [first, second].map(|values| P::from_host(values, device));
                    moments.insert(name, both);
                }
                _ => return Err(format!("moment of {name} is missing")),
            }
        }
        let momentum = take(tensors, "momentum").into_iter();
        let momentum = momentum.map(|(name, values)| (name, P::from_host(values, device)));
        Ok(Self {
            step: i32::try_from(step).unwrap_or(i32::MAX),
            moments,
            momentum: momentum.collect(),
        })
    }
}

struct Updater<'a, P: Place> {
    state: &'a mut State<P>,
    found: BTreeMap<String, P::Value>,
    settings: StepSettings<'a>,
    path: Vec<String>,
}

impl<P: Place> ModuleMapper for Updater<'_, P> {
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
        let weights = P::read(tensor);
        let recipe = self.settings.recipe;
        let shape = match recipe.kind {
            OptimiserKind::Adam => None,
            OptimiserKind::Muon => Shape::of(&path, &dims, &recipe.muon),
        };
        let weights = if let Some(shape) = shape {
            let momentum = self.state.momentum.entry(path);
            let momentum = momentum.or_insert_with(|| P::zeros(&weights));
            let step = MuonStep {
                settings: StepSettings {
                    rate: self.settings.rate * recipe.muon.rate_factor,
                    ..self.settings
                },
                shape,
                // Where the network is, so that a GPU's products stay there.
                device: device.clone().inner(),
            };
            P::muon(&step, weights, &gradient, momentum)
        } else {
            let moments = self.state.moments.entry(path);
            let moments = moments.or_insert_with(|| [P::zeros(&weights), P::zeros(&weights)]);
            let step = AdamStep {
                settings: self.settings,
                step: self.state.step,
                is_kernel: D > 1,
            };
            P::adam(&step, weights, &gradient, moments)
        };
        let tensor = P::tensor(weights, dims, &device);
        Param::initialized(param.id, tensor.require_grad())
    }
}
