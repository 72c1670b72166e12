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

/// SHA-256 of the weights that ship, in hexadecimal.
const HASHES: [&str; 2] = [
    "8e60ddbc4550b653251ee17dc71629040997e36c7260fe6a9d5ffb765f56124f",
    "f3412fad2c6634f548561d9888acdbb0d9cfd9fa92dd8fe976fe86857e9c195e",
];

/// Makes sure that weights are those that ship, light and normal network: for who fetches the files instead of taking them
/// from the crate.
///
/// # Errors
/// [`ModelError::CorruptWeights`] for others, or for files that did not arrive whole.
pub fn expect_default_weights(weights: [&Weights; 2]) -> Result<(), ModelError> {
    for (weights, expected) in weights.into_iter().zip(HASHES) {
        if weights.hash() != expected {
            return Err(ModelError::CorruptWeights {
                name: weights.name().to_owned(),
                reason: format!("its SHA-256 is {}, expected {expected}", weights.hash()),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hashes_are_those_of_the_files() {
        let [light, normal] = default_weights().unwrap();
        expect_default_weights([&light, &normal]).unwrap();
        let other = expect_default_weights([&normal, &light]).unwrap_err();
        assert!(other.to_string().contains(normal.hash()));
    }
}
