//! Operations run on our own path and on the independent backend, forward and backward.
#![allow(dead_code, reason = "every test file uses a part")]

use burn::tensor::{Device, Tensor, TensorData};

/// Random numbers from -1 to 1. Burn's own come from one generator that all tests of a process share.
pub fn random(shape: &[usize], seed: u32) -> TensorData {
    let mut state = seed;
    let values = (0..shape.iter().product()).map(|_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 8_388_608.0 - 1.0
    });
    TensorData::new(values.collect::<Vec<f32>>(), shape.to_vec())
}

/// An independent implementation.
#[expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]
pub fn reference() -> Device {
    Device::ndarray()
}

pub fn values<const D: usize>(tensor: Tensor<D>) -> Vec<f32> {
    tensor.into_data().try_to_vec::<f32>().unwrap()
}

/// Names and numbers of an output and its gradients.
pub type Results = Vec<(&'static str, Vec<f32>)>;

/// Output of an operation on a feature map, a weight and a bias, and the gradients of its sum weighted at random.
pub fn results(
    device: &Device,
    [input, weight]: [&TensorData; 2],
    bias: &TensorData,
    operation: impl Fn(Tensor<4>, Tensor<4>, Tensor<1>) -> Tensor<4>,
) -> Results {
    let input = Tensor::<4>::from_data(input.clone(), device).require_grad();
    let weight = Tensor::<4>::from_data(weight.clone(), device).require_grad();
    let bias = Tensor::<1>::from_data(bias.clone(), device).require_grad();
    let output = operation(input.clone(), weight.clone(), bias.clone());
    let factors = Tensor::<4>::from_data(random(&output.dims(), 4), device);
    let gradients = (output.clone() * factors).sum().backward();
    let mut results = vec![("output", values(output))];
    for (name, gradient) in [
        ("input", input.grad(&gradients).map(values)),
        ("weight", weight.grad(&gradients).map(values)),
        ("bias", bias.grad(&gradients).map(values)),
    ] {
        if let Some(gradient) = gradient {
            results.push((name, gradient));
        }
    }
    results
}

/// Values differ by less than `tolerance` of the largest.
pub fn compare(ours: &Results, reference: &Results, tolerance: f32, case: &str) {
    assert_eq!(ours.len(), reference.len(), "{case}");
    for ((name, ours), (_, reference)) in ours.iter().zip(reference) {
        assert_eq!(ours.len(), reference.len(), "{case}, {name}");
        let size = reference.iter().fold(1.0f32, |most, v| most.max(v.abs()));
        for (index, (a, b)) in ours.iter().zip(reference).enumerate() {
            let close = (a - b).abs() < tolerance * size || a == b;
            assert!(close, "{case}, {name}, {index}: {a} {b}");
        }
    }
}
