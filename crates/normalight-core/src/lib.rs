//! The words of photometric stereo, in plain Rust: no networks, no files, no clock.
//!
//! Axes everywhere: x right, y up, z to the camera. Angles are radians. A light's direction points
//! from the object to the light.
#![deny(missing_docs)]

mod albedo;
mod angles;
mod bins;
mod calibrated;
mod error;
mod estimate;
mod light;
mod mask;
mod mesh;
mod metrics;
mod normal_map;
mod quality;
mod rect;
mod refit;
mod stack;
mod statistics;
mod symmetry;
mod transfer;
mod woodham;

pub use albedo::albedo_map;
pub use angles::{angle_between, direction_from_angles, direction_to_angles};
pub use bins::{Decoding, IntensityBins, IntensitySpacing, LightBins, LightClasses};
pub use calibrated::CalibratedStack;
pub use error::CoreError;
pub use estimate::{Estimate, EstimateSettings};
pub use glam::Vec3;
pub use light::Light;
pub use mask::{Mask, MaskSource};
pub use mesh::{CornerNormals, MAX_TRIANGLES, TriangleMesh};
pub use metrics::{
    NormalError, intensity_error, mean_light_error, normal_error, normal_error_between,
};
pub use normal_map::NormalMap;
pub use quality::Quality;
pub use rect::Rect;
pub use refit::{RefitSettings, refit_lights};
pub use stack::{ImageStack, MIN_IMAGES, Samples, StackImage, evenly_spaced_indices};
pub use statistics::StackStatistics;
pub use symmetry::Symmetry;
pub use transfer::Transfer;
pub use woodham::{least_squares_normals, luminance};
