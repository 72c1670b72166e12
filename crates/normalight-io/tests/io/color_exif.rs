//! What EXIF says of colours, in blocks that the tests write themselves.
use crate::common::tagged::{ADOBE, assert_light, decode, expected, gamma, picture, png};
use crate::common::values;
use image::{ExtendedColorType, ImageEncoder};
use normalight_core::Transfer;

/// A block of EXIF with a colour space and the DCF's word for it.
fn exif(space: u16, interoperability: &[u8; 4]) -> Vec<u8> {
    let entry = |tag: u16, kind: u16, count: u32, value: [u8; 4]| {
        let head = [tag.to_le_bytes(), kind.to_le_bytes()].concat();
        [head, count.to_le_bytes().to_vec(), value.to_vec()].concat()
    };
    let long = |value: u32| value.to_le_bytes();
    let directory = |entries: &[Vec<u8>]| {
        let count = (entries.len() as u16).to_le_bytes().to_vec();
        [count, entries.concat(), vec![0; 4]].concat()
    };
    let [low, high] = space.to_le_bytes();
    [
        b"II*\0\x08\0\0\0".to_vec(),
        directory(&[entry(0x8769, 4, 1, long(26))]),
        directory(&[
            entry(0xA001, 3, 1, [low, high, 0, 0]),
            entry(0xA005, 4, 1, long(56)),
        ]),
        directory(&[entry(1, 2, 4, *interoperability)]),
    ]
    .concat()
}

#[test]
fn exif_says_the_space_in_png_and_webp() {
    let adobe = expected(|code| code.powf(2.199_218_8), Some(ADOBE));
    let in_png = |block| decode("a.png", &png(&[(b"eXIf", block)]));
    let in_webp = |block| {
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut bytes);
        encoder.set_exif_metadata(block).unwrap();
        let picture = picture();
        encoder
            .write_image(&picture, 16, 4, ExtendedColorType::Rgb8)
            .unwrap();
        decode("a.webp", &bytes)
    };
    assert_light(&in_png(exif(0xFFFF, b"R03\0")), &adobe);
    assert_light(&in_webp(exif(0xFFFF, b"R03\0")), &adobe);
    assert_light(&in_png(exif(2, b"R98\0")), &adobe);
    assert_eq!(in_png(exif(1, b"R98\0")).image.transfer, Transfer::Srgb);
    assert_eq!(in_webp(exif(1, b"R03\0")).image.transfer, Transfer::Srgb);
    // A chunk of PNG's own is believed before EXIF.
    let both = png(&[gamma(1.0), (b"eXIf", exif(1, b"R98\0"))]);
    assert_eq!(decode("a.png", &both).image.transfer, Transfer::Linear);
    // Cut off anywhere, it says nothing or the same.
    let block = exif(0xFFFF, b"R03\0");
    for cut in 0..block.len() {
        in_png(block[..cut].to_vec());
    }
}

#[test]
fn exif_says_the_space_in_jpeg() {
    let jpeg = |block: Option<Vec<u8>>| {
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100);
        if let Some(block) = block {
            encoder.set_exif_metadata(block).unwrap();
        }
        encoder.encode_image(&picture()).unwrap();
        decode("a.jpg", &bytes).image
    };
    let plain = jpeg(None);
    let adobe = jpeg(Some(exif(0xFFFF, b"R03\0")));
    assert_eq!(
        (plain.transfer, adobe.transfer),
        (Transfer::Srgb, Transfer::Linear)
    );
    let [codes, lights] = [&plain, &adobe].map(|image| values(&image.samples));
    for (code, light) in codes.chunks(3).zip(lights.chunks(3)) {
        let [r, g, b] = [0, 1, 2].map(|k| code[k].powf(2.199_218_8));
        let wanted = ADOBE.map(|row| row[0] * r + row[1] * g + row[2] * b);
        for (light, wanted) in light.iter().zip(wanted) {
            assert!((light - wanted.clamp(0.0, 1.0)).abs() < 0.003);
        }
    }
    assert_eq!(jpeg(Some(exif(0xFFFF, b"R98\0"))).transfer, Transfer::Srgb);
}
