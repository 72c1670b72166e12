//! What ships inside the crate.

use crate::Genotypes;

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
