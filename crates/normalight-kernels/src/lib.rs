//! Fast CPU operations, forward and backward.
//!
//! Each is a function on Burn tensors. On the flex backend with the feature `flex` it runs our own code; everywhere
//! else it is composed of Burn's operations and gives the same numbers up to rounding.
//!
//! Feature maps are channels last, `[batch, height, width, channels]`: a pixel's channels lie side by side, as vector
//! instructions and matrix products want them.
//!
//! ```
//! use burn::tensor::{Device, Tensor};
//! use normalight_kernels::{Convolution, convolution};
//!
//! let device = Device::flex();
//! // One picture of 8 x 8 pixels with 3 channels, through 5 filters of 3 x 3.
//! let input = Tensor::<4>::ones([1, 8, 8, 3], &device);
//! let weight = Tensor::<4>::ones([5, 3, 3, 3], &device);
//! let bias = Tensor::<1>::zeros([5], &device);
//! let output = convolution(input, weight, bias, Convolution::default());
//! assert_eq!(output.dims(), [1, 8, 8, 5]);
//! ```
#![deny(missing_docs)]
#![cfg_attr(
    not(feature = "autodiff"),
    allow(
        dead_code,
        reason = "without gradients, as in the browser, only the forward half is used"
    )
)]

#[cfg(feature = "flex")]
mod backend;
#[cfg(feature = "flex")]
mod cpu;
mod operations;
mod settings;

#[cfg(feature = "flex")]
pub use cpu::buffer::{limit_kept_memory, release_kept_memory};
pub use operations::{
    BatchMoments, batch_norm, channels_first, channels_last, convolution, depthwise_relu, generic,
    max_over_images, orthogonalised, scale_channels, transposed_convolution,
};
pub use settings::Convolution;
