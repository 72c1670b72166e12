//! Files of normalight-model that know nothing of Burn, compiled here by themselves: its crate would
//! bring Burn, half an hour of building under the fuzzer.

#[allow(dead_code)]
#[path = "../../crates/normalight-model/src/error.rs"]
mod error;
#[path = "../../crates/normalight-model/src/genotype.rs"]
#[allow(dead_code)]
pub mod genotype;
#[path = "../../crates/normalight-model/src/header.rs"]
mod header;

pub use error::ModelError;

/// A safetensors file with its header in order, see `header.rs`.
pub fn sorted_safetensors(file: Vec<u8>) -> Vec<u8> {
    header::sorted(file)
}
