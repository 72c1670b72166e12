//! The networks of Normalight as [ONNX](https://onnx.ai) models, for other programs: runtimes, converters, Python.
//!
//! A model is the network alone: photographs go in as `normalight_model`'s `LightInput` and `NormalInput` encode them, but with
//! channels first; what that means is written into the model, with the architecture and the SHA-256 of the weights, in its
//! metadata. Any number of photographs goes in, of any size where the network allows it.
//!
//! ```no_run
//! let [_, normal] = normalight_model::default_weights()?;
//! std::fs::write("normal.onnx", normalight_onnx::to_onnx(&normal)?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![deny(missing_docs)]

mod cells;
mod graph;
mod layers;
mod light;
mod normal;
mod proto;
mod stages;
#[cfg(test)]
mod tests;
mod wire;

use normalight_model::{Architecture, ModelError, Weights};

/// The version of ONNX's operators that models ask for.
pub const OPSET: i64 = proto::OPSET;

/// A network as the bytes of an ONNX model in single precision.
///
/// # Shapes
/// Light network, of any number of photographs: `images` `[images, 4, size, size]` to `directions` `[images, 3]`, `intensities`
/// `[images]` and `scores` `[images, classes]`. Normal network, of any number and size: `images`
/// `[images, 6 or 7, height, width]` to `normals` `[1, 3, height, width]`.
///
/// # Errors
/// [`ModelError::Tensor`] for weights whose tensors are not those of their architecture; their shapes are not looked at, but
/// by whoever loads the network. [`ModelError::Architecture`] for cells that nobody has chosen.
pub fn to_onnx(weights: &Weights) -> Result<Vec<u8>, ModelError> {
    let (about, (graph, values)) = match weights.architecture() {
        Architecture::Light(light) => (
            "Directions and intensities of lights from photographs (https://crates.io/crates/normalight-cli).",
            light::graph(weights, light)?,
        ),
        Architecture::Normal(normal) => (
            "Normals from photographs and their lights (https://crates.io/crates/normalight-cli).",
            normal::graph(weights, normal)?,
        ),
    };
    let architecture =
        serde_json::to_string(weights.architecture()).map_err(|reason| ModelError::Json {
            name: "architecture".into(),
            reason,
        })?;
    let mut metadata = vec![
        ("weights_sha256", weights.hash()),
        ("architecture", architecture.as_str()),
    ];
    metadata.extend(
        values
            .iter()
            .map(|value| (value.name, value.meaning.as_str())),
    );
    Ok(proto::model(&graph, about, &metadata).into_bytes())
}
