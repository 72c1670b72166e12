use crate::TrainError;
use crate::adam::{Adam, host};
use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::tensor::{Tensor, TensorData};
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

/// Where a run stands, beside its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Standing {
    /// Steps taken.
    pub(crate) step: usize,
    /// Best validation error in degrees.
    pub(crate) best: f32,
}

/// Writes weights and optimiser state to one file, aside first.
pub(crate) fn save<M: Module>(
    path: &Path,
    network: &M,
    adam: &Adam,
    standing: Standing,
) -> Result<(), TrainError> {
    let mut collector = Collector::default();
    network.visit(&mut collector);
    let mut tensors: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    let bytes = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect();
    for (name, values) in &collector.tensors {
        tensors.insert(format!("weight/{name}"), bytes(values));
    }
    for (name, moments) in &adam.moments {
        for (order, values) in moments.iter().enumerate() {
            tensors.insert(format!("moment{order}/{name}"), bytes(values));
        }
    }
    let views = tensors
        .iter()
        .map(|(name, bytes)| {
            let view = TensorView::new(Dtype::F32, vec![bytes.len() / 4], bytes);
            view.map(|view| (name.as_str(), view))
        })
        .collect::<Result<Vec<_>, _>>()
        .map_err(|error| damaged(path, &error.to_string()))?;
    let metadata = HashMap::from([
        ("step".to_owned(), standing.step.to_string()),
        ("best".to_owned(), standing.best.to_string()),
    ]);
    let file = safetensors::serialize(views, Some(metadata))
        .map_err(|error| damaged(path, &error.to_string()))?;
    write_aside(path, &file)
}

/// Continues from a checkpoint.
pub(crate) fn load<M: Module>(path: &Path, network: M) -> Result<(M, Adam, Standing), TrainError> {
    let bytes = std::fs::read(path).map_err(|source| TrainError::File {
        path: path.to_owned(),
        source,
    })?;
    let broken = |reason: &str| damaged(path, reason);
    let file = SafeTensors::deserialize(&bytes).map_err(|error| broken(&error.to_string()))?;
    let (_, header) =
        SafeTensors::read_metadata(&bytes).map_err(|error| broken(&error.to_string()))?;
    let metadata = header.metadata().clone().unwrap_or_default();
    let number = |key: &str| metadata.get(key).ok_or_else(|| broken("metadata missing"));
    let standing = Standing {
        step: number("step")?.parse().map_err(|_| broken("bad step"))?,
        best: number("best")?.parse().map_err(|_| broken("bad error"))?,
    };
    let mut tensors: BTreeMap<String, Vec<f32>> = BTreeMap::new();
    for (name, view) in file.iter() {
        let values = view.data().chunks_exact(4);
        let values = values.map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]));
        tensors.insert(name.to_owned(), values.collect());
    }
    let mut loader = Loader {
        tensors: &mut tensors,
        path: Vec::new(),
        missing: None,
    };
    let network = network.map(&mut loader);
    if let Some(name) = loader.missing {
        return Err(broken(&format!(
            "weight {name} is missing or has another size"
        )));
    }
    let mut adam = Adam {
        step: i32::try_from(standing.step).unwrap_or(i32::MAX),
        ..Adam::default()
    };
    let names: Vec<String> = tensors
        .keys()
        .filter_map(|name| name.strip_prefix("moment0/").map(str::to_owned))
        .collect();
    for name in names {
        let first = tensors
            .remove(&format!("moment0/{name}"))
            .unwrap_or_default();
        let second = tensors
            .remove(&format!("moment1/{name}"))
            .filter(|second| second.len() == first.len())
            .ok_or_else(|| broken(&format!("moment of {name} is missing")))?;
        adam.moments.insert(name, [first, second]);
    }
    Ok((network, adam, standing))
}

/// Writes a file under another name, then renames it: no reader ever sees half of it.
pub(crate) fn write_aside(path: &Path, bytes: &[u8]) -> Result<(), TrainError> {
    let aside = path.with_extension("part");
    let failed = |source| TrainError::File {
        path: path.to_owned(),
        source,
    };
    std::fs::write(&aside, bytes).map_err(failed)?;
    std::fs::rename(&aside, path).map_err(failed)
}

fn damaged(path: &Path, reason: &str) -> TrainError {
    TrainError::Checkpoint {
        path: path.to_owned(),
        reason: reason.to_owned(),
    }
}

#[derive(Default)]
struct Collector {
    path: Vec<String>,
    tensors: BTreeMap<String, Vec<f32>>,
}

impl ModuleVisitor for Collector {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        self.tensors.insert(self.path.join("."), host(param.val()));
    }
}

struct Loader<'a> {
    tensors: &'a mut BTreeMap<String, Vec<f32>>,
    path: Vec<String>,
    missing: Option<String>,
}

impl ModuleMapper for Loader<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let name = self.path.join(".");
        let tensor = param.val();
        match self.tensors.remove(&format!("weight/{name}")) {
            Some(values) if values.len() == tensor.shape().num_elements() => {
                let data = TensorData::new(values, tensor.dims());
                let loaded = Tensor::<D>::from_data(data, &tensor.device());
                let tracked = tensor.is_require_grad();
                Param::initialized(param.id, loaded.set_require_grad(tracked))
            }
            _ => {
                self.missing.get_or_insert(name);
                param
            }
        }
    }
}
