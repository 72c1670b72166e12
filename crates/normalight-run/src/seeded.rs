use crate::named_tensors::collect;
use burn::module::Module;
use burn::tensor::Device;
use std::sync::{Mutex, PoisonError};

/// Builds a network from a seed.
///
/// The backend has one generator for the whole program, and weights are drawn when they are first looked at: both happen
/// here while no other run does the same.
///
/// # Errors
/// Those of `build`.
pub fn seeded<M: Module, E>(
    device: &Device,
    seed: u64,
    build: impl FnOnce() -> Result<M, E>,
) -> Result<M, E> {
    static GENERATOR: Mutex<()> = Mutex::new(());
    let _alone = GENERATOR.lock().unwrap_or_else(PoisonError::into_inner);
    device.seed(seed);
    let network = build()?;
    collect(&network);
    Ok(network)
}
