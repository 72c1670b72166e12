//! The gradients of a step, gathered by the names of the weights.
use super::StepsOn;
use super::place::Place;
use super::state::Collected;
use crate::named_tensors::{NamedTensors, OnDevice, OnHost, Values, read_all};
use burn::module::Module;
use burn::tensor::{Element, Gradients};
use std::collections::BTreeMap;

/// Gradients by the names of the weights, where the optimiser wants them.
#[derive(Debug, Clone)]
pub enum StepGradients {
    /// On the host.
    Host(HostGradients),
    /// On the network's device.
    Device(DeviceGradients),
}

/// Gradients on the host.
#[derive(Debug, Clone)]
pub struct HostGradients(pub(super) Collected<OnHost>);

/// Gradients on a device.
#[derive(Debug, Clone)]
pub struct DeviceGradients(pub(super) Collected<OnDevice>);

impl StepGradients {
    /// Of every weight of a network that has one.
    pub fn new<M: Module>(place: StepsOn, network: &M, gradients: &Gradients) -> Self {
        match place {
            StepsOn::Host => Self::Host(HostGradients(gathered(network, gradients))),
            StepsOn::Device => Self::Device(DeviceGradients(gathered(network, gradients))),
        }
    }

    /// Of values by name, for an optimiser on the host.
    pub fn from_values(values: NamedTensors) -> Self {
        Self::Host(HostGradients(Collected::new(values)))
    }

    /// The gradients of those weights for which `wanted` holds.
    pub fn only(self, wanted: impl Fn(&str) -> bool) -> Self {
        match self {
            Self::Host(HostGradients(all)) => Self::Host(HostGradients(all.only(wanted))),
            Self::Device(DeviceGradients(all)) => Self::Device(DeviceGradients(all.only(wanted))),
        }
    }

    /// Norm over all weights.
    pub fn norm(&self) -> f32 {
        match self {
            Self::Host(gradients) => gradients.0.norm,
            Self::Device(gradients) => gradients.0.norm,
        }
    }
}

fn gathered<M: Module, P: Place>(network: &M, gradients: &Gradients) -> Collected<P> {
    Collected::new(read_all::<P, M>(network, Some(gradients)))
}

/// Reads the gradient of every weight that has one to the host, by the weights' names, in either precision.
pub fn collect_gradients<M: Module, E: Element>(
    network: &M,
    gradients: &Gradients,
) -> BTreeMap<String, Vec<E>> {
    read_all::<Values<E>, M>(network, Some(gradients))
}
