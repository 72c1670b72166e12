//! Kinds of images that programs write, made here byte by byte.
mod color;
mod exr;
mod jpeg;
mod limits;
mod moving;
mod portable;
mod stacks;
mod tiff;
mod tiff_pages;
mod unread;
mod writer;

use crate::common::file;
use normalight_io::{
    ColorMode, DecodedImage, IoError, MaskChoice, Notice, ReadOptions, decode_image, read_stack,
};

fn decode(name: &str, bytes: &[u8]) -> Result<DecodedImage, IoError> {
    decode_image(name, bytes, ColorMode::Auto)
}

/// What is said about three shots, no two alike.
fn notices(extension: &str, make: impl Fn(u32) -> Vec<u8>) -> Vec<Notice> {
    let files = (0..3).map(|turn| file(&format!("{turn}.{extension}"), make(turn)));
    let options = ReadOptions {
        mask: MaskChoice::WholeFrame,
        ..ReadOptions::default()
    };
    read_stack(files.collect(), &options).unwrap().plan.notices
}
