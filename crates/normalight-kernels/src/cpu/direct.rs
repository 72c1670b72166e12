//! Convolutions of any size and stride as matrix products over a copy of the rows that the kernel sees.
use crate::cpu::buffer::Buffer;
use crate::cpu::geometry::{Filter, Geometry, Part, PartGradients};
use crate::cpu::product::{Finish, Left, Product, Right};
use crate::cpu::window::{Window, add, add_window, copy_window};
use std::ops::Range;

/// Floats of the rows that are copied at a time: a quarter of the second-level cache.
const PATCH: usize = 1 << 16;

/// Output rows that are worked on together.
pub(crate) fn block(geometry: &Geometry) -> usize {
    if geometry.pointwise() {
        return (PATCH / (geometry.out_width() * geometry.channels_in)).max(1);
    }
    let row = geometry.seen_width() * geometry.channels_in * geometry.stride;
    (PATCH / row).max(1)
}

/// What some output rows see.
fn window(geometry: &Geometry, rows: &Range<usize>) -> Window {
    Window {
        first_row: (rows.start * geometry.stride) as isize + geometry.origin,
        rows: (rows.len() - 1) * geometry.stride + geometry.size,
        first_column: geometry.origin,
        columns: geometry.seen_width(),
    }
}

/// Some output rows of one image.
///
/// # Shapes
/// - image: `[stored height, stored width, channels_in]`
/// - filter: weights `[size, size, channels_in, channels_out]`
/// - output: `[rows, out_width, channels_out]`
pub(crate) fn forward(
    geometry: &Geometry,
    rows: Range<usize>,
    image: &[f32],
    filter: &Filter<'_>,
    output: &mut [f32],
) {
    let Filter {
        weight,
        bias,
        slope,
    } = *filter;
    let (width, channels_in) = (geometry.out_width(), geometry.channels_in);
    let channels_out = geometry.channels_out;
    let finish = Finish::Activated { bias, slope };
    if geometry.pointwise() {
        Product {
            size: [rows.len() * width, channels_out],
            counts: [1, channels_in],
            left: Left::rows(&image[rows.start * width * channels_in..], channels_in),
            right: Right::rows(weight, channels_out),
            output,
            output_row: channels_out,
            finish,
        }
        .compute();
        return;
    }
    let window = window(geometry, &rows);
    let mut patch = Buffer::recycled(window.floats(channels_in));
    copy_window(geometry, window, image, &mut patch);
    let line = window.columns * channels_in;
    let run = geometry.size * channels_in;
    for (row, output) in output.chunks_exact_mut(width * channels_out).enumerate() {
        Product {
            size: [width, channels_out],
            counts: [geometry.size, run],
            left: Left {
                values: &patch[row * geometry.stride * line..],
                row: geometry.stride * channels_in,
                steps: [line, 1],
            },
            right: Right {
                values: weight,
                steps: [run * channels_out, channels_out],
            },
            output,
            output_row: channels_out,
            finish,
        }
        .compute();
    }
}

/// Adds the gradients of weights and bias, and writes those of the input.
pub(crate) fn add_gradients(part: &Part<'_>, gradients: &mut PartGradients<'_>) {
    let geometry = part.geometry;
    // Without activation the gradients of the sums are those of the output.
    let copied = part.slope != 1.0 || part.wants_bias;
    let mut before = Buffer::recycled(if copied { geometry.image_out() } else { 0 });
    let images = part
        .input
        .chunks_exact(geometry.image_in())
        .zip(part.output.chunks_exact(geometry.image_out()))
        .zip(part.gradient.chunks_exact(geometry.image_out()));
    for (index, ((image, output), gradient)) in images.enumerate() {
        let before: &[f32] = if copied {
            before_activation(output, gradient, part.slope, gradients.bias, &mut before);
            &before
        } else {
            gradient
        };
        if !gradients.weight.is_empty() {
            add_to_weight(geometry, image, before, gradients.weight);
        }
        if !gradients.input.is_empty() {
            let size = geometry.image_in();
            let grad_image = &mut gradients.input[index * size..(index + 1) * size];
            grad_image.fill(0.0);
            add_to_image(geometry, part.transposed, before, grad_image);
        }
    }
}

/// Adds the gradient of the weights.
///
/// # Shapes
/// - image: `[stored height, stored width, channels_in]`
/// - before: gradient of the sums before the activation, `[out_height, out_width, channels_out]`
/// - grad_weight: `[size, size, channels_in, channels_out]`
pub(crate) fn add_to_weight(
    geometry: &Geometry,
    image: &[f32],
    before: &[f32],
    grad_weight: &mut [f32],
) {
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    let (height, width) = (geometry.out_height(), geometry.out_width());
    let window = window(geometry, &(0..height));
    let mut copy = Buffer::recycled(0);
    let patch: &[f32] = if geometry.pointwise() {
        image
    } else {
        copy = Buffer::recycled(window.floats(channels_in));
        copy_window(geometry, window, image, &mut copy);
        &copy
    };
    let line = window.columns * channels_in;
    let run = geometry.size * channels_in;
    let taps = grad_weight.chunks_exact_mut(run * channels_out);
    for (tap_row, grad_weight) in taps.enumerate() {
        Product {
            size: [run, channels_out],
            counts: [height, width],
            left: Left {
                values: &patch[tap_row * line..],
                row: 1,
                steps: [geometry.stride * line, geometry.stride * channels_in],
            },
            right: Right {
                values: before,
                steps: [width * channels_out, channels_out],
            },
            output: grad_weight,
            output_row: channels_out,
            finish: Finish::Added,
        }
        .compute();
    }
    drop(copy);
}

/// Adds the gradient of an image (for pointwise convolutions: writes it).
///
/// # Shapes
/// - transposed: `[channels_out, size, size, channels_in]`
/// - before: gradient of the sums before the activation, `[out_height, out_width, channels_out]`
/// - grad_image: `[stored height, stored width, channels_in]`
pub(crate) fn add_to_image(
    geometry: &Geometry,
    transposed: &[f32],
    before: &[f32],
    grad_image: &mut [f32],
) {
    let (channels_in, channels_out) = (geometry.channels_in, geometry.channels_out);
    let (width, taps) = (geometry.out_width(), geometry.taps());
    let product = |pixels: usize, before: &[f32], output: &mut [f32]| {
        Product {
            size: [pixels, taps],
            counts: [1, channels_out],
            left: Left::rows(before, channels_out),
            right: Right::rows(transposed, taps),
            output,
            output_row: taps,
            finish: Finish::Stored,
        }
        .compute();
    };
    if geometry.pointwise() {
        product(geometry.out_area(), before, grad_image);
        return;
    }
    let mut unfolded = Buffer::recycled(width * taps);
    let line = geometry.seen_width() * channels_in;
    let run = geometry.size * channels_in;
    let mut patch = Buffer::recycled(geometry.size * line);
    for (row, before) in before.chunks_exact(width * channels_out).enumerate() {
        product(width, before, &mut unfolded);
        patch.fill(0.0);
        pulp::Arch::new().dispatch(|| {
            for (x, pixel) in unfolded.chunks_exact(taps).enumerate() {
                let from = x * geometry.stride * channels_in;
                for (patch, pixel) in patch.chunks_exact_mut(line).zip(pixel.chunks_exact(run)) {
                    add(&mut patch[from..from + run], pixel);
                }
            }
        });
        add_window(
            geometry,
            window(geometry, &(row..row + 1)),
            &patch,
            grad_image,
        );
    }
}

/// Gradients of the sums before bias and activation; adds up those of the bias.
pub(crate) fn before_activation(
    output: &[f32],
    gradient: &[f32],
    slope: f32,
    grad_bias: &mut [f32],
    before: &mut [f32],
) {
    pulp::Arch::new().dispatch(|| {
        for ((value, gradient), output) in before.iter_mut().zip(gradient).zip(output) {
            *value = if *output > 0.0 {
                *gradient
            } else {
                slope * gradient
            };
        }
        for pixel in before.chunks_exact(grad_bias.len()) {
            add(grad_bias, pixel);
        }
    });
}
