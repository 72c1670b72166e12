//! Endless labelled photometric stereo samples, rendered while a network trains.
//!
//! A sample is an object drawn from a [`SceneRecipe`] (vases, figures, blobs; matte, shiny, metallic
//! or patterned), seen by an orthographic camera under one distant light per image, with shadows,
//! bounced light, noise and the rounding of real image files. The shape is a signed distance that
//! rays are followed into. Axes: x right, y up, z to the camera.
#![deny(missing_docs)]

mod bounce;
mod brdf;
mod camera;
mod error;
mod figures;
mod framing;
mod lamps;
mod lathe;
mod material;
mod noise;
mod objects;
mod part;
mod random;
mod ray;
mod recipe;
mod recipe_check;
mod relief;
mod render;
mod sample;
mod shadow;
mod shape;
mod vessels;
mod view;

pub use error::SynthError;
pub use framing::Framing;
pub use recipe::{
    CameraRecipe, LightRecipe, MaterialRecipe, SceneRecipe, ShapeRecipe, TransportRecipe,
};
pub use render::render_sample;
pub use sample::{BitDepth, Sample};
