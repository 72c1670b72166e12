//! Images of every kind, as they are: the first byte chooses the extension, the content decides.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_fuzz::check_decoding;

const NAMES: [&str; 9] = [
    "a.png", "a.jpg", "a.tif", "a.tga", "a.bmp", "a.webp", "a.exr", "a.pgm", "a.pfm",
];

fuzz_target!(|data: &[u8]| {
    if let Some((&first, bytes)) = data.split_first() {
        check_decoding(NAMES[usize::from(first) % NAMES.len()], bytes);
    }
});
