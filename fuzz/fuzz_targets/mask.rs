//! Masks: grey, coloured, in palettes, transparent.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{Png, check_decoding, check_mask, said};
use normalight_io::decode_mask;

fuzz_target!(|png: Png| {
    let bytes = png.bytes();
    let mask = said("mask.png", decode_mask("mask.png", &bytes));
    let image = check_decoding("mask.png", &bytes);
    // What is a picture is a mask, and of the same size.
    assert_eq!(mask.is_some(), image.is_some());
    if let (Some(mask), Some(image)) = (mask, image) {
        check_mask(&mask, image.width, image.height);
    }
});
