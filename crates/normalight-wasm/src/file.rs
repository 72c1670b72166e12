//! Files as they come in and go out.
use js_sys::Uint8Array;
use normalight_io::NamedBytes;
use serde::Serialize;
use tsify::Tsify;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = "
/** A file in memory. */
export interface InputFile { readonly name: string; readonly bytes: Uint8Array }
";

#[wasm_bindgen]
extern "C" {
    /// A file in memory: an object with `name` and `bytes`.
    #[wasm_bindgen(typescript_type = "InputFile")]
    pub type InputFile;

    #[wasm_bindgen(method, getter)]
    fn name(this: &InputFile) -> String;

    #[wasm_bindgen(method, getter)]
    fn bytes(this: &InputFile) -> Vec<u8>;
}

impl From<InputFile> for NamedBytes {
    fn from(file: InputFile) -> Self {
        Self {
            name: file.name(),
            bytes: file.bytes(),
        }
    }
}

pub(crate) fn named_bytes(files: Vec<InputFile>) -> Vec<NamedBytes> {
    files.into_iter().map(NamedBytes::from).collect()
}

/// A file to keep.
#[derive(Debug, Serialize, Tsify)]
pub(crate) struct OutputFile {
    /// File name.
    #[tsify(type = "OutputName")]
    name: &'static str,
    /// Content.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    bytes: Uint8Array,
}

impl OutputFile {
    pub(crate) fn new(name: &'static str, bytes: &[u8]) -> Self {
        Self {
            name,
            bytes: Uint8Array::from(bytes),
        }
    }
}
