//! Bytes that the fuzz targets found, or that were thought of while they were written.
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, SmallVec, WritableImage,
};
use image::ImageEncoder;
use normalight_core::{Light, Samples, Vec3};
use normalight_io::{ColorMode, decode_image, lights_csv, lights_lp, read_lights};
use std::io::Cursor;

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

/// Once a call for each pair of quotes, until the stack was full.
#[test]
fn a_line_of_quotes() {
    let text = "\"a\"".repeat(500_000);
    assert!(read_lights("l.lp", text.as_bytes(), &names(&["a.png"])).is_err());
}

/// Once each number moved all those before it.
#[test]
fn a_line_of_numbers() {
    let text = "1 ".repeat(1_000_000);
    assert!(read_lights("l.lp", text.as_bytes(), &names(&["a.png"])).is_err());
}

/// Primaries that are no colours made samples that are no numbers, and with them the whole stack was
/// refused; the profile is set aside instead.
#[test]
fn profiles_without_colours() {
    let picture =
        image::RgbImage::from_fn(4, 4, |x, y| image::Rgb([60 * x as u8, 60 * y as u8, 9]));
    for colorant in [0.0, f64::NAN, 1e-300, 1e30] {
        let mut profile = moxcms::ColorProfile::new_adobe_rgb();
        profile.red_colorant.x = colorant;
        profile.red_colorant.y = colorant;
        profile.red_colorant.z = colorant;
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        let profile = profile.encode().unwrap();
        encoder.set_icc_profile(profile).unwrap();
        encoder
            .write_image(&picture, 4, 4, image::ExtendedColorType::Rgb8)
            .unwrap();
        let image = decode_image("a.png", &bytes, ColorMode::Auto)
            .unwrap()
            .image;
        if let Samples::F32(values) = image.samples {
            assert!(values.iter().all(|value| value.is_finite()), "{colorant}");
        }
    }
}

/// Each layer was within the limit, all together were not.
#[test]
fn many_large_layers() {
    let layer = |name: &str| {
        let channel = |name: &str| AnyChannel::new(name, FlatSamples::F32(vec![0.5; 4]));
        let channels: SmallVec<[_; 4]> = [channel("Z"), channel("id")].into_iter().collect();
        let attributes = LayerAttributes::named(name);
        let channels = AnyChannels::sort(channels);
        Layer::new((2, 2), attributes, Encoding::UNCOMPRESSED, channels)
    };
    let layers: Vec<_> = ["a", "b", "c"].map(layer).into();
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((2, 2)));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layers(attributes, layers);
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    let mut bytes = bytes.into_inner();
    let error = decode_image("a.exr", &bytes, ColorMode::Auto).unwrap_err();
    assert!(error.to_string().contains("the channels Z, id"), "{error}");
    // The windows of all layers now end at 9999, 9999.
    let window = b"dataWindow\0box2i\0\x10\0\0\0";
    let mut found = 0;
    for at in 0..bytes.len() - window.len() {
        if bytes[at..].starts_with(window) {
            let end = at + window.len() + 8;
            bytes[end..end + 4].copy_from_slice(&9999i32.to_le_bytes());
            bytes[end + 4..end + 8].copy_from_slice(&9999i32.to_le_bytes());
            found += 1;
        }
    }
    assert_eq!(found, 3);
    // Refused before memory for windows of so many pixels is taken.
    let error = decode_image("a.exr", &bytes, ColorMode::Auto).unwrap_err();
    assert!(error.to_string().starts_with("a.exr"), "{error}");
}

/// What is written is read again, whatever the photographs are called.
#[test]
fn names_of_all_kinds_are_written_and_read() {
    let names = names(&["#1.png", "%2.png", "3", "4 5", "\"6\".png", "a\n7.png"]);
    let lights: Vec<Light> = (0..names.len())
        .map(|k| Light::new(Vec3::new(k as f32, 1.0, 2.0), 1.0))
        .collect();
    for (file, bytes) in [
        ("lights.csv", lights_csv(&names, &lights).unwrap()),
        ("lights.lp", lights_lp(&names, &lights).unwrap()),
    ] {
        let read = read_lights(file, &bytes, &names).unwrap();
        for (read, written) in read.iter().zip(&lights) {
            assert!(read.direction.distance(written.direction) < 1e-5);
        }
    }
}

/// Three intensities whose sum overflows were written as `inf`, which is not read again.
#[test]
fn endless_intensities() {
    for (intensity, good) in [("3e38", false), ("inf", false), ("9e29", true)] {
        let text = format!("a.png 0 0 1 {intensity} {intensity} {intensity}\n");
        let names = names(&["a.png"]);
        let read = read_lights("l.txt", text.as_bytes(), &names);
        assert_eq!(read.is_ok(), good, "{intensity}");
        if let Ok(lights) = read {
            let csv = lights_csv(&names, &lights).unwrap();
            assert!(read_lights("lights.csv", &csv, &names).is_ok());
        }
    }
}
