//! The maximum over the images of a sample, and which image it came from.
use crate::cpu::buffer::Buffer;
use rayon::prelude::*;

/// Values that are worked on together.
const BLOCK: usize = 1 << 10;

/// The maximum over `images` groups of `size` floats for every sample, and the number of the image that has it (the
/// first of equals). NaN counts as larger than every number.
pub(crate) fn forward(input: &[f32], images: usize, size: usize) -> (Buffer, Vec<u32>) {
    let samples = input.len() / (images * size).max(1);
    let mut largest = Buffer::recycled(samples * size);
    let mut which = vec![0u32; samples * size];
    let block = size.clamp(1, BLOCK);
    largest
        .par_chunks_mut(size.max(1))
        .zip(which.par_chunks_mut(size.max(1)))
        .zip(input.par_chunks((images * size).max(1)))
        .for_each(|((largest, which), sample)| {
            let blocks = largest.chunks_mut(block).zip(which.chunks_mut(block));
            pulp::Arch::new().dispatch(|| {
                for (index, (largest, which)) in blocks.enumerate() {
                    let from = index * block;
                    largest.copy_from_slice(&sample[from..from + largest.len()]);
                    for (image, values) in sample.chunks_exact(size).enumerate().skip(1) {
                        let values = &values[from..from + largest.len()];
                        for ((largest, which), value) in
                            largest.iter_mut().zip(which.iter_mut()).zip(values)
                        {
                            let better = *value > *largest || value.is_nan();
                            *which = if better { image as u32 } else { *which };
                            *largest = if better { *value } else { *largest };
                        }
                    }
                }
            });
        });
    (largest, which)
}

/// The gradient goes to the image that had the maximum.
pub(crate) fn backward(gradient: &[f32], which: &[u32], images: usize, size: usize) -> Buffer {
    let mut grad_input = Buffer::recycled(gradient.len() * images);
    grad_input
        .par_chunks_mut(size.max(1))
        .enumerate()
        .for_each(|(row, grad_image)| {
            let (sample, image) = (row / images, (row % images) as u32);
            let from = sample * size;
            let gradient = &gradient[from..from + size];
            let which = &which[from..from + size];
            pulp::Arch::new().dispatch(|| {
                for ((value, gradient), which) in grad_image.iter_mut().zip(gradient).zip(which) {
                    *value = if *which == image { *gradient } else { 0.0 };
                }
            });
        });
    grad_input
}
