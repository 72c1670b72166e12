//! Colour profiles, in a picture of four pixels.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_core::Samples;
use normalight_fuzz::{Chunk, Png, check_decoding};

fuzz_target!(|profile: &[u8]| {
    let picture = |color, pixels: &[u8]| Png {
        width: 1,
        height: 1,
        depth: 0,
        color,
        interlaced: false,
        before: vec![Chunk::Profile(profile.to_vec(), true)],
        pixels: pixels.to_vec(),
        complete: true,
        after: Vec::new(),
    };
    let grey = picture(0, &[0, 0, 255, 0, 127, 128]);
    let colors = picture(
        1,
        &[0, 0, 1, 2, 255, 254, 253, 0, 100, 0, 200, 128, 128, 128],
    );
    for picture in [grey, colors] {
        let image = check_decoding("a.png", &picture.bytes()).expect("the picture itself is good");
        if let Samples::F32(values) = &image.samples {
            assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
        }
    }
});
