//! Our convolutions against Burn's on the independent backend, forward and backward.
mod common;

use burn::tensor::{Device, Tensor};
use common::{Results, check_slope, compare, random, reference, results, values};
use normalight_kernels::{Convolution, convolution, depthwise_relu, transposed_convolution};

#[derive(Debug, Clone, Copy)]
struct Case {
    input: [usize; 4],
    outputs: usize,
    size: usize,
    how: Convolution,
}

const fn case(input: [usize; 4], outputs: usize, size: usize, how: [usize; 3], slope: f32) -> Case {
    let [stride, shift, upsampling] = how;
    let how = Convolution {
        stride,
        shift,
        upsampling,
        slope,
    };
    Case {
        input,
        outputs,
        size,
        how,
    }
}

/// Narrow and wide, odd and even, with rests of every vector length; the first half by Winograd.
const CASES: [Case; 14] = [
    case([3, 8, 8, 16], 16, 3, [1, 0, 1], 0.1),
    case([2, 16, 16, 32], 48, 3, [1, 0, 1], 1.0),
    case([9, 7, 5, 20], 9, 3, [1, 0, 1], 0.1),
    case([2, 4, 6, 24], 17, 3, [1, 0, 2], 0.1),
    case([1, 30, 70, 8], 8, 3, [1, 0, 1], 0.3),
    case([11, 4, 4, 40], 33, 3, [1, 0, 1], 0.1),
    case([3, 32, 32, 6], 16, 3, [1, 0, 1], 0.1),
    case([2, 32, 32, 16], 32, 3, [2, 0, 1], 0.1),
    case([9, 7, 5, 5], 3, 3, [2, 0, 1], 1.0),
    case([1, 1, 1, 4], 2, 3, [1, 0, 1], 0.1),
    case([2, 9, 200, 3], 4, 5, [1, 0, 1], 0.2),
    case([17, 6, 3, 8], 8, 1, [2, 0, 1], 0.1),
    case([2, 6, 8, 9], 20, 1, [2, 1, 1], 1.0),
    case([2, 6, 8, 33], 7, 1, [1, 0, 1], 1.0),
];

fn run(case: &Case, device: &Device) -> Results {
    let channels = case.input[3];
    let weight = random(&[case.outputs, channels, case.size, case.size], 2);
    let (input, bias) = (random(&case.input, 1), random(&[case.outputs], 3));
    results(device, [&input, &weight], &bias, |input, weight, bias| {
        convolution(input, weight, bias, case.how)
    })
}

#[test]
fn agrees_with_the_reference_forward_and_backward() {
    for case in &CASES {
        let ours = run(case, &Device::flex().autodiff());
        let expected = run(case, &reference().autodiff());
        compare(&ours, &expected, 3e-5, &format!("{case:?}"));
    }
}

#[test]
fn transposed_convolutions_agree_with_the_reference() {
    for (shape, outputs, slope) in [
        ([3, 4, 4, 8], 16, 0.1),
        ([2, 5, 3, 7], 5, 1.0),
        ([9, 8, 8, 33], 24, 0.1),
    ] {
        let (input, weight) = (random(&shape, 1), random(&[shape[3], outputs, 4, 4], 2));
        let run = |device: &Device| {
            let bias = random(&[outputs], 3);
            results(device, [&input, &weight], &bias, |input, weight, bias| {
                transposed_convolution(input, weight, bias, slope)
            })
        };
        let (ours, expected) = (
            run(&Device::flex().autodiff()),
            run(&reference().autodiff()),
        );
        compare(&ours, &expected, 3e-5, &format!("{shape:?}"));
    }
}

#[test]
fn gradients_are_slopes() {
    for case in &CASES {
        // Without the activation's kinks.
        let how = Convolution {
            slope: 1.0,
            ..case.how
        };
        let weight = random(&[case.outputs, case.input[3], case.size, case.size], 2);
        let (input, bias) = (random(&case.input, 1), random(&[case.outputs], 3));
        check_slope([&input, &weight], &bias, 0.02, |input, weight, bias| {
            convolution(input, weight, bias, how)
        });
    }
    let (input, weight) = (random(&[3, 5, 4, 9], 1), random(&[9, 6, 4, 4], 2));
    check_slope(
        [&input, &weight],
        &random(&[6], 3),
        0.02,
        |input, weight, bias| transposed_convolution(input, weight, bias, 1.0),
    );
}

#[test]
fn what_is_no_number_stays_none() {
    let (height, width) = (8, 8);
    for (channels, size, stride) in [(16, 3, 1), (6, 3, 1), (16, 3, 2), (16, 1, 1)] {
        for poison in [f32::NAN, f32::INFINITY] {
            let mut data = random(&[1, height, width, channels], 1)
                .try_to_vec::<f32>()
                .unwrap();
            data[(2 * width + 5) * channels + 3] = poison;
            let data = burn::tensor::TensorData::new(data, [1, height, width, channels]);
            let run = |device: &Device| {
                let input = Tensor::<4>::from_data(data.clone(), device);
                let weight = Tensor::from_data(random(&[16, channels, size, size], 2), device);
                let how = Convolution {
                    stride,
                    slope: 0.1,
                    ..Convolution::default()
                };
                values(convolution(input, weight, Tensor::zeros([16], device), how))
            };
            let expected = run(&reference());
            assert!(expected.iter().any(|value| !value.is_finite()));
            // Ours may spoil the rest of a tile, too, but never hides it.
            for (ours, expected) in run(&Device::flex()).into_iter().zip(expected) {
                assert!(expected.is_finite() || !ours.is_finite());
            }
        }
    }
}

#[test]
fn tiny_numbers_do_not_vanish() {
    let tiny = 1e-39f32;
    for (channels, size) in [(16, 3), (6, 3), (16, 1)] {
        let device = Device::flex();
        let input = Tensor::<4>::full([1, 8, 8, channels], tiny, &device);
        let weight = Tensor::ones([16, channels, size, size], &device);
        let how = Convolution::default();
        let output = values(convolution(
            input,
            weight,
            Tensor::zeros([16], &device),
            how,
        ));
        let expected = tiny * (channels * size * size) as f32;
        let centre = output[(4 * 8 + 4) * 16];
        assert!(
            (centre / expected - 1.0).abs() < 1e-3,
            "{centre} {expected}"
        );
    }
}

#[test]
fn gradients_repeat_bit_for_bit() {
    let device = Device::flex().autodiff();
    for case in [&CASES[1], &CASES[7]] {
        assert_eq!(run(case, &device), run(case, &device));
    }
}

#[test]
fn frozen_inputs_and_plain_devices_work() {
    let device = Device::flex();
    let input = Tensor::<4>::ones([2, 8, 8, 3], &device);
    let weight = Tensor::<4>::ones([4, 3, 3, 3], &device);
    let how = Convolution::default();
    let output = values(convolution(input, weight, Tensor::zeros([4], &device), how));
    // Corners see four of nine taps, edges six.
    assert_eq!([output[0], output[4], output[9 * 4]], [12.0, 18.0, 27.0]);

    let training = device.autodiff();
    let input = Tensor::<4>::ones([2, 8, 8, 3], &training);
    let weight = Tensor::<4>::ones([4, 3, 3, 3], &training).require_grad();
    let output = convolution(input, weight.clone(), Tensor::zeros([4], &training), how);
    let gradients = output.sum().backward();
    assert_eq!(values(weight.grad(&gradients).unwrap())[4], 128.0);
}

/// Gradients of the input do not depend on whether those of the weights are asked for.
#[test]
fn frozen_weights_change_no_other_gradient() {
    type Operation = fn(Tensor<4>, Tensor<4>) -> Tensor<4>;
    let convolved: Operation = |input, weight| {
        let bias = Tensor::zeros([weight.dims()[0]], &input.device());
        convolution(input, weight, bias, Convolution::default())
    };
    let depthwise: Operation = |input, weight| depthwise_relu(input, weight, 2);
    for (channels, weight, operation) in [
        (16, [24, 16, 3, 3], convolved),
        (7, [5, 7, 1, 1], convolved),
        (9, [9, 1, 5, 5], depthwise),
    ] {
        let device = Device::flex().autodiff();
        let of_input = |frozen: bool| {
            let input = random(&[2, 12, 8, channels], 1);
            let input = Tensor::<4>::from_data(input, &device).require_grad();
            let weight = Tensor::<4>::from_data(random(&weight, 2), &device);
            let weight = weight.set_require_grad(!frozen);
            let gradients = operation(input.clone(), weight.clone()).sum().backward();
            assert_eq!(weight.grad(&gradients).is_none(), frozen);
            values(input.grad(&gradients).unwrap())
        };
        assert_eq!(of_input(true), of_input(false));
    }
}
