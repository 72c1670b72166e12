//! Lamps, the shadows they throw, and the light that surfaces pass on.
mod bounce;
mod grooves;
mod lamp;
mod layouts;
mod shadow;

pub(crate) use bounce::Bounces;
pub(crate) use grooves::{narrow, open_sky};
pub(crate) use lamp::{Lamp, lamps, tinted};
pub(crate) use shadow::Shadows;
