//! Portable float maps, and the other portable maps.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::check_decoding;

fuzz_target!(|data: &[u8]| {
    check_decoding("a.pfm", &[b"P", data].concat());
});
