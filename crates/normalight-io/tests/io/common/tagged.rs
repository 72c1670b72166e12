//! A picture that says something of its colours, and the light that it then stands for.
use super::{encode, values};
use image::{DynamicImage, ImageFormat, RgbImage};
use normalight_core::Transfer;
use normalight_io::{ColorMode, DecodedImage, decode_image};

/// From linear Adobe RGB to linear sRGB, which share their white (Lindbloom).
pub const ADOBE: [[f32; 3]; 3] = [
    [1.3984, -0.3984, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -0.0429, 1.0429],
];
pub fn decode(name: &str, bytes: &[u8]) -> DecodedImage {
    decode_image(name, bytes, ColorMode::Auto).unwrap()
}

/// Dull colours, whose light stays below full scale in all primaries.
pub fn picture() -> RgbImage {
    RgbImage::from_fn(16, 4, |x, y| {
        image::Rgb([90 + 6 * x as u8, 130 + 20 * y as u8, 200 - 6 * x as u8])
    })
}

pub fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
        })
    })
}

/// The picture as PNG with chunks before its pixels.
pub fn png(chunks: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let plain = encode(&DynamicImage::ImageRgb8(picture()), ImageFormat::Png);
    // Signature and IHDR.
    let (head, rest) = plain.split_at(33);
    let mut bytes = head.to_vec();
    for (kind, content) in chunks {
        let body = [&kind[..], content].concat();
        bytes.extend((content.len() as u32).to_be_bytes());
        bytes.extend(&body);
        bytes.extend(crc(&body).to_be_bytes());
    }
    bytes.extend(rest);
    bytes
}

pub fn gamma(value: f64) -> (&'static [u8; 4], Vec<u8>) {
    (
        b"gAMA",
        ((value * 1e5).round() as u32).to_be_bytes().to_vec(),
    )
}

/// The picture's light through a curve and a matrix.
pub fn expected(curve: impl Fn(f32) -> f32, matrix: Option<[[f32; 3]; 3]>) -> Vec<f32> {
    let pixels = picture();
    let light = pixels.pixels().flat_map(|pixel| {
        let [r, g, b] = pixel.0.map(|code| curve(f32::from(code) / 255.0));
        match matrix {
            None => [r, g, b],
            Some(rows) => rows.map(|row| row[0] * r + row[1] * g + row[2] * b),
        }
    });
    light.collect()
}

pub fn assert_light(found: &DecodedImage, wanted: &[f32]) {
    assert_eq!(found.image.transfer, Transfer::Linear);
    let found = values(&found.image.samples);
    assert_eq!(found.len(), wanted.len());
    for (place, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let wanted = wanted.max(0.0);
        assert!(
            (found.max(0.0) - wanted).abs() < 0.003 * wanted.max(1.0),
            "{place}: {found} {wanted}"
        );
    }
}

pub fn srgb(code: f32) -> f32 {
    Transfer::Srgb.decode(code)
}
