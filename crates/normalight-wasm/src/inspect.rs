//! A look at files before anything is estimated.
use crate::error::Failure;
use crate::file::{InputFile, named_bytes};
use js_sys::Uint8Array;
use normalight_io::{
    ColorMode, LeftOut, NamedBytes, Notice, content_decides, decode_image, find_list,
    left_out_lines, notice_lines, plan_contents, read_text,
};
use serde::Serialize;
use tsify::{Ts, Tsify};
use wasm_bindgen::prelude::*;

/// Which of some files are the photographs, and which is the mask.
#[derive(Debug, Serialize, Tsify)]
pub struct Plan {
    /// Positions of the images among the files, in the order of the stack.
    images: Vec<usize>,
    /// Position of the mask among the files.
    #[tsify(optional)]
    mask: Option<usize>,
    /// Files that a person might miss among the images, and why they are not.
    #[serde(rename = "leftOut")]
    left_out: Vec<LeftOut>,
    /// What is doubtful.
    notices: Vec<Notice>,
    /// Both in words, a line each, as the command says them.
    words: Vec<String>,
}

/// A photograph in few pixels.
#[derive(Debug, Serialize, Tsify)]
pub struct Thumbnail {
    /// In pixels.
    width: usize,
    /// In pixels.
    height: usize,
    /// 8-bit sRGB with full alpha; rows from the top.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "Uint8Array<ArrayBuffer>")]
    rgba: Uint8Array,
}

/// Which of the files are the images, in which order, and which is the mask. Names count, the content of
/// text files, and where a name does not tell whether it is an image the first bytes: the others may be
/// left out.
///
/// # Errors
/// A list among the files that is wrong or too long.
#[wasm_bindgen]
pub fn plan(files: Vec<InputFile>) -> Result<Ts<Plan>, Failure> {
    let files = named_bytes(files);
    let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    let list = find_list(&names, |index| {
        let file = &files[index];
        read_text(&file.name, &file.bytes)
    })?;
    let list = list
        .as_ref()
        .map(|(index, text)| (names[*index], text.as_str()));
    let told = |&(_, file): &(usize, &NamedBytes)| content_decides(&file.name);
    let heads: Vec<(usize, Vec<u8>)> = files
        .iter()
        .enumerate()
        .filter(told)
        .map(|(index, file)| (index, file.bytes.clone()))
        .collect();
    let plan = plan_contents(&names, &heads, list)?;
    let words = [
        left_out_lines(&plan.left_out, false),
        notice_lines(&plan.notices),
    ];
    let plan = Plan {
        images: plan.images,
        mask: plan.mask,
        left_out: plan.left_out,
        notices: plan.notices,
        words: words.concat(),
    };
    Ok(plan.into_ts()?)
}

/// One photograph with its longer side brought down to `side` pixels; `color` says how its samples
/// relate to light.
///
/// # Errors
/// A file that is no complete image of a known format.
#[wasm_bindgen]
pub fn thumbnail(
    file: InputFile,
    color: Ts<ColorMode>,
    side: usize,
) -> Result<Ts<Thumbnail>, Failure> {
    let color = color.to_rust()?;
    let NamedBytes { name, bytes } = file.into();
    let image = decode_image(&name, &bytes, color)?.image;
    let small = normalight_io::thumbnail(&image, side);
    let thumbnail = Thumbnail {
        width: small.width,
        height: small.height,
        rgba: Uint8Array::from(small.rgba.as_slice()),
    };
    Ok(thumbnail.into_ts()?)
}
