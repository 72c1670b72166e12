//! The mask that an estimation would take.
use crate::error::Failure;
use crate::file::{InputFile, named_bytes};
use crate::settings::Settings;
use js_sys::Uint8Array;
use normalight_core::MaskSource;
use normalight_io::{NamedBytes, read_stack};
use serde::Serialize;
use tsify::{Ts, Tsify};
use wasm_bindgen::prelude::*;

/// Where a mask came from: a file, transparency, a guess from the photographs, or nowhere: the whole frame.
#[derive(Debug, Serialize, Tsify)]
#[serde(rename_all = "lowercase")]
pub(crate) enum MaskOrigin {
    File,
    Alpha,
    Guessed,
    None,
}

impl From<&MaskSource> for MaskOrigin {
    fn from(source: &MaskSource) -> Self {
        match source {
            MaskSource::File(_) => Self::File,
            MaskSource::Alpha => Self::Alpha,
            MaskSource::Guessed => Self::Guessed,
            MaskSource::WholeFrame => Self::None,
        }
    }
}

/// The pixels of an object.
#[derive(Debug, Serialize, Tsify)]
pub struct ObjectMask {
    /// In pixels.
    width: usize,
    /// In pixels.
    height: usize,
    /// 255 inside, 0 outside; rows from the top.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    inside: Uint8Array,
    /// Where it came from.
    source: MaskOrigin,
    /// The mask's file name, or the source in words.
    words: String,
}

/// The mask that an estimation of these files would take, without estimating.
///
/// # Errors
/// Files or settings that do not do.
#[wasm_bindgen(js_name = objectMask)]
pub fn object_mask(
    files: Vec<InputFile>,
    mask: Option<InputFile>,
    settings: Ts<Settings>,
) -> Result<Ts<ObjectMask>, Failure> {
    let reading = settings.to_rust()?.reading(mask.map(NamedBytes::from));
    let input = read_stack(named_bytes(files), &reading)?;
    let inside = input.mask.inside();
    let codes: Vec<u8> = inside.iter().map(|&is| if is { 255 } else { 0 }).collect();
    let mask = ObjectMask {
        width: input.mask.width(),
        height: input.mask.height(),
        inside: Uint8Array::from(codes.as_slice()),
        source: MaskOrigin::from(&input.mask_source),
        words: input.mask_label().to_owned(),
    };
    Ok(mask.into_ts()?)
}
