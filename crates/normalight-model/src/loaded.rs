use crate::{LightArchitecture, LightNetwork, NormalArchitecture, NormalNetwork};
use burn::tensor::Device;

/// A network ready to be used.
#[derive(Debug, Clone)]
pub struct LoadedNetwork<A, N> {
    /// Its description.
    pub architecture: A,
    /// Its layers and weights.
    pub network: N,
    /// Where the weights are.
    pub device: Device,
}

/// A light calibration network ready to be used.
pub type LoadedLightNetwork = LoadedNetwork<LightArchitecture, LightNetwork>;

/// A normal estimation network ready to be used.
pub type LoadedNormalNetwork = LoadedNetwork<NormalArchitecture, NormalNetwork>;
