//! Depthwise convolutions, normalisation and maxima against Burn's on the independent backend.
mod common;

use burn::tensor::{Device, Tensor};
use common::{check_slope, compare, random, reference, results, values};
use normalight_kernels::{
    BatchMoments, batch_norm, channels_first, channels_last, depthwise_relu, max_over_images,
    scale_channels,
};

#[test]
fn depthwise_convolutions_agree_with_the_reference() {
    for (shape, size, stride) in [
        ([2, 16, 16, 8], 3, 1),
        ([2, 16, 16, 8], 5, 1),
        ([9, 8, 8, 16], 5, 2),
        ([3, 6, 10, 24], 3, 2),
        ([2, 7, 5, 5], 3, 2),
        ([2, 5, 7, 33], 5, 1),
        ([1, 1, 1, 4], 5, 1),
        ([4, 6, 6, 12], 1, 1),
        ([4, 6, 6, 12], 1, 2),
        ([1, 4, 4, 3], 7, 1),
    ] {
        let (input, weight) = (random(&shape, 1), random(&[shape[3], 1, size, size], 2));
        let run = |device: &Device| {
            let bias = random(&[1], 3);
            results(device, [&input, &weight], &bias, |input, weight, _| {
                depthwise_relu(input, weight, stride)
            })
        };
        let (ours, expected) = (
            run(&Device::flex().autodiff()),
            run(&reference().autodiff()),
        );
        compare(
            &ours,
            &expected,
            1e-5,
            &format!("{shape:?} {size} {stride}"),
        );
    }
}

#[test]
fn gradients_are_slopes() {
    // Away from the kink of the ReLU.
    let input = |shape: &[usize]| {
        let values = random(shape, 1).try_to_vec::<f32>().unwrap();
        let values = values.into_iter().map(|v| v + 0.1f32.copysign(v));
        burn::tensor::TensorData::new(values.collect::<Vec<f32>>(), shape.to_vec())
    };
    for (size, stride, channels) in [(3, 1, 8), (5, 1, 20), (5, 2, 16), (1, 1, 3)] {
        let (input, weight) = (
            input(&[2, 6, 8, channels]),
            random(&[channels, 1, size, size], 2),
        );
        check_slope(
            [&input, &weight],
            &random(&[1], 3),
            0.02,
            |input, weight, _| depthwise_relu(input, weight, stride),
        );
    }
    let (map, gamma) = (input(&[3, 6, 5, 12]), random(&[12, 1, 1, 1], 2));
    check_slope(
        [&map, &gamma],
        &random(&[12], 3),
        0.01,
        |input, gamma, beta| {
            let moments = BatchMoments::new(&input);
            batch_norm(input, &moments, gamma.flatten(0, 3), beta, 1e-5)
        },
    );
    // Maxima that a small step does not change: the images are far apart.
    let far: Vec<f32> = (0..4 * 30)
        .map(|k| ((k / 30 * 7 + k % 30 * 5) % 4) as f32)
        .collect();
    let far = burn::tensor::TensorData::new(far, [4, 2, 3, 5]);
    check_slope(
        [&far, &random(&[1, 1, 1, 1], 2)],
        &random(&[1], 3),
        0.02,
        |input, _, _| max_over_images(input, 2),
    );
}

#[test]
fn normalisation_agrees_with_the_reference() {
    for shape in [[4, 8, 8, 8], [3, 5, 7, 5], [40, 16, 16, 24], [1, 1, 2, 64]] {
        // Far from zero, where sums of squares would lose their digits.
        let input = random(&shape, 1).try_to_vec::<f32>().unwrap();
        let input = input.into_iter().map(|value| 100.0 + 0.3 * value).collect();
        let input = burn::tensor::TensorData::new::<f32, _>(input, shape);
        let run = |device: &Device| {
            let (gamma, beta) = (random(&[shape[3], 1, 1, 1], 2), random(&[shape[3]], 3));
            results(device, [&input, &gamma], &beta, |input, gamma, beta| {
                let moments = BatchMoments::new(&input);
                batch_norm(input, &moments, gamma.flatten(0, 3), beta, 1e-5)
            })
        };
        let (ours, expected) = (
            run(&Device::flex().autodiff()),
            run(&reference().autodiff()),
        );
        // The reference sums in single precision: its own error is of this size.
        compare(&ours, &expected, 2e-3, &format!("{shape:?}"));
    }
}

/// A normalised map has mean beta and deviation gamma; shifting the input changes nothing, so its gradients sum to zero.
#[test]
fn normalised_maps_have_the_wanted_moments() {
    let device = Device::flex().autodiff();
    let input = Tensor::<4>::from_data(random(&[6, 8, 8, 10], 1), &device).require_grad();
    let gamma = Tensor::<1>::from_data(random(&[10], 2), &device);
    let beta = Tensor::<1>::from_data(random(&[10], 3), &device);
    let moments = BatchMoments::new(&input);
    let output = batch_norm(input.clone(), &moments, gamma.clone(), beta.clone(), 1e-9);
    let after = BatchMoments::new(&output);
    let close = |found: Tensor<1>, expected: Tensor<1>| {
        for (found, expected) in values(found).into_iter().zip(values(expected)) {
            assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
    };
    close(after.mean, beta);
    close(after.variance.sqrt(), gamma.abs());
    let factors = Tensor::<4>::from_data(random(&[6, 8, 8, 10], 5), &device);
    let gradients = (output * factors).sum().backward();
    let of_input = input.grad(&gradients).unwrap().reshape([6 * 64, 10]);
    for sum in values(of_input.sum_dim(0)) {
        assert!(sum.abs() < 1e-3, "{sum}");
    }
}

#[test]
fn known_statistics_scale_and_shift() {
    let device = Device::flex();
    let input = Tensor::<4>::ones([1, 2, 2, 2], &device);
    let scale = Tensor::<1>::from_floats([2.0, 3.0], &device);
    let shift = Tensor::<1>::from_floats([0.5, -1.0], &device);
    let output = values(scale_channels(input, scale, shift));
    assert_eq!(output, [2.5, 2.0, 2.5, 2.0, 2.5, 2.0, 2.5, 2.0]);
}

#[test]
fn maxima_agree_with_the_reference() {
    for (samples, images, map) in [(3, 5, [4, 6, 7]), (1, 12, [3, 3, 3]), (2, 1, [2, 2, 40])] {
        let shape = [samples * images, map[0], map[1], map[2]];
        let (input, unused) = (random(&shape, 1), random(&[1, 1, 1, 1], 2));
        let run = |device: &Device| {
            let bias = random(&[1], 3);
            results(device, [&input, &unused], &bias, |input, _, _| {
                max_over_images(input, samples)
            })
        };
        let (ours, expected) = (
            run(&Device::flex().autodiff()),
            run(&reference().autodiff()),
        );
        compare(&ours, &expected, 1e-6, &format!("{shape:?}"));
    }
}

#[test]
fn what_is_no_number_wins_the_maximum() {
    let device = Device::flex();
    for place in 0..3 {
        let mut input = vec![1.0f32, 2.0, 3.0];
        input[place] = f32::NAN;
        let data = burn::tensor::TensorData::new(input, [3, 1, 1, 1]);
        let most = max_over_images(Tensor::from_data(data, &device), 1);
        assert!(most.into_scalar::<f32>().is_nan());
    }
}

#[test]
fn poison_passes_through_depthwise_and_normalisation() {
    let shape = [1, 6, 6, 8];
    let mut data = random(&shape, 1).try_to_vec::<f32>().unwrap();
    data[(2 * 6 + 3) * 8 + 1] = f32::NAN;
    let data = burn::tensor::TensorData::new(data, shape);
    let device = Device::flex();
    let input = Tensor::<4>::from_data(data, &device);
    let weight = Tensor::<4>::ones([8, 1, 3, 3], &device);
    let output = values(depthwise_relu(input.clone(), weight, 1));
    let poisoned = output.iter().filter(|value| value.is_nan()).count();
    assert_eq!(poisoned, 9, "the nine outputs that see it, in one channel");
    let moments = BatchMoments::new(&input);
    let ones = Tensor::<1>::ones([8], &device);
    let output = values(batch_norm(input, &moments, ones.clone(), ones, 1e-5));
    let poisoned = output.iter().filter(|value| value.is_nan()).count();
    assert_eq!(poisoned, 36, "its whole channel");
}

#[test]
fn layouts_are_each_others_inverse() {
    let device = Device::flex();
    let input = Tensor::<4>::from_data(random(&[2, 3, 4, 5], 1), &device);
    assert_eq!(channels_last(input.clone()).dims(), [2, 4, 5, 3]);
    let back = channels_first(channels_last(input.clone()));
    assert_eq!(values(back), values(input));
}
