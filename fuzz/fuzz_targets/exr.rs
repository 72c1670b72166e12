//! EXR, seeded with layers and compressions of every kind.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::check_decoding;

fuzz_target!(|data: &[u8]| {
    check_decoding("a.exr", &[b"\x76\x2f\x31\x01", data].concat());
});
