//! What ships inside the crate, so that one binary works offline.

use crate::{Genotypes, ModelError, Weights};

/// The default weights of the light calibration network.
///
/// # Errors
/// [`ModelError::CorruptWeights`]; only when the build is broken.
pub fn default_light_weights() -> Result<Weights, ModelError> {
    Weights::from_bytes(
        "light.safetensors",
        include_bytes!("../../../models/default/light.safetensors"),
    )
}

/// The default weights of the normal estimation network.
///
/// # Errors
/// [`ModelError::CorruptWeights`]; only when the build is broken.
pub fn default_normal_weights() -> Result<Weights, ModelError> {
    Weights::from_bytes(
        "normal.safetensors",
        include_bytes!("../../../models/default/normal.safetensors"),
    )
}

/// The cells that the paper published.
///
/// # Panics
/// Never: the file is part of the crate, and a test reads it.
pub fn paper_genotypes() -> Genotypes {
    Genotypes::from_json(
        "paper.json",
        include_str!("../../../models/genotypes/paper.json"),
    )
    .expect("the shipped genotype file is valid")
}
