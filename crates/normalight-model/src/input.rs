//! What the networks see of photographs: normalisation and order of the channels, once for the pipeline and for trainers.
mod light;
mod normal;

pub use light::LightInput;
pub use normal::NormalInput;
