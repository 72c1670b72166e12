//! Adam (Kingma & Ba 2015) on one tensor, with either kind of weight decay.
use super::place::StepSettings;
use super::recipe::Decay;
use burn::tensor::Tensor;

/// One step of one tensor.
pub(crate) struct AdamStep<'a> {
    pub(super) settings: StepSettings<'a>,
    /// Number of this step, from 1.
    pub(super) step: i32,
    /// Biases and normalisation are none.
    pub(super) is_kernel: bool,
}

/// The factors of a step.
struct Factors {
    /// Learning rate over the bias correction of the first moment.
    rate: f32,
    /// Bias correction of the second moment.
    correction: f32,
    /// Share of the weight that its gradient gets.
    coupled: f32,
    /// Share of the weight that stays.
    kept: f32,
}

impl AdamStep<'_> {
    fn factors(&self) -> Factors {
        let StepSettings { recipe, rate, .. } = self.settings;
        let [beta_1, beta_2] = recipe.betas;
        let (coupled, kept) = match recipe.decay {
            Decay::Coupled => (recipe.weight_decay, 1.0),
            Decay::Decoupled if self.is_kernel => (0.0, 1.0 - rate * recipe.weight_decay),
            Decay::Decoupled => (0.0, 1.0),
        };
        Factors {
            rate: rate / (1.0 - beta_1.powi(self.step)),
            correction: 1.0 / (1.0 - beta_2.powi(self.step)),
            coupled,
            kept,
        }
    }

    /// On the host.
    pub(super) fn apply(
        &self,
        weights: &mut [f32],
        gradient: &[f32],
        [first, second]: &mut [Vec<f32>; 2],
    ) {
        let StepSettings { recipe, scale, .. } = self.settings;
        let [beta_1, beta_2] = recipe.betas;
        let Factors {
            rate,
            correction,
            coupled,
            kept,
        } = self.factors();
        for (((weight, gradient), first), second) in
            weights.iter_mut().zip(gradient).zip(first).zip(second)
        {
            let gradient = gradient * scale + coupled * *weight;
            *first += (1.0 - beta_1) * (gradient - *first);
            *second += (1.0 - beta_2) * (gradient * gradient - *second);
            *weight *= kept;
            *weight -= rate * *first / ((*second * correction).sqrt() + recipe.epsilon);
        }
    }

    /// The same on a device; gives the new weights.
    pub(super) fn apply_on_device(
        &self,
        weights: Tensor<1>,
        gradient: &Tensor<1>,
        [first, second]: &mut [Tensor<1>; 2],
    ) -> Tensor<1> {
        let StepSettings { recipe, scale, .. } = self.settings;
        let [beta_1, beta_2] = recipe.betas;
        let factors = self.factors();
        let mut gradient = gradient.clone() * scale;
        if factors.coupled != 0.0 {
            gradient = gradient + weights.clone() * factors.coupled;
        }
        *first = first.clone() * beta_1 + gradient.clone() * (1.0 - beta_1);
        *second = second.clone() * beta_2 + gradient.clone() * gradient * (1.0 - beta_2);
        let root = (second.clone() * factors.correction).sqrt() + recipe.epsilon;
        weights * factors.kept - first.clone() * factors.rate / root
    }
}

#[cfg(test)]
mod tests {
    use super::super::recipe::OptimiserRecipe;
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
                let update = AdamStep {
                    settings: StepSettings {
                        recipe: &recipe,
                        rate: 0.01,
                        scale,
                    },
                    step,
                    is_kernel: true,
                };
                update.apply(&mut weights, &[gradient], &mut moments);
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
            let update = AdamStep {
                settings: StepSettings {
                    recipe: &recipe,
                    rate: 0.1,
                    scale: 1.0,
                },
                step: 1,
                is_kernel,
            };
            update.apply(&mut weights, &[0.0], &mut [vec![0.0], vec![0.0]]);
            assert_eq!(weights, [expected]);
        }
    }
}
