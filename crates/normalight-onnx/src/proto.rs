//! The messages of ONNX, with the numbers of `onnx.proto` (<https://github.com/onnx/onnx/blob/main/onnx/onnx.proto>).
use crate::wire::Message;

/// The operators' version: the last before some reductions take their axes as inputs; all that networks here need is in it.
pub(crate) const OPSET: i64 = 17;

/// The version of the messages that belongs to [`OPSET`].
const IR_VERSION: i64 = 8;

/// `TensorProto.DataType`.
const FLOAT: i64 = 1;
const INT64: i64 = 7;

/// An operator's setting.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Attribute<'a> {
    Float(f32),
    Integer(i64),
    Integers(&'a [i64]),
    Text(&'a str),
}

/// A side of a tensor: fixed, or chosen by who runs the model.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Side {
    Fixed(usize),
    Free(&'static str),
}

/// What goes in or comes out.
#[derive(Debug, Clone)]
pub(crate) struct ValueInfo {
    pub(crate) name: &'static str,
    pub(crate) shape: Vec<Side>,
    /// What it means, in words.
    pub(crate) meaning: String,
}

pub(crate) fn node(
    operator: &str,
    inputs: &[&str],
    output: &str,
    attributes: &[(&str, Attribute)],
) -> Message {
    let attributes: Vec<Message> = attributes.iter().map(attribute).collect();
    Message::default()
        .texts(1, inputs.iter().copied())
        .text(2, output)
        .text(3, output)
        .text(4, operator)
        .messages(5, &attributes)
}

fn attribute(&(name, value): &(&str, Attribute)) -> Message {
    let named = Message::default().text(1, name);
    let (valued, kind) = match value {
        Attribute::Float(value) => (named.float(2, value), 1),
        Attribute::Integer(value) => (named.integer(3, value), 2),
        Attribute::Text(value) => (named.text(4, value), 3),
        Attribute::Integers(values) => (named.integers(8, values.iter().copied()), 7),
    };
    valued.integer(20, kind)
}

pub(crate) fn float_tensor(name: &str, shape: &[usize], values: &[f32]) -> Message {
    let bytes: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    tensor(name, shape, FLOAT, &bytes)
}

pub(crate) fn integer_tensor(name: &str, values: &[i64]) -> Message {
    let bytes: Vec<u8> = values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    tensor(name, &[values.len()], INT64, &bytes)
}

fn tensor(name: &str, shape: &[usize], kind: i64, bytes: &[u8]) -> Message {
    Message::default()
        .integers(1, shape.iter().map(|&side| side as i64))
        .integer(2, kind)
        .text(8, name)
        .bytes(9, bytes)
}

impl ValueInfo {
    fn message(&self) -> Message {
        let sides: Vec<Message> = self.shape.iter().map(|side| side.message()).collect();
        let shape = Message::default().messages(1, &sides);
        let tensor = Message::default().integer(1, FLOAT).message(2, &shape);
        Message::default()
            .text(1, self.name)
            .message(2, &Message::default().message(1, &tensor))
            .text(3, &self.meaning)
    }
}

impl Side {
    fn message(self) -> Message {
        match self {
            Self::Fixed(length) => Message::default().integer(1, length as i64),
            Self::Free(name) => Message::default().text(2, name),
        }
    }
}

/// Nodes in an order in which they can run, and the tensors that come with them.
pub(crate) fn graph(
    name: &str,
    (nodes, tensors): (&[Message], &[Message]),
    inputs: &[ValueInfo],
    outputs: &[ValueInfo],
) -> Message {
    let infos = |values: &[ValueInfo]| values.iter().map(ValueInfo::message).collect::<Vec<_>>();
    Message::default()
        .messages(1, nodes)
        .text(2, name)
        .messages(5, tensors)
        .messages(11, &infos(inputs))
        .messages(12, &infos(outputs))
}

/// A whole model, with entries that runtimes hand out by their names.
pub(crate) fn model(graph: &Message, about: &str, metadata: &[(&str, &str)]) -> Message {
    let entry = |&(key, value): &(&str, &str)| Message::default().text(1, key).text(2, value);
    let entries: Vec<Message> = metadata.iter().map(entry).collect();
    Message::default()
        .integer(1, IR_VERSION)
        .text(2, "normalight")
        .text(3, env!("CARGO_PKG_VERSION"))
        .text(6, about)
        .message(7, graph)
        // The operators of ONNX itself have the empty domain.
        .message(8, &Message::default().text(1, "").integer(2, OPSET))
        .messages(14, &entries)
}
