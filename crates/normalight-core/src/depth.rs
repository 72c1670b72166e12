//! Normals to depth.
mod bilateral;
mod bow;
mod curvature;
mod cycle;
mod derivatives;
mod equations;
mod graph;
mod grid;
mod integrate;
mod map;
mod occlusion;
mod pairing;
mod pyramid;
mod solver;
mod surface;

pub use bow::Bow;
pub use integrate::integrate_normals;
pub use map::DepthMap;
pub use surface::DepthMesh;

use serde::{Deserialize, Serialize};

/// How normals become depth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(default)]
pub struct DepthSettings {
    /// How the camera saw the object.
    pub projection: Projection,
    /// What is minimised.
    pub integration: Integration,
}

/// How a camera projects points.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// Along parallel rays: right for objects that are far away compared with their depth.
    #[default]
    Orthographic,
    /// Through a pinhole, its axis through the middle of the map.
    Perspective {
        /// Focal length in pixels: millimetres on the sensor times pixels per millimetre; above zero.
        focal: f32,
    },
}

/// What makes a height field fit normals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(tsify::Tsify))]
#[serde(rename_all = "lowercase")]
pub enum Integration {
    /// Steps where only one side of a pixel fits its normal (Cao et al. 2022).
    #[default]
    Bilateral,
    /// Least squares of all slopes: no steps, everything smooth.
    Poisson,
}
