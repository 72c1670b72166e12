//! Small pictures of every kind, by independent encoders.
use crate::Seed;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes,
    IntegerBounds, Layer, LayerAttributes, LineOrder, SmallVec, Vec2, WritableImage,
};
use image::{DynamicImage, ImageFormat, RgbImage};
use std::io::Cursor;

/// Their extensions' places in the target `image`.
const FORMATS: [(u8, ImageFormat); 8] = [
    (0, ImageFormat::Png),
    (1, ImageFormat::Jpeg),
    (2, ImageFormat::Tiff),
    (3, ImageFormat::Tga),
    (4, ImageFormat::Bmp),
    (5, ImageFormat::WebP),
    (6, ImageFormat::OpenExr),
    (7, ImageFormat::Pnm),
];

pub fn seeds() -> Vec<Seed> {
    let mut seeds: Vec<Seed> = Vec::new();
    let picture = RgbImage::from_fn(9, 7, |x, y| {
        image::Rgb([30 * x as u8, 35 * y as u8, 10 * (x + y) as u8])
    });
    let picture = DynamicImage::ImageRgb8(picture);
    let variants = [
        ("rgb8", picture.clone()),
        ("grey8", DynamicImage::ImageLuma8(picture.to_luma8())),
        ("rgba8", DynamicImage::ImageRgba8(picture.to_rgba8())),
        ("rgb16", DynamicImage::ImageRgb16(picture.to_rgb16())),
        ("rgb32", DynamicImage::ImageRgb32F(picture.to_rgb32f())),
    ];
    for (first, format) in FORMATS {
        for (name, picture) in &variants {
            let mut bytes = Cursor::new(Vec::new());
            // Not every format has every kind of sample.
            if picture.write_to(&mut bytes, format).is_ok() {
                let name = format!("{format:?}-{name}").to_lowercase();
                seeds.push(("image", name, [&[first], &bytes.into_inner()[..]].concat()));
            }
        }
    }
    let float_map = |kind: u8, scale: &str, values: usize| {
        let head = [&[kind][..], format!("\n3 2\n{scale}\n").as_bytes()].concat();
        let values = (0..values).flat_map(|k| (k as f32 / 9.0).to_be_bytes());
        [head, values.collect()].concat()
    };
    for (name, content) in [
        ("rgb", float_map(b'F', "1.0", 18)),
        ("grey", float_map(b'f', "-1", 6)),
        (
            "text",
            b"3\n# a\n3 2\n9\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n".to_vec(),
        ),
        ("wide", b"5 3 2 65535\nabcdefghijkl".to_vec()),
        (
            "pam",
            b"7\nWIDTH 2\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\nabcdefgh"
                .to_vec(),
        ),
    ] {
        seeds.push(("pfm", name.into(), content));
    }
    for (name, profile) in [
        ("srgb", moxcms::ColorProfile::new_srgb()),
        ("adobe", moxcms::ColorProfile::new_adobe_rgb()),
        ("grey", moxcms::ColorProfile::new_gray_with_gamma(1.8)),
        ("lab", moxcms::ColorProfile::new_lab()),
    ] {
        if let Ok(profile) = profile.encode() {
            seeds.push(("profile", name.into(), profile));
        }
    }
    seeds.extend(layered());
    seeds
}

fn layered() -> Vec<Seed> {
    let size = (9, 6);
    let samples = |kind: usize| {
        let values: Vec<f32> = (0..size.0 * size.1).map(|k| (k % 7) as f32 / 7.0).collect();
        match kind % 3 {
            0 => FlatSamples::F32(values),
            1 => FlatSamples::F16(values.into_iter().map(half::f16::from_f32).collect()),
            _ => FlatSamples::U32(values.into_iter().map(|v| (7.0 * v) as u32).collect()),
        }
    };
    let layer = |name: &str, channels: &[&str], compression, blocks| {
        let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> = channels
            .iter()
            .enumerate()
            .map(|(kind, channel)| AnyChannel::new(*channel, samples(kind)))
            .collect();
        let encoding = Encoding {
            compression,
            blocks,
            line_order: LineOrder::Increasing,
        };
        Layer::new(
            size,
            LayerAttributes::named(name),
            encoding,
            AnyChannels::sort(channels),
        )
    };
    let compressions = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ];
    let tiles = Blocks::Tiles(Vec2(4, 4));
    let mut seeds: Vec<Seed> = Vec::new();
    for (place, compression) in compressions.into_iter().enumerate() {
        for (kind, channels, blocks) in [
            ("rgb", &["R", "G", "B"][..], Blocks::ScanLines),
            ("tiles", &["diffuse.R", "diffuse.G", "diffuse.B"], tiles),
            ("grey", &["Y"], Blocks::ScanLines),
        ] {
            let mut bytes = Cursor::new(Vec::new());
            let image = Image::from_layer(layer("a", channels, compression, blocks));
            if image.write().non_parallel().to_buffered(&mut bytes).is_ok() {
                // The target puts the first four bytes before it.
                seeds.push((
                    "exr",
                    format!("{kind}-{place}"),
                    bytes.into_inner()[4..].to_vec(),
                ));
            }
        }
    }
    let layers = [
        layer("a", &["Z"], Compression::ZIP1, Blocks::ScanLines),
        layer("b", &["R", "G", "B", "A"], Compression::RLE, tiles),
    ];
    let bounds = IntegerBounds::from_dimensions(size);
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layers(ImageAttributes::new(bounds), layers.to_vec());
    if image.write().non_parallel().to_buffered(&mut bytes).is_ok() {
        seeds.push(("exr", "layers".into(), bytes.into_inner()[4..].to_vec()));
    }
    seeds
}
