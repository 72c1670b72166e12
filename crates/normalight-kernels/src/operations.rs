//! The operations as everyone sees them, and how they are composed of Burn's where our own code does not run.
mod convolution;
mod depthwise;
mod max_over_images;
mod normalisation;
mod orthogonalised;
mod transposed;

pub use convolution::convolution;
pub use depthwise::depthwise_relu;
pub use max_over_images::max_over_images;
pub use normalisation::{BatchMoments, batch_norm, scale_channels};
pub use orthogonalised::orthogonalised;
pub use transposed::transposed_convolution;

use burn::tensor::Tensor;
use std::cell::Cell;

/// # Shapes
/// - input: `[batch, channels, height, width]`
/// - output: `[batch, height, width, channels]`
pub fn channels_last(input: Tensor<4>) -> Tensor<4> {
    input.permute([0, 2, 3, 1])
}

/// # Shapes
/// - input: `[batch, height, width, channels]`
/// - output: `[batch, channels, height, width]`
pub fn channels_first(input: Tensor<4>) -> Tensor<4> {
    input.permute([0, 3, 1, 2])
}

thread_local! {
    static GENERIC: Cell<bool> = const { Cell::new(false) };
}

/// Runs `work` with every operation of this crate composed of Burn's own, to compare with: the same numbers up to
/// rounding, at Burn's speed.
pub fn generic<T>(work: impl FnOnce() -> T) -> T {
    /// Also after a panic.
    struct Restore(bool);
    impl Drop for Restore {
        fn drop(&mut self) {
            GENERIC.set(self.0);
        }
    }
    let _restore = Restore(GENERIC.replace(true));
    work()
}

/// Whether our own code can take this tensor: f32 on flex, with gradients only where they are
/// compiled in.
#[cfg(feature = "flex")]
fn on_flex<const D: usize>(input: &Tensor<D>) -> bool {
    use burn::backend::DispatchDevice;
    if GENERIC.get() {
        return false;
    }
    let device = input.device();
    let differentiable = device.is_autodiff();
    let plain = device.inner();
    matches!(plain.as_dispatch(), DispatchDevice::Flex(_))
        && input.dtype() == burn::tensor::DType::F32
        && (cfg!(feature = "autodiff") || !differentiable)
}
