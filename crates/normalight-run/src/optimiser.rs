//! How weights follow their gradients.
mod adam;
mod gradients;
mod muon;
pub(crate) mod place;
mod recipe;
mod state;

pub use gradients::{DeviceGradients, HostGradients, StepGradients, collect_gradients};
pub use recipe::{Decay, DepthwiseRule, MuonRecipe, OptimiserKind, OptimiserRecipe, Schedule};

use crate::named_tensors::{NamedTensors, OnDevice, OnHost};
use burn::module::Module;
use burn::tensor::{Device, Gradients};
use state::State;

/// Where an optimiser computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StepsOn {
    /// On the host, which reads all gradients and weights at every step: best where the network computes there, too.
    #[default]
    Host,
    /// On the network's device, from which nothing but the gradient's norm is read.
    Device,
}

/// Adam or Muon, as the recipe says, with the gradient clipped by its norm over all weights.
///
/// The state has the weights' names, so that a checkpoint is plain numbers and a resumed run continues exactly.
#[derive(Debug, Clone)]
pub struct Optimiser(Placed);

#[derive(Debug, Clone)]
enum Placed {
    Host(State<OnHost>),
    Device(State<OnDevice>),
}

impl Optimiser {
    /// Before its first step.
    pub fn new(place: StepsOn) -> Self {
        Self(match place {
            StepsOn::Host => Placed::Host(State::new()),
            StepsOn::Device => Placed::Device(State::new()),
        })
    }

    /// Where it computes.
    pub fn place(&self) -> StepsOn {
        match self.0 {
            Placed::Host(_) => StepsOn::Host,
            Placed::Device(_) => StepsOn::Device,
        }
    }

    /// Gathers a network's gradients where the steps are computed.
    pub fn gradients<M: Module>(&self, network: &M, gradients: &Gradients) -> StepGradients {
        StepGradients::new(self.place(), network, gradients)
    }

    /// One step: the updated network. `rate`: the learning rate of Adam, from which Muon's follows.
    ///
    /// # Panics
    /// When the gradients were gathered in another place than this optimiser's.
    pub fn step<M: Module>(
        &mut self,
        network: M,
        gradients: StepGradients,
        rate: f32,
        recipe: &OptimiserRecipe,
    ) -> M {
        match (&mut self.0, gradients) {
            (Placed::Host(state), StepGradients::Host(gradients)) => {
                state.step(network, gradients.0, rate, recipe)
            }
            (Placed::Device(state), StepGradients::Device(gradients)) => {
                state.step(network, gradients.0, rate, recipe)
            }
            _ => panic!("gradients lie in another place than the optimiser's state"),
        }
    }

    /// Adds the state to a checkpoint.
    pub fn save(&self, tensors: &mut NamedTensors) {
        match &self.0 {
            Placed::Host(state) => state.save(tensors),
            Placed::Device(state) => state.save(tensors),
        }
    }

    /// Replaces the state by that of a checkpoint made after `step` steps, in whatever place it was made. `device`: where
    /// the network is, without gradients.
    ///
    /// # Errors
    /// The name of a moment that is missing or of another size.
    pub fn load(
        &mut self,
        tensors: &mut NamedTensors,
        step: usize,
        device: &Device,
    ) -> Result<(), String> {
        self.0 = match self.0 {
            Placed::Host(_) => Placed::Host(State::load(tensors, step, device)?),
            Placed::Device(_) => Placed::Device(State::load(tensors, step, device)?),
        };
        Ok(())
    }
}

#[cfg(test)]
mod tests;
