//! A look at files before anything is estimated.
use crate::error::Failure;
use crate::file::{InputFile, named_bytes};
use js_sys::Uint8Array;
use normalight_io::{ColorMode, NamedBytes, decode_image, find_list, plan_stack, read_text};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// Positions among the files.
#[derive(Serialize)]
struct Plan {
    images: Vec<usize>,
    mask: Option<usize>,
}

#[derive(Serialize)]
struct Thumbnail {
    width: usize,
    height: usize,
    #[serde(with = "serde_wasm_bindgen::preserve")]
    rgba: Uint8Array,
}

/// Which of the files are the images, in which order, and which is the mask. Only names count, and
/// the content of text files: the bytes of other files may be left out.
///
/// # Errors
/// A list among the files that is wrong or too long.
#[wasm_bindgen]
pub fn plan(files: Vec<InputFile>) -> Result<JsValue, Failure> {
    let files = named_bytes(files);
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let list = find_list(&names, |index| {
        let file = &files[index];
        read_text(&file.name, &file.bytes)
    })?;
    let list = list
        .as_ref()
        .map(|(index, text)| (names[*index], text.as_str()));
    let plan = plan_stack(&names, list)?;
    Ok(serde_wasm_bindgen::to_value(&Plan {
        images: plan.images,
        mask: plan.mask,
    })?)
}

/// One photograph with its longer side brought down to `side` pixels; `color` says how its samples
/// relate to light.
///
/// # Errors
/// A file that is no complete image of a known format.
#[wasm_bindgen]
pub fn thumbnail(file: InputFile, color: JsValue, side: usize) -> Result<JsValue, Failure> {
    let color: ColorMode = serde_wasm_bindgen::from_value(color)?;
    let NamedBytes { name, bytes } = file.into();
    let image = decode_image(&name, &bytes, color)?.image;
    let small = normalight_io::thumbnail(&image, side);
    Ok(serde_wasm_bindgen::to_value(&Thumbnail {
        width: small.width,
        height: small.height,
        rgba: Uint8Array::from(small.rgba.as_slice()),
    })?)
}
