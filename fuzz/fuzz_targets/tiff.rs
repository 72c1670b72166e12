//! TIFF around arbitrary settings.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::{Tiff, check_decoding};

fuzz_target!(|tiff: Tiff| {
    check_decoding("a.tif", &tiff.bytes());
});
