//! JPEG whole, or refused.
use crate::kinds::decode;
use image::{ExtendedColorType, codecs::jpeg::JpegEncoder};
use normalight_core::Samples;
use normalight_io::IoError;

/// Noise, so that every part of the picture takes room in the file.
fn noise(bytes: usize) -> Vec<u8> {
    let mut state = 1u32;
    let next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    };
    std::iter::repeat_with(next).take(bytes).collect()
}

fn jpeg(codes: &[u8], side: u32, color: ExtendedColorType) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut bytes, 90);
    encoder.encode(codes, side, side, color).unwrap();
    bytes
}

/// A file that ends early and got an end mark later: decoders fill the rest with grey.
#[test]
fn half_an_image_is_an_error() {
    let whole = jpeg(&noise(96 * 96 * 3), 96, ExtendedColorType::Rgb8);
    assert!(decode("a.jpg", &whole).is_ok());
    for tenths in 3..9 {
        let mut cut = whole[..whole.len() * tenths / 10].to_vec();
        assert!(decode("a.jpg", &cut).is_err());
        cut.extend([0xFF, 0xD9]);
        let error = decode("a.jpg", &cut).expect_err(&tenths.to_string());
        assert!(
            matches!(&error, IoError::Decode { name, format: "JPEG", .. } if name == "a.jpg"),
            "{error}"
        );
    }
}

#[test]
fn grey_stays_one_channel() {
    let ramp: Vec<u8> = (0..32 * 32)
        .map(|k| (k % 32 * 4 + k / 32 * 3) as u8)
        .collect();
    let found = decode("a.jpg", &jpeg(&ramp, 32, ExtendedColorType::L8))
        .unwrap()
        .image;
    assert_eq!(found.channels, 1);
    let Samples::U8(codes) = found.samples else {
        panic!()
    };
    assert!(codes.iter().zip(&ramp).all(|(a, b)| a.abs_diff(*b) < 12));
}

/// The frame of a whole file, rewritten: none of these may reach the decoder.
#[test]
fn variants_are_refused_by_name() {
    let whole = jpeg(&noise(16 * 16 * 3), 16, ExtendedColorType::Rgb8);
    let frame = whole
        .windows(2)
        .position(|mark| mark == [0xFF, 0xC0])
        .unwrap();
    for (offset, value, words, advice) in [
        (4, 12, "12 bits", "16 bits"),
        (9, 4, "CMYK", "RGB"),
        (9, 2, "2 channels", "RGB"),
        (1, 0xC3, "lossless", "PNG"),
        (1, 0xC9, "arithmetic", "PNG"),
        (1, 0xF7, "JPEG-LS", "PNG"),
    ] {
        let mut bytes = whole.clone();
        bytes[frame + offset] = value;
        let error = decode("a.jpg", &bytes).unwrap_err();
        assert!(matches!(&error, IoError::Unread { .. }), "{error}");
        let error = error.to_string();
        assert!(error.starts_with("a.jpg: JPEG with"), "{error}");
        assert!(error.contains(words) && error.contains(advice), "{error}");
    }
}
