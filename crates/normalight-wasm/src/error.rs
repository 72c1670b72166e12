//! What can go wrong, as the page hears it.
use normalight_io::IoError;
use normalight_model::ModelError;
use serde::Serialize;
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

#[derive(Serialize)]
struct Thrown {
    kind: &'static str,
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
impl From<serde_wasm_bindgen::Error> for Failure {
    fn from(error: serde_wasm_bindgen::Error) -> Self {
        Self::Input(format!("settings: {error}"))
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        let (kind, message) = match failure {
            Failure::Input(message) => ("input", message),
            Failure::Cancelled => ("cancelled", ModelError::Cancelled.to_string()),
            Failure::Device(message) => ("device", message),
        };
        let thrown = Thrown { kind, message };
        serde_wasm_bindgen::to_value(&thrown).unwrap_or_else(|_| thrown.message.into())
    }
}
