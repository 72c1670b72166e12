//! A graph of operators that grows node by node, on maps with channels first as ONNX wants them.
use crate::proto::{Attribute, ValueInfo, float_tensor, graph, integer_tensor, node};
use crate::wire::Message;
use normalight_model::{ModelError, Weights};

/// What flows from node to node, by its name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Value(String);

/// A graph with a network's weights.
pub(crate) struct GraphBuilder<'a> {
    weights: &'a Weights,
    nodes: Vec<Message>,
    tensors: Vec<Message>,
    /// How many of the weights' tensors are in the graph.
    used: usize,
}

impl<'a> GraphBuilder<'a> {
    pub(crate) fn new(weights: &'a Weights) -> Self {
        Self {
            weights,
            nodes: Vec::new(),
            tensors: Vec::new(),
            used: 0,
        }
    }

    /// What comes from outside under a name.
    pub(crate) fn input(&self, info: &ValueInfo) -> Value {
        Value(info.name.to_owned())
    }

    /// Hands a value out under a name.
    pub(crate) fn output(&mut self, info: &ValueInfo, value: &Value) {
        self.nodes
            .push(node("Identity", &[&value.0], info.name, &[]));
    }

    /// What an operator makes of values.
    pub(crate) fn node(
        &mut self,
        operator: &str,
        inputs: &[&Value],
        attributes: &[(&str, Attribute)],
    ) -> Value {
        let output = format!("{operator}_{}", self.nodes.len());
        let inputs: Vec<&str> = inputs.iter().map(|value| value.0.as_str()).collect();
        self.nodes
            .push(node(operator, &inputs, &output, attributes));
        Value(output)
    }

    /// One of the weights' tensors and its shape.
    pub(crate) fn weight(&mut self, path: &str) -> Result<(Value, &'a [usize]), ModelError> {
        let (shape, values) = self.weights.tensor(path)?;
        self.tensors.push(float_tensor(path, shape, values));
        self.used += 1;
        Ok((Value(path.to_owned()), shape))
    }

    /// Numbers that are no weights.
    pub(crate) fn floats(&mut self, shape: &[usize], values: &[f32]) -> Value {
        let name = self.constant_name();
        self.tensors.push(float_tensor(&name, shape, values));
        Value(name)
    }

    /// Shapes, axes and places.
    pub(crate) fn integers(&mut self, values: &[i64]) -> Value {
        let name = self.constant_name();
        self.tensors.push(integer_tensor(&name, values));
        Value(name)
    }

    fn constant_name(&self) -> String {
        format!("constant_{}", self.tensors.len())
    }

    /// The finished graph.
    ///
    /// # Errors
    /// [`ModelError::Tensor`] where the weights hold more tensors than the graph has taken.
    pub(crate) fn finish(
        self,
        name: &str,
        inputs: &[ValueInfo],
        outputs: &[ValueInfo],
    ) -> Result<Message, ModelError> {
        self.weights.expect_all_used(self.used)?;
        Ok(graph(name, (&self.nodes, &self.tensors), inputs, outputs))
    }

    /// The input that an operator may go without.
    pub(crate) fn nothing() -> Value {
        Value(String::new())
    }

    pub(crate) fn relu(&mut self, input: &Value) -> Value {
        self.node("Relu", &[input], &[])
    }

    pub(crate) fn add(&mut self, one: &Value, other: &Value) -> Value {
        self.node("Add", &[one, other], &[])
    }

    /// Maps side by side.
    pub(crate) fn beside(&mut self, maps: &[&Value]) -> Value {
        self.node("Concat", maps, &[("axis", Attribute::Integer(1))])
    }

    /// `[1, ...]` of `[images, ...]`, by `ReduceMax` or `ReduceMean`.
    pub(crate) fn over_images(&mut self, reduction: &str, maps: &Value) -> Value {
        self.node(reduction, &[maps], &[("axes", Attribute::Integers(&[0]))])
    }

    /// What all images share, repeated for each of them.
    pub(crate) fn for_each_of(&mut self, shared: &Value, maps: &Value) -> Value {
        let shape = self.node("Shape", &[maps], &[]);
        self.node("Expand", &[shared, &shape], &[])
    }

    /// Every `step`-th row and column from the one of this number on.
    pub(crate) fn every(&mut self, step: i64, first: i64, maps: &Value) -> Value {
        let starts = self.integers(&[first; 2]);
        let ends = self.integers(&[i64::MAX; 2]);
        let axes = self.integers(&[2, 3]);
        let steps = self.integers(&[step; 2]);
        self.node("Slice", &[maps, &starts, &ends, &axes, &steps], &[])
    }
}
