//! The exponential moving average of a network's numbers.
use crate::named_tensors::{NamedTensors, OnDevice, collect, read_all};
use crate::optimiser::StepsOn;
use crate::optimiser::place::Place;
use burn::module::Module;
use burn::tensor::{Device, Tensor};
use std::collections::BTreeMap;

/// Weights averaged over the last steps: they generalise better than those of any one step.
#[derive(Debug)]
pub struct Average {
    decay: f32,
    values: Values,
}

/// By name, where the optimiser has its numbers.
#[derive(Debug)]
enum Values {
    Host(NamedTensors),
    Device(BTreeMap<String, Tensor<1>>),
}

impl Average {
    /// Begins with a network's numbers. `decay`: share of the average that a step leaves; 0 gives none. `network`: one
    /// without gradients, through `valid()`.
    pub fn new<M: Module>(decay: f32, place: StepsOn, network: &M) -> Option<Self> {
        let values = || match place {
            StepsOn::Host => Values::Host(collect(network)),
            StepsOn::Device => Values::Device(read_all::<OnDevice, M>(network, None)),
        };
        (decay > 0.0).then(|| Self {
            decay,
            values: values(),
        })
    }

    /// Takes in the numbers after step `step` (from 1). The first steps count more than the decay
    /// says, so that the random start is forgotten quickly. `network` as in [`Self::new`].
    pub fn add<M: Module>(&mut self, step: usize, network: &M) {
        let share = (1.0 + step as f32) / (10.0 + step as f32);
        let kept = self.decay.min(share);
        match &mut self.values {
            Values::Host(averages) => blend(averages, &collect(network), kept),
            Values::Device(averages) => {
                for (name, now) in read_all::<OnDevice, M>(network, None) {
                    if let Some(average) = averages.get_mut(&name) {
                        *average = average.clone() + (now - average.clone()) * (1.0 - kept);
                    }
                }
            }
        }
    }

    /// The averages by name, on the host.
    pub fn values(&self) -> NamedTensors {
        match &self.values {
            Values::Host(values) => values.clone(),
            Values::Device(values) => {
                let values = values.iter();
                let host = values.map(|(name, one)| (name.clone(), OnDevice::to_host(one)));
                host.collect()
            }
        }
    }

    /// Replaces the averages by those of a checkpoint. `device`: where the network is, without gradients.
    pub fn restore(&mut self, values: NamedTensors, device: &Device) {
        self.values = match self.values {
            Values::Host(_) => Values::Host(values),
            Values::Device(_) => {
                let tensor = |(name, values)| (name, OnDevice::from_host(values, device));
                Values::Device(values.into_iter().map(tensor).collect())
            }
        };
    }
}

fn blend(averages: &mut NamedTensors, now: &NamedTensors, kept: f32) {
    for (name, average) in averages {
        let Some(now) = now.get(name) else { continue };
        for (average, now) in average.iter_mut().zip(now) {
            *average += (1.0 - kept) * (now - *average);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use burn::module::Param;

    #[derive(Module, Debug)]
    struct One {
        a: Param<Tensor<1>>,
    }

    fn one(value: f32) -> One {
        One {
            a: Param::from_tensor(Tensor::from_floats([value], &Device::flex())),
        }
    }

    #[test]
    fn it_follows_and_forgets_the_start() {
        for place in [StepsOn::Host, StepsOn::Device] {
            assert!(Average::new(0.0, place, &one(1.0)).is_none());
            let mut average = Average::new(0.999, place, &one(100.0)).unwrap();
            for step in 1..=300 {
                average.add(step, &one(1.0));
            }
            let value = average.values()["a"][0];
            assert!((value - 1.0).abs() < 1e-3, "{value}");
            // Later a step moves it by one part in a thousand; what comes from a checkpoint goes on.
            let values = average.values();
            average.restore(values, &Device::flex());
            average.add(1_000_000, &one(2.0));
            let moved = average.values()["a"][0] - value;
            assert!((moved - 1e-3).abs() < 1e-4, "{moved}");
        }
    }
}
