//! The module that computes on the browser's GPU.
pub use normalight_wasm::*;
