//! Small pictures in every format, made by an independent encoder.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
#![allow(dead_code)]
pub mod archives;
pub mod meshes;
pub mod published;
pub mod tagged;

use image::{DynamicImage, ImageFormat};
use normalight_core::Samples;
use normalight_io::NamedBytes;
use std::io::Cursor;

pub const FORMATS: [(&str, ImageFormat); 7] = [
    ("a.png", ImageFormat::Png),
    ("a.jpg", ImageFormat::Jpeg),
    ("a.tif", ImageFormat::Tiff),
    ("a.tga", ImageFormat::Tga),
    ("a.bmp", ImageFormat::Bmp),
    ("a.webp", ImageFormat::WebP),
    ("a.exr", ImageFormat::OpenExr),
];

pub fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A smooth RGB picture, brighter to the lower right.
pub fn rgb8(width: u32, height: u32) -> DynamicImage {
    DynamicImage::ImageRgb8(image::RgbImage::from_fn(width, height, |x, y| {
        image::Rgb([40 + 4 * x as u8, 50 + 4 * y as u8, 60 + 2 * (x + y) as u8])
    }))
}

/// The picture as each format stores it best.
pub fn sample(format: ImageFormat) -> Vec<u8> {
    let image = rgb8(16, 12);
    match format {
        ImageFormat::OpenExr => encode(&DynamicImage::ImageRgb32F(image.to_rgb32f()), format),
        _ => encode(&image, format),
    }
}

pub fn file(name: &str, bytes: Vec<u8>) -> NamedBytes {
    NamedBytes {
        name: name.to_owned(),
        bytes,
    }
}

/// Three PNG photographs of the given size, no two alike.
pub fn three(width: u32, height: u32) -> Vec<NamedBytes> {
    [("1.png", 0), ("2.png", 1), ("10.png", 2)]
        .map(|(name, turn)| file(name, shaded_png(width, height, turn)))
        .to_vec()
}

/// The picture of [`rgb8`] as PNG, each `turn` brightened towards another side.
pub fn shaded_png(width: u32, height: u32, turn: u32) -> Vec<u8> {
    let mut picture = rgb8(width, height).into_rgb8();
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let shade = 7 * (turn * x + turn * turn * y) as u8 % 50;
        pixel.0 = pixel.0.map(|code| code + shade);
    }
    encode(&DynamicImage::ImageRgb8(picture), ImageFormat::Png)
}

/// A mask of the given pixels.
pub fn mask_png(width: u32, height: u32, inside: impl Fn(u32, u32) -> bool) -> Vec<u8> {
    let image = image::RgbImage::from_fn(width, height, |x, y| {
        image::Rgb([255 * u8::from(inside(x, y)); 3])
    });
    encode(&DynamicImage::ImageRgb8(image), ImageFormat::Png)
}

/// Samples as numbers, full scale 1.
pub fn values(samples: &Samples) -> Vec<f32> {
    match samples {
        Samples::U8(codes) => codes.iter().map(|&code| f32::from(code) / 255.0).collect(),
        Samples::U16(codes) => codes
            .iter()
            .map(|&code| f32::from(code) / 65_535.0)
            .collect(),
        Samples::F32(values) => values.clone(),
    }
}
