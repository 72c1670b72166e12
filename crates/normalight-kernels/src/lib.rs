//! Fast CPU operations, forward and backward.
//!
//! Each is a function on Burn tensors. On the flex backend with the feature `flex` it runs our own
//! code; everywhere else it is composed of Burn's operations and gives the same numbers up to
//! rounding.
#![deny(missing_docs)]
#![cfg_attr(
    not(feature = "autodiff"),
    allow(
        dead_code,
        reason = "without gradients, as in the browser, only the forward half is used"
    )
)]

mod convolution;
#[cfg(feature = "flex")]
mod flex;
#[cfg(feature = "flex")]
mod geometry;
#[cfg(feature = "autodiff")]
mod gradient;
#[cfg(feature = "flex")]
mod matrix;
#[cfg(feature = "flex")]
mod unfolded;

pub use convolution::convolution;
