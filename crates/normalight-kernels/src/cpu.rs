//! The arithmetic itself, on slices. Feature maps are channels last: `[batch, height, width, channels]`.

pub(crate) mod buffer;
pub(crate) mod convolution;
pub(crate) mod depthwise;
pub(crate) mod direct;
pub(crate) mod geometry;
pub(crate) mod max_over_images;
pub(crate) mod normalise;
pub(crate) mod orthogonalise;
pub(crate) mod product;
pub(crate) mod transforms;
pub(crate) mod transposed;
pub(crate) mod vectors;
pub(crate) mod window;
pub(crate) mod winograd;
