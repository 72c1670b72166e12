//! What can go wrong, as the page hears it.
use normalight_io::IoError;
use normalight_model::ModelError;
use serde::Serialize;
use std::error::Error;
use tsify::Tsify;
use wasm_bindgen::JsValue;

/// A failure on its way to JavaScript, where it becomes `{ kind, message }`.
#[derive(Debug)]
pub enum Failure {
    /// The given files or settings do not do.
    Input(String),
    /// The run was stopped from outside.
    Cancelled,
    /// The device or the networks failed.
    Device(String),
}

/// What failed: the given files or settings, nothing (the run was stopped), or the device or the networks.
#[derive(Serialize, Tsify)]
#[serde(rename_all = "lowercase")]
enum FailureKind {
    Input,
    Cancelled,
    Device,
}

/// What the module throws.
#[derive(Serialize, Tsify)]
struct Thrown {
    kind: FailureKind,
    /// In a sentence, with the file.
    message: String,
}

impl From<IoError> for Failure {
    fn from(error: IoError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<ModelError> for Failure {
    fn from(error: ModelError) -> Self {
        match error {
            ModelError::Cancelled => Self::Cancelled,
            ModelError::Core(error) => Self::Input(error.to_string()),
            error => Self::Device(error.to_string()),
        }
    }
}

/// Settings that cannot be read, or a result that JavaScript cannot hold.
impl From<tsify::Error> for Failure {
    fn from(error: tsify::Error) -> Self {
        // Without tsify's words about Rust's types.
        let reason = error
            .source()
            .map_or_else(|| error.to_string(), ToString::to_string);
        Self::Input(format!("settings: {reason}"))
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        let (kind, message) = match failure {
            Failure::Input(message) => (FailureKind::Input, message),
            Failure::Cancelled => (FailureKind::Cancelled, ModelError::Cancelled.to_string()),
            Failure::Device(message) => (FailureKind::Device, message),
        };
        let thrown = Thrown { kind, message };
        serde_wasm_bindgen::to_value(&thrown).unwrap_or_else(|_| thrown.message.into())
    }
}
