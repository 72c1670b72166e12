mod average;
mod encode;

use crate::{
    Architecture, LightArchitecture, LightNetwork, LoadedLightNetwork, LoadedNetwork,
    LoadedNormalNetwork, ModelError, NormalArchitecture, NormalNetwork,
};
use burn::module::{Module, ModuleMapper, Param};
use burn::tensor::{Device, Tensor, TensorData};
use encode::encode;
use half::f16;
use safetensors::tensor::TensorView;
use safetensors::{Dtype, SafeTensors};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, HashMap};

/// Version of the file's layout.
const FORMAT_VERSION: &str = "1";

/// Largest weights file that is read, in bytes: the paper's networks at f32 need 18 MB.
const MAX_BYTES: usize = 256 << 20;

/// A trained network as stored: architecture and folded weights in half precision.
///
/// On disk a safetensors file whose metadata holds `format` = `normalight`, `version`,
/// `architecture` (JSON) and free notes.
#[derive(Debug, Clone)]
pub struct Weights {
    name: String,
    architecture: Architecture,
    tensors: BTreeMap<String, (Vec<usize>, Vec<f32>)>,
    hash: String,
}

impl Weights {
    /// Reads a weights file.
    ///
    /// # Errors
    /// [`ModelError::CorruptWeights`], which names the file.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, ModelError> {
        let corrupt = |reason: String| ModelError::CorruptWeights {
            name: name.to_owned(),
            reason,
        };
        if bytes.len() > MAX_BYTES {
            return Err(corrupt(format!(
                "{} bytes, at most {MAX_BYTES} are expected",
                bytes.len()
            )));
        }
        let file = SafeTensors::deserialize(bytes).map_err(|error| corrupt(error.to_string()))?;
        let (_, header) =
            SafeTensors::read_metadata(bytes).map_err(|error| corrupt(error.to_string()))?;
        let metadata: HashMap<String, String> = header.metadata().clone().unwrap_or_default();
        let entry = |key: &str| {
            metadata
                .get(key)
                .ok_or_else(|| corrupt(format!("no entry {key:?} in its metadata")))
        };
        if entry("format")? != "normalight" || entry("version")? != FORMAT_VERSION {
            return Err(corrupt(format!(
                "format {:?} version {:?}, expected \"normalight\" version {FORMAT_VERSION:?}",
                entry("format")?,
                entry("version")?
            )));
        }
        let architecture: Architecture = serde_json::from_str(entry("architecture")?)
            .map_err(|error| corrupt(format!("architecture: {error}")))?;
        match &architecture {
            Architecture::Light(light) => light.validate(),
            Architecture::Normal(normal) => normal.validate(),
        }
        .map_err(|error| corrupt(error.to_string()))?;
        let mut tensors = BTreeMap::new();
        for (path, view) in file.iter() {
            let values = decode(&view)
                .ok_or_else(|| corrupt(format!("tensor {path} has type {:?}", view.dtype())))?;
            if let Some(value) = values.iter().find(|value| !value.is_finite()) {
                return Err(corrupt(format!("tensor {path} contains {value}")));
            }
            tensors.insert(path.to_owned(), (view.shape().to_vec(), values));
        }
        Ok(Self {
            name: name.to_owned(),
            architecture,
            tensors,
            hash: hex(&Sha256::digest(bytes)),
        })
    }

    /// File name, for messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Which network this is.
    pub fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    /// SHA-256 of the file, in hexadecimal.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// Shape and values of a tensor by its path in the network.
    ///
    /// # Errors
    /// [`ModelError::Tensor`] where there is none.
    pub fn tensor(&self, path: &str) -> Result<(&[usize], &[f32]), ModelError> {
        match self.tensors.get(path) {
            Some((shape, values)) => Ok((shape, values)),
            None => Err(ModelError::Tensor {
                name: self.name.clone(),
                tensor: path.to_owned(),
                found: "nothing".into(),
                expected: "a tensor".into(),
            }),
        }
    }

    /// Nothing, where a network has taken all tensors.
    ///
    /// # Errors
    /// [`ModelError::Tensor`] where the file holds more or fewer than were `used`.
    pub fn expect_all_used(&self, used: usize) -> Result<(), ModelError> {
        let found = self.tensors.len();
        if found == used {
            return Ok(());
        }
        Err(ModelError::Tensor {
            name: self.name.clone(),
            tensor: "all".into(),
            found: format!("{found} tensors"),
            expected: format!("{used} tensors"),
        })
    }

    /// Builds the light network on a device.
    ///
    /// # Errors
    /// [`ModelError::WrongNetwork`] or [`ModelError::Tensor`].
    pub fn light_network(&self, device: &Device) -> Result<LoadedLightNetwork, ModelError> {
        let Architecture::Light(architecture) = &self.architecture else {
            return Err(self.wrong_network("normal", "light"));
        };
        let network = LightNetwork::new(architecture, true, device)?;
        Ok(LoadedNetwork {
            architecture: architecture.clone(),
            network: self.load(network, device)?,
            device: device.clone(),
        })
    }

    /// Builds the normal network on a device.
    ///
    /// # Errors
    /// [`ModelError::WrongNetwork`] or [`ModelError::Tensor`].
    pub fn normal_network(&self, device: &Device) -> Result<LoadedNormalNetwork, ModelError> {
        let Architecture::Normal(architecture) = &self.architecture else {
            return Err(self.wrong_network("light", "normal"));
        };
        let network = NormalNetwork::new(architecture, true, device)?;
        Ok(LoadedNetwork {
            architecture: architecture.clone(),
            network: self.load(network, device)?,
            device: device.clone(),
        })
    }

    /// Bytes of a weights file of a trained light network; normalisation layers are folded.
    ///
    /// # Errors
    /// [`ModelError::Device`] when the weights cannot be read back.
    pub fn light_bytes(
        architecture: &LightArchitecture,
        network: &LightNetwork,
        notes: &BTreeMap<String, String>,
    ) -> Result<Vec<u8>, ModelError> {
        encode(
            &Architecture::Light(architecture.clone()),
            &network.folded(),
            notes,
        )
    }

    /// Bytes of a weights file of a trained normal network; normalisation layers are folded.
    ///
    /// # Errors
    /// [`ModelError::Device`] when the weights cannot be read back.
    pub fn normal_bytes(
        architecture: &NormalArchitecture,
        network: &NormalNetwork,
        notes: &BTreeMap<String, String>,
    ) -> Result<Vec<u8>, ModelError> {
        encode(
            &Architecture::Normal(architecture.clone()),
            &network.folded(),
            notes,
        )
    }

    fn wrong_network(&self, found: &str, expected: &'static str) -> ModelError {
        ModelError::WrongNetwork {
            name: self.name.clone(),
            found: found.to_owned(),
            expected,
        }
    }

    /// Fills a freshly built network with the stored values, in f32.
    fn load<M: Module>(&self, network: M, device: &Device) -> Result<M, ModelError> {
        let mut loader = Loader {
            weights: self,
            device,
            path: Vec::new(),
            used: 0,
            error: None,
        };
        let network = network.map(&mut loader);
        if let Some(error) = loader.error {
            return Err(error);
        }
        self.expect_all_used(loader.used)?;
        Ok(network)
    }
}

struct Loader<'a> {
    weights: &'a Weights,
    device: &'a Device,
    path: Vec<String>,
    used: usize,
    error: Option<ModelError>,
}

impl ModuleMapper for Loader<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let tensor = self.path.join(".");
        let expected: Vec<usize> = param.lazy_shape().to_vec();
        let found = self.weights.tensors.get(&tensor);
        match found {
            Some((shape, values)) if *shape == expected => {
                self.used += 1;
                let data = TensorData::new(values.clone(), expected);
                Param::initialized(param.id, Tensor::from_data(data, self.device))
            }
            _ => {
                self.error.get_or_insert(ModelError::Tensor {
                    name: self.weights.name.clone(),
                    tensor,
                    found: found.map_or("nothing".into(), |(shape, _)| format!("{shape:?}")),
                    expected: format!("{expected:?}"),
                });
                param
            }
        }
    }
}

fn decode(view: &TensorView<'_>) -> Option<Vec<f32>> {
    let bytes = view.data();
    match view.dtype() {
        Dtype::F16 => Some(
            bytes
                .chunks_exact(2)
                .map(|pair| f16::from_le_bytes([pair[0], pair[1]]).to_f32())
                .collect(),
        ),
        Dtype::F32 => Some(
            bytes
                .chunks_exact(4)
                .map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]))
                .collect(),
        ),
        _ => None,
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
