//! Muon (Jordan et al. 2024, "Muon: an optimizer for hidden layers in neural networks") on one matrix: gradients with
//! momentum, made orthogonal, so that every direction of a layer's input moves at the same pace.
use super::place::StepSettings;
use super::recipe::{Decay, DepthwiseRule, MuonRecipe};
use crate::named_tensors::host;
use burn::tensor::{Device, Tensor, TensorData};
use normalight_kernels::orthogonalised;

/// Newton-Schulz steps of an update, as published.
const STEPS: usize = 5;

/// How a weight is a matrix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Convolutions by output channel, `[out, in * height * width]`, and layers `[in, out]`.
    Matrix {
        rows: usize,
        columns: usize,
        /// Inputs and outputs, for the length of the step.
        fan: [usize; 2],
    },
    /// Depthwise convolutions: every channel a matrix of one row, which is orthogonal when its length is one.
    Filters { taps: usize },
}

impl Shape {
    /// Nothing for weights that stay Adam's: those of one dimension, those of output layers and, unless the recipe says
    /// otherwise, depthwise ones.
    pub(super) fn of(path: &str, dims: &[usize], recipe: &MuonRecipe) -> Option<Self> {
        let layer = path.rsplit('.').nth(1);
        if layer == Some("output") {
            return None;
        }
        match *dims {
            [inputs, outputs] => Some(Self::Matrix {
                rows: inputs,
                columns: outputs,
                fan: [inputs, outputs],
            }),
            [_, 1, height, width] => match recipe.depthwise {
                DepthwiseRule::Adam => None,
                DepthwiseRule::Filters => Some(Self::Filters {
                    taps: height * width,
                }),
            },
            [outputs, inputs, height, width] => {
                let inputs = inputs * height * width;
                Some(Self::Matrix {
                    rows: outputs,
                    columns: inputs,
                    fan: [inputs, outputs],
                })
            }
            _ => None,
        }
    }
}

/// What the length of an orthogonal update is multiplied by, for a matrix of so many inputs and outputs.
fn length([inputs, outputs]: [usize; 2]) -> f32 {
    (outputs as f32 / inputs as f32).max(1.0).sqrt()
}

/// One step of one tensor.
pub(crate) struct MuonStep<'a> {
    pub(super) settings: StepSettings<'a>,
    pub(super) shape: Shape,
    /// Where matrices are multiplied.
    pub(super) device: Device,
}

impl MuonStep<'_> {
    /// Share of a weight that its gradient gets, and share that stays.
    fn decay(&self) -> (f32, f32) {
        let StepSettings { recipe, rate, .. } = self.settings;
        match recipe.decay {
            Decay::Coupled => (recipe.weight_decay, 1.0),
            Decay::Decoupled => (0.0, 1.0 - rate * recipe.weight_decay),
        }
    }

    /// On the host.
    pub(super) fn apply(&self, weights: &mut [f32], gradient: &[f32], momentum: &mut [f32]) {
        let StepSettings {
            recipe,
            rate,
            scale,
        } = self.settings;
        let beta = recipe.muon.momentum;
        let (coupled, kept) = self.decay();
        // Nesterov's form: the gradient as the momentum will see it next.
        let ahead: Vec<f32> = gradient
            .iter()
            .zip(momentum)
            .zip(&*weights)
            .map(|((gradient, momentum), weight)| {
                let gradient = gradient * scale + coupled * weight;
                *momentum = beta * *momentum + gradient;
                gradient + beta * *momentum
            })
            .collect();
        let (update, length) = self.orthogonal(ahead);
        for (weight, update) in weights.iter_mut().zip(update) {
            *weight = kept * *weight - rate * length * update;
        }
    }

    /// The same on a device; gives the new weights.
    pub(super) fn apply_on_device(
        &self,
        weights: Tensor<1>,
        gradient: &Tensor<1>,
        momentum: &mut Tensor<1>,
    ) -> Tensor<1> {
        let StepSettings {
            recipe,
            rate,
            scale,
        } = self.settings;
        let beta = recipe.muon.momentum;
        let (coupled, kept) = self.decay();
        let mut gradient = gradient.clone() * scale;
        if coupled != 0.0 {
            gradient = gradient + weights.clone() * coupled;
        }
        *momentum = momentum.clone() * beta + gradient.clone();
        let ahead = gradient + momentum.clone() * beta;
        let count = ahead.dims()[0];
        let update = match self.shape {
            Shape::Matrix { rows, columns, fan } => {
                orthogonalised(ahead.reshape([rows, columns]), STEPS) * length(fan)
            }
            Shape::Filters { taps } => {
                let filters = ahead.reshape([count / taps, taps]);
                let norms = (filters.clone() * filters.clone()).sum_dim(1).sqrt();
                filters / norms.clamp_min(f32::MIN_POSITIVE)
            }
        };
        weights * kept - update.reshape([count]) * rate
    }

    /// The update made orthogonal, and what its length is multiplied by.
    fn orthogonal(&self, mut update: Vec<f32>) -> (Vec<f32>, f32) {
        match self.shape {
            Shape::Matrix {
                rows,
                columns,
                fan: [inputs, outputs],
            } => {
                let data = TensorData::new(update, [rows, columns]);
                let matrix = Tensor::<2>::from_data(data, &self.device);
                (
                    host(orthogonalised(matrix, STEPS)),
                    length([inputs, outputs]),
                )
            }
            Shape::Filters { taps } => {
                for filter in update.chunks_exact_mut(taps) {
                    let square: f32 = filter.iter().map(|value| value * value).sum();
                    let norm = square.sqrt().max(f32::MIN_POSITIVE);
                    filter.iter_mut().for_each(|value| *value /= norm);
                }
                (update, 1.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::recipe::OptimiserRecipe;
    use super::*;

    fn recipe() -> OptimiserRecipe {
        OptimiserRecipe::default()
    }

    #[test]
    fn which_weights_are_matrices() {
        let adam = MuonRecipe::default();
        let filters = MuonRecipe {
            depthwise: DepthwiseRule::Filters,
            ..adam.clone()
        };
        let matrix = Some(Shape::Matrix {
            rows: 32,
            columns: 144,
            fan: [144, 32],
        });
        for (path, dims, expected) in [
            ("network.body.down.1.weight", &[32, 16, 3, 3][..], matrix),
            ("network.body.output.weight", &[3, 16, 3, 3], None),
            ("network.body.down.1.bias", &[32], None),
            ("cell.depthwise.weight", &[32, 1, 5, 5], None),
            ("output.weight", &[128, 92], None),
        ] {
            assert_eq!(Shape::of(path, dims, &adam), expected, "{path}");
        }
        let depthwise = Shape::of("cell.depthwise.weight", &[32, 1, 5, 5], &filters);
        assert_eq!(depthwise, Some(Shape::Filters { taps: 25 }));
    }

    /// Two steps of a matrix whose singular values are known by hand, with the published formulas in double precision:
    /// multiples of a rotation have one singular value, so the update is the rotation times the polynomial's value.
    #[test]
    fn two_steps_as_published() {
        let quintic = |x: f64| 3.4445 * x - 4.7750 * x.powi(3) + 2.0315 * x.powi(5);
        // Both singular values are 1 / sqrt(2) of the Frobenius norm.
        let value = (0..5).fold(0.5f64.sqrt(), |x, _| quintic(x));
        let rotation = [0.6f64, -0.8, 0.8, 0.6];
        let (rate, beta) = (0.02, 0.95);
        let mut expected = [1.0, 2.0, 3.0, 4.0];
        let mut momentum = 0.0f64;
        let recipe = recipe();
        let step = MuonStep {
            settings: StepSettings {
                recipe: &recipe,
                rate: rate as f32,
                scale: 0.5,
            },
            shape: Shape::Matrix {
                rows: 2,
                columns: 2,
                fan: [2, 2],
            },
            device: Device::flex(),
        };
        let mut weights = [1.0f32, 2.0, 3.0, 4.0];
        let mut state = [0.0; 4];
        // The second gradient is large enough to turn the momentum around.
        for factor in [1.0, -3.0] {
            let gradient = rotation.map(|r| (factor * r) as f32);
            step.apply(&mut weights, &gradient, &mut state);
            momentum = beta * momentum + 0.5 * factor;
            let sign = (0.5 * factor + beta * momentum).signum();
            for (weight, r) in expected.iter_mut().zip(rotation) {
                *weight -= rate * sign * value * r;
            }
        }
        for (weight, expected) in weights.iter().zip(expected) {
            assert!(
                (f64::from(*weight) - expected).abs() < 1e-5,
                "{weights:?}, {expected:?}"
            );
        }
    }

    /// Wide layers take longer steps; weights decay by Muon's own rate.
    #[test]
    fn length_and_decay() {
        let recipe = OptimiserRecipe {
            weight_decay: 0.5,
            ..recipe()
        };
        let step = MuonStep {
            settings: StepSettings {
                recipe: &recipe,
                rate: 0.1,
                scale: 1.0,
            },
            shape: Shape::Matrix {
                rows: 4,
                columns: 1,
                fan: [1, 4],
            },
            device: Device::flex(),
        };
        let mut weights = [1.0; 4];
        step.apply(&mut weights, &[0.0; 4], &mut [0.0; 4]);
        assert_eq!(weights, [0.95; 4]);
        let mut weights = [0.0; 4];
        step.apply(&mut weights, &[3.0, 0.0, 0.0, 0.0], &mut [0.0; 4]);
        let length = weights[0] / -0.1;
        assert!((2.0 * 0.65..2.0 * 1.25).contains(&length), "{length}");
    }

    /// Every channel of a depthwise convolution moves equally far.
    #[test]
    fn filters_by_themselves() {
        let recipe = recipe();
        let step = MuonStep {
            settings: StepSettings {
                recipe: &recipe,
                rate: 1.0,
                scale: 1.0,
            },
            shape: Shape::Filters { taps: 2 },
            device: Device::flex(),
        };
        let mut weights = [0.0; 6];
        step.apply(
            &mut weights,
            &[30.0, 40.0, 0.0, 1e-6, 0.0, 0.0],
            &mut [0.0; 6],
        );
        let expected = [-0.6, -0.8, 0.0, -1.0, 0.0, 0.0];
        for (weight, expected) in weights.iter().zip(expected) {
            assert!((weight - expected).abs() < 1e-5, "{weights:?}");
        }
    }
}
