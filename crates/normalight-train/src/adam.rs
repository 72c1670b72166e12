use crate::named_tensors::{NamedTensors, put, take};
use crate::{Decay, OptimiserRecipe};
use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::tensor::{Gradients, Tensor, TensorData};
use std::collections::BTreeMap;

/// Adam (Kingma & Ba 2015) with the gradient clipped by its norm over all weights, and with either
/// kind of weight decay.
///
/// The state lives on the host under the weights' names, so that a checkpoint is plain numbers and
/// a resumed run continues exactly.
#[derive(Debug, Clone, Default)]
pub(crate) struct Adam {
    step: i32,
    /// First and second moments by name.
    moments: BTreeMap<String, [Vec<f32>; 2]>,
}

/// The gradients of a network on the host.
pub(crate) struct HostGradients {
    values: NamedTensors,
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

impl Adam {
    /// One step: the updated network. `rate`: the learning rate.
    pub(crate) fn step<M: Module>(
        &mut self,
        network: M,
        gradients: HostGradients,
        rate: f32,
        recipe: &OptimiserRecipe,
    ) -> M {
        self.step = self.step.saturating_add(1);
        let mut updater = Updater {
            adam: self,
            scale: (recipe.clip / gradients.norm.max(1e-12)).min(1.0),
            found: gradients.values,
            rate,
            recipe,
            path: Vec::new(),
        };
        network.map(&mut updater)
    }

    /// Adds the state to a checkpoint.
    pub(crate) fn save(&self, tensors: &mut NamedTensors) {
        for order in [0, 1] {
            let moments = self.moments.iter();
            let moments = moments.map(|(name, both)| (name.clone(), both[order].clone()));
            put(tensors, &format!("moment{order}"), moments.collect());
        }
    }

    /// Takes the state out of a checkpoint made after `step` steps.
    ///
    /// # Errors
    /// The name of a moment that is missing or of another size.
    pub(crate) fn load(tensors: &mut NamedTensors, step: usize) -> Result<Self, String> {
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
        })
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

struct Updater<'a> {
    adam: &'a mut Adam,
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
        let (shape, device) = (tensor.dims(), tensor.device());
        let mut weights = host(tensor);
        let moments = self.adam.moments.entry(path);
        let moments =
            moments.or_insert_with(|| [vec![0.0; weights.len()], vec![0.0; weights.len()]]);
        let update = Update {
            step: self.adam.step,
            rate: self.rate,
            scale: self.scale,
            // Biases and normalisation have one dimension.
            is_kernel: D > 1,
        };
        update.apply(self.recipe, &mut weights, &gradient, moments);
        let tensor = Tensor::<D>::from_data(TensorData::new(weights, shape), &device);
        Param::initialized(param.id, tensor.require_grad())
    }
}

/// One step of one tensor.
struct Update {
    /// Number of this step, from 1.
    step: i32,
    rate: f32,
    /// What clipping makes of the gradient.
    scale: f32,
    is_kernel: bool,
}

impl Update {
    fn apply(
        &self,
        recipe: &OptimiserRecipe,
        weights: &mut [f32],
        gradient: &[f32],
        [first, second]: &mut [Vec<f32>; 2],
    ) {
        let [beta_1, beta_2] = recipe.betas;
        let rate = self.rate / (1.0 - beta_1.powi(self.step));
        let correction = 1.0 / (1.0 - beta_2.powi(self.step));
        let (coupled, kept) = match recipe.decay {
            Decay::Coupled => (recipe.weight_decay, 1.0),
            Decay::Decoupled if self.is_kernel => (0.0, 1.0 - self.rate * recipe.weight_decay),
            Decay::Decoupled => (0.0, 1.0),
        };
        for (((weight, gradient), first), second) in
            weights.iter_mut().zip(gradient).zip(first).zip(second)
        {
            let gradient = gradient * self.scale + coupled * *weight;
            *first += (1.0 - beta_1) * (gradient - *first);
            *second += (1.0 - beta_2) * (gradient * gradient - *second);
            *weight *= kept;
            *weight -= rate * *first / ((*second * correction).sqrt() + recipe.epsilon);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Two steps on one weight of 1 with the gradients 0.5 and -0.4, rate 0.01, betas 0.5 and 0.999:
    /// worked out in double precision from the published algorithms.
    #[test]
    fn two_steps_as_published() {
        let expected = |decay: Decay| {
            let (rate, strength, beta): (f64, f64, [f64; 2]) = (0.01, 0.1, [0.5, 0.999]);
            let (mut weight, mut m, mut v) = (1.0f64, 0.0, 0.0);
            for (t, gradient) in [(1, 0.5), (2, -0.4)] {
                let mut gradient = gradient;
                match decay {
                    Decay::Coupled => gradient += strength * weight,
                    Decay::Decoupled => weight -= rate * strength * weight,
                }
                m = beta[0] * m + (1.0 - beta[0]) * gradient;
                v = beta[1] * v + (1.0 - beta[1]) * gradient * gradient;
                let m_hat = m / (1.0 - beta[0].powi(t));
                let v_hat: f64 = v / (1.0 - beta[1].powi(t));
                weight -= rate * m_hat / (v_hat.sqrt() + 1e-8);
            }
            weight
        };
        for decay in [Decay::Coupled, Decay::Decoupled] {
            let recipe = OptimiserRecipe {
                betas: [0.5, 0.999],
                weight_decay: 0.1,
                decay,
                ..OptimiserRecipe::default()
            };
            let mut weights = [1.0];
            let mut moments = [vec![0.0], vec![0.0]];
            // The second gradient was clipped to half its length before.
            for (step, gradient, scale) in [(1, 0.5, 1.0), (2, -0.8, 0.5)] {
                let update = Update {
                    step,
                    rate: 0.01,
                    scale,
                    is_kernel: true,
                };
                update.apply(&recipe, &mut weights, &[gradient], &mut moments);
            }
            let error = f64::from(weights[0]) - expected(decay);
            assert!(error.abs() < 1e-6, "{decay:?}: {error}");
        }
        assert!((expected(Decay::Coupled) - expected(Decay::Decoupled)).abs() > 1e-4);
    }

    #[test]
    fn decoupled_decay_spares_biases() {
        let recipe = OptimiserRecipe {
            weight_decay: 0.5,
            ..OptimiserRecipe::default()
        };
        for (is_kernel, expected) in [(true, 0.95), (false, 1.0)] {
            let mut weights = [1.0];
            let update = Update {
                step: 1,
                rate: 0.1,
                scale: 1.0,
                is_kernel,
            };
            update.apply(&recipe, &mut weights, &[0.0], &mut [vec![0.0], vec![0.0]]);
            assert_eq!(weights, [expected]);
        }
    }
}
