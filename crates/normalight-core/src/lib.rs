//! The words of photometric stereo, in plain Rust: no networks, no files, no clock.
//!
//! Axes everywhere: x right, y up, z to the camera. Angles are radians. A light's direction points
//! from the object to the light.
//!
//! A matte plane that faces the camera, under three known lights, by least squares:
//!
//! ```
//! use normalight_core::{
//!     ImageStack, Light, Mask, Samples, StackImage, Transfer, Vec3, least_squares_normals,
//! };
//!
//! let directions = [Vec3::X, -Vec3::X, Vec3::Y].map(|side| (side + Vec3::Z).normalize());
//! let image = |direction: Vec3| StackImage {
//!     name: String::new(),
//!     width: 8,
//!     height: 8,
//!     channels: 1,
//!     // Lambert's law with normal z and albedo 0.5.
//!     samples: Samples::F32(vec![0.5 * direction.z; 64]),
//!     transfer: Transfer::Linear,
//! };
//! let stack = ImageStack::new(directions.map(image).into())?;
//! let lights = directions.map(|direction| Light::new(direction, 1.0));
//! let (normals, albedo) = least_squares_normals(&stack, &Mask::whole(8, 8), &lights)?;
//! assert!(normals.normals()[0].distance(Vec3::Z) < 1e-5);
//! assert!((albedo[0] - 0.5).abs() < 1e-3);
//! # Ok::<(), normalight_core::CoreError>(())
//! ```
#![deny(missing_docs)]

mod albedo;
mod angles;
mod bins;
mod calibrated;
mod depth;
mod error;
mod estimate;
mod expected_error;
mod intensities;
mod light;
mod light_agreement;
mod light_coverage;
mod mask;
mod mesh;
mod metrics;
mod normal_map;
mod parallel;
mod quality;
mod rect;
mod reduce;
mod refit;
mod registration;
mod robust;
mod seamless;
mod shots;
mod stack;
mod statistics;
mod symmetry;
mod transfer;
mod uncalibrated;
mod woodham;

pub use albedo::albedo_map;
pub use angles::{angle_between, direction_from_angles, direction_to_angles};
pub use bins::{Decoding, IntensityBins, IntensitySpacing, LightBins, LightClasses};
pub use calibrated::CalibratedStack;
pub use depth::{
    Bow, DepthMap, DepthMesh, DepthSettings, Integration, Projection, integrate_normals,
};
pub use error::CoreError;
pub use estimate::{Estimate, EstimateSettings};
pub use expected_error::{expected_light_error, expected_normal_error};
pub use glam::Vec3;
pub use intensities::intensities_from_directions;
pub use light::Light;
pub use light_agreement::LightAgreement;
pub use light_coverage::LightCoverage;
pub use mask::{Mask, MaskGuess, MaskSource};
pub use mesh::{CornerNormals, MAX_TRIANGLES, TriangleMesh};
pub use metrics::{
    NormalError, angle_to_truth, intensity_error, mean_light_error, normal_error,
    normal_error_between,
};
pub use normal_map::NormalMap;
pub use parallel::on_all_cores;
pub use quality::Quality;
pub use rect::Rect;
pub use reduce::{Reduced, reduced};
pub use refit::{RefitSettings, refit_lights};
pub use registration::{Registration, ShotShift, keep_seen, register_shots, translated};
pub use robust::robust_normals;
pub use seamless::Seamless;
pub use shots::{ShotLight, without_ambient};
pub use stack::{
    ImageStack, MIN_IMAGES, Samples, StackImage, evenly_spaced_indices, spread_indices,
    spread_order,
};
pub use statistics::StackStatistics;
pub use symmetry::Symmetry;
pub use transfer::Transfer;
pub use uncalibrated::{Factorisation, uncalibrated_factorisation};
pub use woodham::{least_squares_normals, luminance};
