//! A network's numbers under the names of its parts, on the host.
use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::tensor::{Element, Tensor, TensorData};
use std::collections::BTreeMap;

/// Values by name.
pub type NamedTensors = BTreeMap<String, Vec<f32>>;

/// All numbers of a network: weights and running statistics.
///
/// Training networks must come through `valid()`: without it the last update of the running
/// statistics is still on its way, and a resumed run would not continue exactly.
pub fn collect<M: Module>(network: &M) -> NamedTensors {
    let mut collector = Collector::default();
    network.visit(&mut collector);
    collector.found
}

/// Puts numbers into a network; those it does not know stay in `tensors`.
///
/// # Errors
/// The name of a weight that is missing or of another size.
pub fn fill<M: Module>(network: M, tensors: &mut NamedTensors) -> Result<M, String> {
    let mut filler = Filler {
        tensors,
        path: Vec::new(),
        missing: None,
    };
    let network = network.map(&mut filler);
    match filler.missing {
        Some(name) => Err(format!("weight {name} is missing or has another size")),
        None => Ok(network),
    }
}

/// Takes what is under `prefix/`, without the prefix.
pub fn take(tensors: &mut NamedTensors, prefix: &str) -> NamedTensors {
    let start = format!("{prefix}/");
    let (found, rest) = std::mem::take(tensors)
        .into_iter()
        .partition(|(name, _)| name.starts_with(&start));
    *tensors = rest;
    let found: NamedTensors = found;
    found
        .into_iter()
        .map(|(name, values)| (name[start.len()..].to_owned(), values))
        .collect()
}

/// The reverse of [`take`].
pub fn put(tensors: &mut NamedTensors, prefix: &str, more: NamedTensors) {
    let more = more.into_iter();
    tensors.extend(more.map(|(name, values)| (format!("{prefix}/{name}"), values)));
}

/// A tensor's values; training tensors are f32 by construction.
pub fn host<E: Element, const D: usize>(tensor: Tensor<D>) -> Vec<E> {
    let Ok(values) = tensor.into_data().convert::<E>().try_to_vec::<E>() else {
        unreachable!("values were converted to the type that is asked for");
    };
    values
}

/// A loss as a number.
pub fn scalar(loss: Tensor<1>) -> f32 {
    host(loss).first().copied().unwrap_or(f32::NAN)
}

#[derive(Default)]
struct Collector {
    path: Vec<String>,
    found: NamedTensors,
}

impl ModuleVisitor for Collector {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        self.found.insert(self.path.join("."), host(param.val()));
    }
}

struct Filler<'a> {
    tensors: &'a mut NamedTensors,
    path: Vec<String>,
    missing: Option<String>,
}

impl ModuleMapper for Filler<'_> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let name = self.path.join(".");
        let tensor = param.val();
        match self.tensors.remove(&name) {
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
