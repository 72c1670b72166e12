//! A network's numbers under the names of its parts, on the host.
use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::tensor::{Element, Gradients, Tensor, TensorData};
use std::collections::BTreeMap;
use std::marker::PhantomData;

/// Values by name.
pub type NamedTensors = BTreeMap<String, Vec<f32>>;

/// All numbers of a network: weights and running statistics.
///
/// Training networks must come through `valid()`: without it the last update of the running
/// statistics is still on its way, and a resumed run would not continue exactly.
pub fn collect<M: Module>(network: &M) -> NamedTensors {
    read_all::<OnHost, M>(network, None)
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

/// What is read of a tensor.
pub(crate) trait Read {
    /// What is left of it.
    type Value;

    /// Of a tensor, apart from any graph.
    fn read<const D: usize>(tensor: Tensor<D>) -> Self::Value;
}

/// Its values on the host, in any precision.
#[derive(Debug, Clone)]
pub(crate) struct Values<E>(PhantomData<E>);

/// Its values on the host as training has them.
pub(crate) type OnHost = Values<f32>;

/// The values where they are, flat.
#[derive(Debug, Clone)]
pub(crate) struct OnDevice;

impl<E: Element> Read for Values<E> {
    type Value = Vec<E>;

    fn read<const D: usize>(tensor: Tensor<D>) -> Vec<E> {
        host(tensor)
    }
}

impl Read for OnDevice {
    type Value = Tensor<1>;

    fn read<const D: usize>(tensor: Tensor<D>) -> Tensor<1> {
        let count = tensor.shape().num_elements();
        tensor.inner().reshape([count])
    }
}

/// Reads every number of a network, or every gradient that there is, by the names of the weights.
pub(crate) fn read_all<R: Read, M: Module>(
    network: &M,
    gradients: Option<&Gradients>,
) -> BTreeMap<String, R::Value> {
    let mut reader = Reader::<R> {
        gradients,
        path: Vec::new(),
        found: BTreeMap::new(),
    };
    network.visit(&mut reader);
    reader.found
}

struct Reader<'a, R: Read> {
    /// Read instead of the numbers.
    gradients: Option<&'a Gradients>,
    path: Vec<String>,
    found: BTreeMap<String, R::Value>,
}

impl<R: Read> ModuleVisitor for Reader<'_, R> {
    fn enter_module(&mut self, name: &str, _container: &str) {
        self.path.push(name.to_owned());
    }

    fn exit_module(&mut self, _name: &str, _container: &str) {
        self.path.pop();
    }

    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        let tensor = match self.gradients {
            Some(gradients) => param.val().grad(gradients),
            None => Some(param.val()),
        };
        if let Some(tensor) = tensor {
            self.found.insert(self.path.join("."), R::read(tensor));
        }
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
