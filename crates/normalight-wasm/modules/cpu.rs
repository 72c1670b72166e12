//! The module that computes on the processor, and does all that needs no device.
pub use normalight_wasm::*;
