//! Operations run on our own path and on the independent backend, forward and backward.
#![allow(dead_code, reason = "every test file uses a part")]
#![allow(clippy::unwrap_used, reason = "what fails here fails a test")]

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

/// Central differences of a randomly weighted sum of the outputs along a random direction of input, weight and bias
/// together, against the gradients. The operation must have no kink within `step` of the point.
pub fn check_slope(
    [input, weight]: [&TensorData; 2],
    bias: &TensorData,
    step: f32,
    operation: impl Fn(Tensor<4>, Tensor<4>, Tensor<1>) -> Tensor<4>,
) {
    let device = Device::flex().autodiff();
    let numbers = |data: &TensorData| data.clone().try_to_vec::<f32>().unwrap();
    let points = [input, weight, bias].map(numbers);
    let directions = [(input, 11), (weight, 12), (bias, 13)]
        .map(|(data, seed)| numbers(&random(&data.shape().to_vec(), seed)));
    let value = |distance: f32| -> f64 {
        let moved: Vec<Vec<f32>> = points
            .iter()
            .zip(&directions)
            .map(|(point, direction)| {
                let both = point.iter().zip(direction);
                both.map(|(a, b)| a + distance * b).collect()
            })
            .collect();
        let data =
            |k: usize, like: &TensorData| TensorData::new(moved[k].clone(), like.shape().to_vec());
        let output = operation(
            Tensor::from_data(data(0, input), &device),
            Tensor::from_data(data(1, weight), &device),
            Tensor::from_data(data(2, bias), &device),
        );
        let factors = numbers(&random(&output.dims(), 4));
        let both = values(output).into_iter().zip(factors);
        both.map(|(a, b)| f64::from(a) * f64::from(b)).sum()
    };
    let found = (value(step) - value(-step)) / (2.0 * f64::from(step));
    let expected: f64 = results(&device, [input, weight], bias, &operation)
        .into_iter()
        .filter_map(|(name, gradient)| {
            let k = ["input", "weight", "bias"]
                .iter()
                .position(|n| *n == name)?;
            let both = gradient.iter().zip(&directions[k]);
            Some(
                both.map(|(a, b)| f64::from(*a) * f64::from(*b))
                    .sum::<f64>(),
            )
        })
        .sum();
    assert!(
        (found - expected).abs() < 0.01 * expected.abs().max(1.0),
        "slope {found}, gradients say {expected}"
    );
}
