//! Networks to bytes of weights files.
use super::FORMAT_VERSION;
use crate::header::sorted;
use crate::{Architecture, ModelError};
use burn::module::{Module, ModuleVisitor, Param};
use burn::tensor::Tensor;
use half::f16;
use safetensors::Dtype;
use safetensors::tensor::TensorView;
use std::collections::{BTreeMap, HashMap};

#[derive(Default)]
struct Collector {
    path: Vec<String>,
    tensors: HalfTensors,
    error: Option<String>,
}

impl ModuleVisitor for Collector {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        let tensor = param.val();
        let shape: Vec<usize> = tensor.dims().to_vec();
        match tensor.into_data().try_to_vec::<f32>() {
            Ok(values) => {
                let bytes = half(values.into_iter());
                self.tensors.insert(self.path.join("."), (shape, bytes));
            }
            Err(error) => self.error = Some(format!("{error:?}")),
        }
    }
}

pub(super) fn encode<M: Module>(
    architecture: &Architecture,
    network: &M,
    notes: &BTreeMap<String, String>,
) -> Result<Vec<u8>, ModelError> {
    let mut collector = Collector::default();
    network.visit(&mut collector);
    if let Some(error) = collector.error {
        return Err(ModelError::Device(error));
    }
    file_of(architecture, &collector.tensors, notes)
}

/// Shape and bytes of each tensor, in half precision, by name.
pub(super) type HalfTensors = BTreeMap<String, (Vec<usize>, Vec<u8>)>;

pub(super) fn file_of(
    architecture: &Architecture,
    tensors: &HalfTensors,
    notes: &BTreeMap<String, String>,
) -> Result<Vec<u8>, ModelError> {
    let json = serde_json::to_string(architecture).map_err(|reason| ModelError::Json {
        name: "architecture".into(),
        reason,
    })?;
    let mut metadata: HashMap<String, String> = notes.clone().into_iter().collect();
    metadata.insert("format".into(), "normalight".into());
    metadata.insert("version".into(), FORMAT_VERSION.into());
    metadata.insert("architecture".into(), json);
    let views = tensors
        .iter()
        .map(|(path, (shape, bytes))| {
            let view = TensorView::new(Dtype::F16, shape.clone(), bytes)
                .map_err(|error| ModelError::Device(error.to_string()))?;
            Ok((path.as_str(), view))
        })
        .collect::<Result<Vec<_>, ModelError>>()?;
    safetensors::serialize(views, Some(metadata))
        .map(sorted)
        .map_err(|error| ModelError::Device(error.to_string()))
}

pub(super) fn half(values: impl Iterator<Item = f32>) -> Vec<u8> {
    values
        .flat_map(|value| f16::from_f32(value).to_le_bytes())
        .collect()
}
