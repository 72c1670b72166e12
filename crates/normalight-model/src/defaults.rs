//! What ships inside the crate.

use crate::{Genotypes, ModelError, Weights};

/// The cells that the paper published.
///
/// # Panics
/// Never: the file is part of the crate, and tests read it.
pub fn paper_genotypes() -> Genotypes {
    Genotypes::from_json(
        "paper.json",
        include_str!("../../../models/genotypes/paper.json"),
    )
    .expect("the shipped genotype file is valid")
}

/// The weights that ship: the light network's and the normal network's.
///
/// # Errors
/// Never with the files as shipped, which tests read; [`ModelError::CorruptWeights`] after a bad edit.
pub fn default_weights() -> Result<[Weights; 2], ModelError> {
    Ok([
        Weights::from_bytes(
            "models/default/light.safetensors",
            include_bytes!("../../../models/default/light.safetensors"),
        )?,
        Weights::from_bytes(
            "models/default/normal.safetensors",
            include_bytes!("../../../models/default/normal.safetensors"),
        )?,
    ])
}
