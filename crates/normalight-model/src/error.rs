use normalight_core::CoreError;
use thiserror::Error;

/// What can go wrong with architectures, weights and estimation.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The file is not a readable weights file.
    #[error("{name}: not a weights file of Normalight: {reason}")]
    CorruptWeights {
        /// File name.
        name: String,
        /// What was found instead.
        reason: String,
    },
    /// The file holds another network than the one asked for.
    #[error("{name}: holds a {found} network, a {expected} network is expected")]
    WrongNetwork {
        /// File name.
        name: String,
        /// Network in the file.
        found: String,
        /// Network asked for.
        expected: &'static str,
    },
    /// Networks that should differ in their numbers alone.
    #[error("{name}: another architecture than that of {other}")]
    OtherArchitecture {
        /// File name.
        name: String,
        /// File that it is compared with.
        other: String,
    },
    /// A tensor is missing, or has another shape than the architecture needs.
    #[error("{name}: tensor {tensor}: found {found}, expected {expected}")]
    Tensor {
        /// File name.
        name: String,
        /// Path of the tensor in the network.
        tensor: String,
        /// What the file holds.
        found: String,
        /// What the architecture needs.
        expected: String,
    },
    /// A genotype or architecture breaks a rule.
    #[error("{what}: found {found}, expected {expected}")]
    Architecture {
        /// The setting.
        what: String,
        /// Its value.
        found: String,
        /// The rule.
        expected: String,
    },
    /// JSON that does not parse.
    #[error("{name}: {reason}")]
    Json {
        /// File name.
        name: String,
        /// Where and why.
        reason: serde_json::Error,
    },
    /// Stack, mask or lights do not fit together.
    #[error(transparent)]
    Core(#[from] CoreError),
    /// The device failed to hand a result back.
    #[error("the device failed to return its result: {0}")]
    Device(String),
    /// The observer asked to stop.
    #[error("cancelled")]
    Cancelled,
}

impl ModelError {
    /// A search needs cells.
    pub(crate) fn no_cells() -> Self {
        Self::Architecture {
            what: "kind of a searched network".into(),
            found: "plain".into(),
            expected: "cells".into(),
        }
    }
}
