//! Endless labelled photometric stereo samples, rendered while a network trains.
//!
//! A sample is an object drawn from a [`SceneRecipe`] (vases, figures, blobs, reliefs, meshes; matte,
//! shiny, metallic, measured or patterned), seen by a camera under one lamp per image, with shadows,
//! bounced light, noise and the rounding of real image files.
//!
//! [`Renderer`] draws a [`Scene`]: shape, material and lamps, rendered without a camera. A scene gives
//! many a [`Sample`]: photographs with the truth about them. Axes: x right, y up, z to the camera.
//!
//! ```
//! use normalight_synth::{Framing, Preset, Renderer};
//!
//! let renderer = Renderer::new(Preset::Classic.recipe())?;
//! // Sample 7 under 4 lights, 32 x 32 pixels: the same bits on every machine.
//! let sample = renderer.sample(7, 4, 32, Framing::WholeObject);
//! assert_eq!(sample.images.len(), 4 * 3 * 32 * 32);
//! assert_eq!(sample.lights.len(), 4);
//! assert_eq!(sample.images, renderer.sample(7, 4, 32, Framing::WholeObject).images);
//! # Ok::<(), normalight_synth::SynthError>(())
//! ```
#![deny(missing_docs)]

mod camera;
mod error;
mod lanes;
mod lighting;
mod materials;
mod noise;
mod random;
mod recipe;
mod renderer;
mod sample;
mod scene;
mod shapes;

pub use error::SynthError;
pub use random::scrambled;
pub use recipe::{
    CameraRecipe, LightRecipe, MaterialRecipe, MeshFolder, Preset, SamplingRecipe, SceneRecipe,
    ShapeRecipe, TransportRecipe,
};
pub use renderer::{Framing, Renderer};
pub use sample::{BitDepth, Sample};
pub use scene::{Labelled, Scene};
