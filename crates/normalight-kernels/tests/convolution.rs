//! Our convolution against Burn's own on the independent backend, forward and backward.
#![expect(
    deprecated,
    reason = "the reference is pinned to the last Burn that has it"
)]

use burn::tensor::module::conv2d;
use burn::tensor::ops::ConvOptions;
use burn::tensor::{Device, Tensor, TensorData, activation};
use normalight_kernels::convolution;

struct Case {
    input: [usize; 4],
    channels_out: usize,
    size: usize,
    stride: usize,
    slope: f32,
}

const CASES: [Case; 6] = [
    case([3, 6, 32, 32], 16, 3, 1, 0.1),
    case([2, 16, 32, 32], 32, 3, 2, 0.1),
    case([9, 5, 7, 5], 3, 3, 2, 1.0),
    case([1, 4, 1, 1], 2, 3, 1, 0.1),
    case([2, 3, 9, 200], 4, 5, 1, 0.2),
    case([17, 8, 6, 3], 8, 1, 2, 0.1),
];

const fn case(
    input: [usize; 4],
    channels_out: usize,
    size: usize,
    stride: usize,
    slope: f32,
) -> Case {
    Case {
        input,
        channels_out,
        size,
        stride,
        slope,
    }
}

type Results = Vec<(&'static str, Vec<f32>)>;

/// Output and gradients of a weighted sum of the outputs.
fn results(case: &Case, device: &Device, ours: bool) -> Results {
    // Burn's own random numbers come from one generator that all tests of a process share.
    let data = |shape: &[usize], seed: u32| {
        let mut state = seed;
        let values = (0..shape.iter().product()).map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 8_388_608.0 - 1.0
        });
        TensorData::new(values.collect::<Vec<f32>>(), shape.to_vec())
    };
    let weight_shape = [case.channels_out, case.input[1], case.size, case.size];
    let input = Tensor::<4>::from_data(data(&case.input, 1), device).require_grad();
    let weight = Tensor::<4>::from_data(data(&weight_shape, 2), device).require_grad();
    let bias = Tensor::<1>::from_data(data(&[case.channels_out], 3), device).require_grad();
    let output = if ours {
        convolution(
            input.clone(),
            weight.clone(),
            bias.clone(),
            case.stride,
            case.slope,
        )
    } else {
        let options = ConvOptions::new([case.stride; 2], [case.size / 2; 2], [1; 2], 1);
        let output = conv2d(input.clone(), weight.clone(), Some(bias.clone()), options);
        activation::leaky_relu(output, f64::from(case.slope))
    };
    let weights = Tensor::<4>::from_data(data(&output.dims(), 4), device);
    let gradients = (output.clone() * weights).sum().backward();
    let values = |data: TensorData| data.try_to_vec::<f32>().unwrap();
    vec![
        ("output", values(output.into_data())),
        ("input", values(input.grad(&gradients).unwrap().into_data())),
        (
            "weight",
            values(weight.grad(&gradients).unwrap().into_data()),
        ),
        ("bias", values(bias.grad(&gradients).unwrap().into_data())),
    ]
}

fn compare(ours: &Results, reference: &Results, case: usize) {
    for ((name, ours), (_, reference)) in ours.iter().zip(reference) {
        assert_eq!(ours.len(), reference.len());
        let size = reference.iter().fold(1.0f32, |most, v| most.max(v.abs()));
        for (a, b) in ours.iter().zip(reference) {
            assert!((a - b).abs() < 2e-5 * size, "case {case}, {name}: {a} {b}");
        }
    }
}

#[test]
fn agrees_with_the_reference_forward_and_backward() {
    for (index, case) in CASES.iter().enumerate() {
        let ours = results(case, &Device::flex().autodiff(), true);
        let reference = results(case, &Device::ndarray().autodiff(), false);
        compare(&ours, &reference, index);
    }
}

#[test]
fn falls_back_to_burn_elsewhere() {
    let fallback = results(&CASES[1], &Device::ndarray().autodiff(), true);
    let reference = results(&CASES[1], &Device::ndarray().autodiff(), false);
    compare(&fallback, &reference, 1);
}

#[test]
fn gradients_repeat_bit_for_bit() {
    let device = Device::flex().autodiff();
    let once = results(&CASES[0], &device, true);
    assert_eq!(once, results(&CASES[0], &device, true));
}

#[test]
fn frozen_inputs_and_plain_devices_work() {
    let device = Device::flex();
    let input = Tensor::<4>::ones([2, 3, 8, 8], &device);
    let weight = Tensor::<4>::ones([4, 3, 3, 3], &device);
    let output = convolution(input, weight, Tensor::zeros([4], &device), 1, 0.1);
    // Corners see four of nine taps, edges six.
    let values = output.into_data().try_to_vec::<f32>().unwrap();
    assert_eq!(&values[..3], [12.0, 18.0, 18.0]);
    assert_eq!(values[9], 27.0);

    let training = device.autodiff();
    let input = Tensor::<4>::ones([2, 3, 8, 8], &training);
    let weight = Tensor::<4>::ones([4, 3, 3, 3], &training).require_grad();
    let bias = Tensor::<1>::zeros([4], &training);
    let output = convolution(input, weight.clone(), bias, 1, 0.1);
    let gradients = output.sum().backward();
    let centre = weight
        .grad(&gradients)
        .unwrap()
        .into_data()
        .try_to_vec::<f32>();
    assert_eq!(centre.unwrap()[4], 128.0);
}
