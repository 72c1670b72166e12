//! Damaged files must give an error or a picture, never a panic.
use crate::common::{FORMATS, encode, rgb8, sample};
use image::{DynamicImage, ImageFormat};
use normalight_io::{ColorMode, decode_image, read_lights};
use proptest::prelude::*;

/// Valid files: every format, and more variants of the formats that have them.
fn samples() -> Vec<(&'static str, Vec<u8>)> {
    let mut files: Vec<_> = FORMATS.map(|(name, format)| (name, sample(format))).into();
    for (name, format) in [FORMATS[0], FORMATS[2]] {
        files.push((
            name,
            encode(&DynamicImage::ImageRgb16(rgb8(7, 5).into_rgb16()), format),
        ));
        files.push((
            name,
            encode(&DynamicImage::ImageLuma8(rgb8(7, 5).into_luma8()), format),
        ));
    }
    for (name, format) in [FORMATS[3], FORMATS[4], FORMATS[5]] {
        files.push((
            name,
            encode(&DynamicImage::ImageRgba8(rgb8(7, 5).into_rgba8()), format),
        ));
        files.push((
            name,
            encode(&DynamicImage::ImageLuma8(rgb8(7, 5).into_luma8()), format),
        ));
    }
    let mut mapped_tga = vec![0, 1, 1, 0, 0, 4, 0, 24, 0, 0, 0, 0, 4, 0, 4, 0, 8, 0];
    mapped_tga.extend([9; 12]);
    mapped_tga.extend([0, 1, 2, 3, 3, 2, 1, 0, 0, 0, 1, 1, 2, 2, 3, 3]);
    assert!(decode_image("a.tga", &mapped_tga, ColorMode::Auto).is_ok());
    files.push(("a.tga", mapped_tga));
    files
}

/// Every header byte set to telling values, one at a time.
#[test]
fn single_bytes() {
    for (name, whole) in samples() {
        for at in 0..whole.len().min(160) {
            for value in [
                0,
                1,
                2,
                0x7F,
                0x80,
                0xFF,
                whole[at] ^ 1,
                whole[at].wrapping_add(8),
            ] {
                let mut bytes = whole.clone();
                bytes[at] = value;
                let _ = decode_image(name, &bytes, ColorMode::Auto);
            }
        }
    }
}

#[test]
fn every_length() {
    for (name, whole) in samples() {
        for length in 0..whole.len() {
            let _ = decode_image(name, &whole[..length], ColorMode::Auto);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_damage(
        which in 0usize..1000,
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        in_header in any::<bool>(),
        keep in any::<prop::sample::Index>(),
        cut in any::<bool>(),
    ) {
        let files = samples();
        let (name, mut bytes) = files[which % files.len()].clone();
        let reach = if in_header { bytes.len().min(64) } else { bytes.len() };
        for (at, value) in edits {
            bytes[at.index(reach)] = value;
        }
        if cut {
            bytes.truncate(keep.index(bytes.len()));
        }
        let _ = decode_image(name, &bytes, ColorMode::Auto);
    }

    #[test]
    fn noise_as_anything(noise in proptest::collection::vec(any::<u8>(), 0..200)) {
        for (name, format) in FORMATS {
            let mut bytes = sample(format)[..8].to_vec();
            bytes.extend(&noise);
            let _ = decode_image(name, &bytes, ColorMode::Auto);
        }
        let _ = decode_image("a.tga", &noise, ColorMode::Auto);
        for name in ["l.csv", "l.lp", "l.txt"] {
            let _ = read_lights(name, &noise, &[]);
        }
    }
}

#[test]
fn damaged_webp_variants() {
    // Lossless WebP is all that the encoder makes; its bit stream deserves every bit.
    let whole = sample(ImageFormat::WebP);
    for bit in 0..8 * whole.len() {
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        let _ = decode_image("a.webp", &bytes, ColorMode::Auto);
    }
}
