//! Files as they come in and go out.
use js_sys::Uint8Array;
use normalight_io::{NamedBytes, Notice};
use serde::Serialize;
use std::collections::BTreeMap;
use tsify::Tsify;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = "
/** A file in memory; `decodedFrom` says which format the browser made its PNG of. */
export interface InputFile { readonly name: string; readonly bytes: Uint8Array; readonly decodedFrom?: string }
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

    #[wasm_bindgen(method, getter, js_name = decodedFrom)]
    fn decoded_from(this: &InputFile) -> Option<String>;
}

/// What there is to say of files that the browser decoded, one notice for each format.
pub(crate) fn decoded_by_browser(files: &[InputFile]) -> Vec<Notice> {
    let mut formats: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files {
        if let Some(format) = file.decoded_from() {
            formats.entry(format).or_default().push(file.name());
        }
    }
    let notice = |(format, files)| Notice::DecodedByBrowser { format, files };
    formats.into_iter().map(notice).collect()
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
