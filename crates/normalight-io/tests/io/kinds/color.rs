//! What files say about their samples.
use crate::common::values;
use crate::kinds::decode;
use image::ImageEncoder;
use normalight_core::{Samples, Transfer};

/// A grey PNG with chunks.
fn png_with(set: impl Fn(&mut png::Encoder<&mut Vec<u8>>)) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 4, 4);
    encoder.set_color(png::ColorType::Grayscale);
    set(&mut encoder);
    let mut writer = encoder.write_header().unwrap();
    writer
        .write_image_data(&(0..16).map(|k| 16 * k).collect::<Vec<u8>>())
        .unwrap();
    writer.finish().unwrap();
    bytes
}

#[test]
fn png_says_its_gamma() {
    let transfer = |bytes: &[u8]| decode("a.png", bytes).unwrap().image.transfer;
    let gamma = |value| png_with(|encoder| encoder.set_source_gamma(png::ScaledFloat::new(value)));
    assert_eq!(transfer(&gamma(1.0)), Transfer::Linear);
    assert_eq!(transfer(&gamma(0.45455)), Transfer::Srgb);
    let srgb = png_with(|encoder| encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual));
    assert_eq!(transfer(&srgb), Transfer::Srgb);
    let power = decode("a.png", &gamma(0.55556)).unwrap().image;
    assert_eq!(power.transfer, Transfer::Linear);
    let values = values(&power.samples);
    assert!((values[8] - (128.0f32 / 255.0).powf(1.8)).abs() < 1e-4);
}

#[test]
fn profiles_are_honoured() {
    // A neutral grey stays neutral in any primaries, so its light is the curve alone.
    let mut picture = image::RgbImage::new(4, 4);
    picture
        .pixels_mut()
        .enumerate()
        .for_each(|(k, pixel)| pixel.0 = [17 * k as u8; 3]);
    let tagged = |profile: moxcms::ColorProfile| {
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::png::PngEncoder::new(&mut bytes);
        encoder.set_icc_profile(profile.encode().unwrap()).unwrap();
        encoder
            .write_image(&picture, 4, 4, image::ExtendedColorType::Rgb8)
            .unwrap();
        decode("a.png", &bytes).unwrap().image
    };
    for (profile, power) in [
        (moxcms::ColorProfile::new_adobe_rgb(), 2.199_218_8),
        (moxcms::ColorProfile::new_pro_photo_rgb(), 1.8),
    ] {
        let found = tagged(profile);
        assert_eq!(found.transfer, Transfer::Linear);
        for (k, pixel) in values(&found.samples).chunks(3).enumerate() {
            let light = (17.0 * k as f32 / 255.0).powf(power);
            assert!(
                pixel.iter().all(|value| (value - light).abs() < 0.004),
                "{k} {pixel:?} {light}"
            );
        }
    }
    let srgb = tagged(moxcms::ColorProfile::new_srgb());
    assert_eq!(
        (srgb.transfer, srgb.samples),
        (Transfer::Srgb, Samples::U8(picture.as_raw().clone()))
    );
}
