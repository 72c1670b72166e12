//! Kinds of images that programs write, made here byte by byte.
mod common;

use common::{encode, file, rgb8, shaded_png, three, values};
use image::{DynamicImage, ImageEncoder, ImageFormat};
use normalight_core::{Samples, Transfer};
use normalight_io::{
    ColorMode, IoError, MaskChoice, NamedBytes, Notice, ReadOptions, StackInput, decode_image,
    read_stack,
};

/// A TIFF of one uncompressed strip: `tags` are (tag, type, values), sorted, without the strip's own.
fn tiff(width: u32, height: u32, tags: &[(u16, u16, Vec<u32>)], data: &[u8]) -> Vec<u8> {
    let mut all = vec![(256, 4, vec![width]), (257, 4, vec![height])];
    all.extend_from_slice(tags);
    all.extend([
        (273, 4, vec![8]),
        (278, 4, vec![height]),
        (279, 4, vec![data.len() as u32]),
    ]);
    all.sort();
    let mut bytes = b"II*\0".to_vec();
    let directory = 8 + data.len().next_multiple_of(2);
    bytes.extend((directory as u32).to_le_bytes());
    bytes.extend(data);
    bytes.resize(directory, 0);
    let mut far = directory + 2 + 12 * all.len() + 4;
    let mut heap = Vec::new();
    bytes.extend((all.len() as u16).to_le_bytes());
    for (tag, kind, values) in &all {
        let stored: Vec<u8> = match kind {
            3 => values
                .iter()
                .flat_map(|&v| (v as u16).to_le_bytes())
                .collect(),
            _ => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        };
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend((values.len() as u32).to_le_bytes());
        if stored.len() <= 4 {
            let mut short = stored.clone();
            short.resize(4, 0);
            bytes.extend(short);
        } else {
            bytes.extend((far as u32).to_le_bytes());
            far += stored.len();
            heap.extend(stored);
        }
    }
    bytes.extend([0; 4]);
    bytes.extend(heap);
    bytes
}

fn short(tag: u16, value: u32) -> (u16, u16, Vec<u32>) {
    (tag, 3, vec![value])
}

fn bits(count: usize, bits: u32) -> (u16, u16, Vec<u32>) {
    (258, 3, vec![bits; count])
}

fn decode(name: &str, bytes: &[u8]) -> Result<normalight_io::DecodedImage, IoError> {
    decode_image(name, bytes, ColorMode::Auto)
}

#[test]
fn tiffs_of_scientists() {
    let values: Vec<f32> = (0..20).map(|k| k as f32 * 0.5).collect();
    let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let grey = [bits(1, 32), short(262, 1), short(339, 3)];
    let found = decode("a.tif", &tiff(5, 4, &grey, &data)).unwrap().image;
    assert_eq!(
        (found.channels, found.samples),
        (1, Samples::F32(values.clone()))
    );
    let halves: Vec<u8> = [0x0000u16, 0x3800, 0x3C00, 0x4000]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let grey = [bits(1, 16), short(262, 1), short(339, 3)];
    let found = decode("a.tif", &tiff(2, 2, &grey, &halves)).unwrap().image;
    assert_eq!(found.samples, Samples::F32(vec![0.0, 0.5, 1.0, 2.0]));

    let tags = [bits(2, 8), short(262, 1), short(277, 2), short(338, 2)];
    let found = decode("a.tif", &tiff(2, 2, &tags, &[9, 255, 8, 255, 7, 0, 6, 255])).unwrap();
    assert_eq!(found.image.samples, Samples::U8(vec![9, 8, 7, 6]));
    assert_eq!(found.alpha.unwrap().inside(), [true, true, false, true]);

    let mut map = vec![0u32; 768];
    for (index, color) in [(3, [65_535, 257 * 2, 0]), (7, [0, 257 * 9, 257 * 100])] {
        for channel in 0..3 {
            map[256 * channel + index] = color[channel];
        }
    }
    let tags = [bits(1, 8), short(262, 3), (320, 3, map)];
    let found = decode("a.tif", &tiff(2, 1, &tags, &[3, 7])).unwrap().image;
    assert_eq!(found.samples, Samples::U8(vec![255, 2, 0, 0, 9, 100]));

    // Luma and chroma of pure red, as JFIF defines them.
    let tags = [
        bits(3, 8),
        short(262, 6),
        short(277, 3),
        (530, 3, vec![1, 1]),
    ];
    let found = decode("a.tif", &tiff(2, 1, &tags, &[76, 85, 255, 128, 128, 128]))
        .unwrap()
        .image;
    let Samples::U8(codes) = found.samples else {
        panic!()
    };
    let expected = [254u8, 0, 0, 128, 128, 128];
    assert!(
        codes.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 1),
        "{codes:?}"
    );
}

/// What cannot be read right is refused in words, never read wrong.
#[test]
fn tiffs_that_are_refused() {
    let cmyk = tiff(2, 1, &[bits(4, 8), short(262, 5), short(277, 4)], &[0; 8]);
    let extra = tiff(
        2,
        1,
        &[
            bits(4, 8),
            short(262, 2),
            short(277, 4),
            short(317, 2),
            short(338, 0),
        ],
        &[5; 8],
    );
    let five = tiff(2, 1, &[bits(5, 8), short(262, 1), short(277, 5)], &[5; 10]);
    let dng = tiff(
        2,
        1,
        &[bits(1, 8), short(262, 1), (50_706, 1, vec![1])],
        &[5; 2],
    );
    for (bytes, words) in [
        (cmyk, "CMYK"),
        (extra, "extra channels"),
        (five, "5 channels"),
        (dng, "RAW"),
    ] {
        let error = decode("a.tif", &bytes).unwrap_err().to_string();
        assert!(
            error.starts_with("a.tif:") && error.contains(words) && error.contains("export"),
            "{error}"
        );
    }
}

#[test]
fn float_maps_and_grey_maps() {
    let pgm = decode("a.pgm", b"P5\n# Yale\n3 2\n255\n\x01\x02\x03\x04\x05\x06")
        .unwrap()
        .image;
    assert_eq!(
        (pgm.width, pgm.channels, pgm.samples),
        (3, 1, Samples::U8(vec![1, 2, 3, 4, 5, 6]))
    );
    // Rows from the bottom, little-endian by the sign.
    let values = [1.0f32, 2.0, 3.0, 4.0];
    let little: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let big: Vec<u8> = values.iter().flat_map(|v| v.to_be_bytes()).collect();
    for (scale, data) in [("-1.0", &little), ("1.0", &big)] {
        let bytes = [format!("Pf\n2 2\n{scale}\n").as_bytes(), data].concat();
        let found = decode("a.pfm", &bytes).unwrap().image;
        let Samples::F32(found) = found.samples else {
            panic!()
        };
        assert_eq!(
            found.iter().step_by(3).copied().collect::<Vec<_>>(),
            [3.0, 4.0, 1.0, 2.0]
        );
        for cut in 0..bytes.len() {
            assert!(decode("a.pfm", &bytes[..cut]).is_err());
        }
    }
    assert!(decode("a.pfm", b"Pf\n99999999 99999999\n-1\n").is_err());
    assert!(decode("a.pfm", b"PF\n1000000 100\n-1\n").is_err());
}

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

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &ReadOptions::default())
}

/// JPEG with an EXIF orientation.
fn turned_jpeg(turn: u32, orientation: u8) -> Vec<u8> {
    let exif = [
        &b"II*\0\x08\0\0\0\x01\0"[..],
        &[
            0x12,
            0x01,
            3,
            0,
            1,
            0,
            0,
            0,
            orientation,
            0,
            0,
            0,
            0,
            0,
            0,
            0,
        ],
    ]
    .concat();
    let picture = image::load_from_memory(&shaded_png(16, 12, turn))
        .unwrap()
        .into_rgb8();
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 95);
    encoder.set_exif_metadata(exif).unwrap();
    encoder.encode_image(&picture).unwrap();
    bytes
}

#[test]
fn one_orientation_for_a_stack() {
    let shots = |orientations: [u8; 4]| {
        let files = orientations.iter().enumerate().map(|(turn, &orientation)| {
            file(
                &format!("{turn}.jpg"),
                turned_jpeg(turn as u32, orientation),
            )
        });
        read(files.collect()).unwrap()
    };
    let agreed = shots([6; 4]);
    assert_eq!((agreed.stack.width(), agreed.stack.height()), (12, 16));
    let torn = shots([1, 6, 1, 8]);
    assert_eq!((torn.stack.width(), torn.stack.height()), (16, 12));
    let files = vec!["1.jpg".to_owned(), "3.jpg".to_owned()];
    assert!(
        torn.plan.notices.contains(&Notice::Orientations { files }),
        "{}",
        torn.plan
    );
}

#[test]
fn the_same_picture_again_and_again_is_refused() {
    let bytes = encode(&rgb8(16, 12), ImageFormat::Png);
    let same = ["1.png", "2.png", "3.png"].map(|name| file(name, bytes.clone()));
    let error = read(same.to_vec()).unwrap_err();
    assert!(
        matches!(&error, IoError::AllIdentical { first } if first == "1.png"),
        "{error}"
    );
    let mut files = three(16, 12);
    files.push(file("11.png", files[2].bytes.clone()));
    let input = read(files).unwrap();
    let notice = Notice::NearlyIdentical {
        files: vec!["11.png".into()],
    };
    assert!(input.plan.notices.contains(&notice), "{}", input.plan);
}

#[test]
fn infinite_light_is_the_brightest() {
    let exr = |turn: u32, infinite: bool| {
        let picture = image::load_from_memory(&shaded_png(16, 12, turn))
            .unwrap()
            .into_rgb32f();
        let mut picture = picture;
        if infinite {
            picture.get_pixel_mut(3, 3).0[1] = f32::INFINITY;
        }
        encode(&DynamicImage::ImageRgb32F(picture), ImageFormat::OpenExr)
    };
    let files = (0..3).map(|turn| file(&format!("{turn}.exr"), exr(turn, turn == 1)));
    let options = ReadOptions {
        mask: MaskChoice::WholeFrame,
        ..ReadOptions::default()
    };
    let input = read_stack(files.collect(), &options).unwrap();
    let notice = Notice::Infinite {
        file: "1.exr".into(),
        samples: 1,
    };
    assert!(input.plan.notices.contains(&notice), "{}", input.plan);
}
