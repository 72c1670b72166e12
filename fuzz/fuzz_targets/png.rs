//! PNG around arbitrary chunks; integers stay finite whatever the chunks say.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_core::Samples;
use normalight_fuzz::{Png, check_decoding};

fuzz_target!(|png: Png| {
    let Some(image) = check_decoding("a.png", &png.bytes()) else {
        return;
    };
    let (width, height) = png.size();
    // An orientation may have turned it.
    let (short, long) = (width.min(height), width.max(height));
    assert_eq!(
        (image.width.min(image.height), image.width.max(image.height)),
        (short, long)
    );
    if let Samples::F32(values) = &image.samples {
        assert!(values.iter().all(|value| value.is_finite()));
    }
});
