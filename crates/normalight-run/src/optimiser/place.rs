//! Where an optimiser keeps its numbers: on the host, or on the device that the network is on.
use super::adam::AdamStep;
use super::muon::MuonStep;
use super::recipe::OptimiserRecipe;
use crate::named_tensors::{OnDevice, OnHost, Read, host, scalar};
use burn::tensor::{Device, Tensor, TensorData};
use std::fmt::Debug;

/// A place for moments and momentum, with the arithmetic of a step there. Both places give the same weights up to
/// rounding; checkpoints are the same.
pub(crate) trait Place:
    Read<Value: Debug + Clone + Send> + Debug + Clone + Send + 'static
{
    /// The reverse: a tensor on `device`, which may have gradients switched on.
    fn tensor<const D: usize>(
        numbers: Self::Value,
        shape: [usize; D],
        device: &Device,
    ) -> Tensor<D>;

    /// For checkpoints.
    fn to_host(numbers: &Self::Value) -> Vec<f32>;

    /// From checkpoints. `device`: a plain one.
    fn from_host(values: Vec<f32>, device: &Device) -> Self::Value;

    /// As many zeros.
    fn zeros(like: &Self::Value) -> Self::Value;

    /// Norm over everything; reads one number back at most.
    fn norm<'a>(all: impl Iterator<Item = &'a Self::Value>) -> f32;

    /// The weights after a step of Adam.
    fn adam(
        step: &AdamStep<'_>,
        weights: Self::Value,
        gradient: &Self::Value,
        moments: &mut [Self::Value; 2],
    ) -> Self::Value;

    /// The weights after a step of Muon.
    fn muon(
        step: &MuonStep<'_>,
        weights: Self::Value,
        gradient: &Self::Value,
        momentum: &mut Self::Value,
    ) -> Self::Value;
}

/// The least work for a processor, which has the numbers at hand anyway.
impl Place for OnHost {
    fn tensor<const D: usize>(numbers: Vec<f32>, shape: [usize; D], device: &Device) -> Tensor<D> {
        Tensor::from_data(TensorData::new(numbers, shape), device)
    }

    fn to_host(numbers: &Vec<f32>) -> Vec<f32> {
        numbers.clone()
    }

    fn from_host(values: Vec<f32>, _device: &Device) -> Vec<f32> {
        values
    }

    fn zeros(like: &Vec<f32>) -> Vec<f32> {
        vec![0.0; like.len()]
    }

    fn norm<'a>(all: impl Iterator<Item = &'a Vec<f32>>) -> f32 {
        let square: f64 = all.flatten().map(|&value| f64::from(value).powi(2)).sum();
        square.sqrt() as f32
    }

    fn adam(
        step: &AdamStep<'_>,
        mut weights: Vec<f32>,
        gradient: &Vec<f32>,
        moments: &mut [Vec<f32>; 2],
    ) -> Vec<f32> {
        step.apply(&mut weights, gradient, moments);
        weights
    }

    fn muon(
        step: &MuonStep<'_>,
        mut weights: Vec<f32>,
        gradient: &Vec<f32>,
        momentum: &mut Vec<f32>,
    ) -> Vec<f32> {
        step.apply(&mut weights, gradient, momentum);
        weights
    }
}

/// Nothing travels to the host and back at a step.
impl Place for OnDevice {
    fn tensor<const D: usize>(numbers: Tensor<1>, shape: [usize; D], device: &Device) -> Tensor<D> {
        let tensor = numbers.reshape(shape);
        if device.is_autodiff() {
            tensor.autodiff()
        } else {
            tensor
        }
    }

    fn to_host(numbers: &Tensor<1>) -> Vec<f32> {
        host(numbers.clone())
    }

    fn from_host(values: Vec<f32>, device: &Device) -> Tensor<1> {
        let count = values.len();
        Tensor::from_data(TensorData::new(values, [count]), device)
    }

    fn zeros(like: &Tensor<1>) -> Tensor<1> {
        like.zeros_like()
    }

    fn norm<'a>(all: impl Iterator<Item = &'a Tensor<1>>) -> f32 {
        let squares = all.map(|one| (one.clone() * one.clone()).sum());
        let sum = squares.reduce(|sum, one| sum + one);
        sum.map_or(0.0, |sum| scalar(sum).sqrt())
    }

    fn adam(
        step: &AdamStep<'_>,
        weights: Tensor<1>,
        gradient: &Tensor<1>,
        moments: &mut [Tensor<1>; 2],
    ) -> Tensor<1> {
        step.apply_on_device(weights, gradient, moments)
    }

    fn muon(
        step: &MuonStep<'_>,
        weights: Tensor<1>,
        gradient: &Tensor<1>,
        momentum: &mut Tensor<1>,
    ) -> Tensor<1> {
        step.apply_on_device(weights, gradient, momentum)
    }
}

/// What a step of either rule is told.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepSettings<'a> {
    pub(super) recipe: &'a OptimiserRecipe,
    /// Learning rate of the rule.
    pub(super) rate: f32,
    /// What clipping makes of the gradient.
    pub(super) scale: f32,
}
