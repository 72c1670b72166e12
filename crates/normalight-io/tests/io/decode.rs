//! Images of every format in, samples out; everything else a typed error with the file's name.
use crate::common::{FORMATS, encode, rgb8, sample};
use image::{DynamicImage, ImageEncoder, ImageFormat, metadata::Orientation};
use normalight_core::{Samples, Transfer};
use normalight_io::{ColorMode, IoError, MAX_PIXELS, decode_image};

fn decode(name: &str, bytes: &[u8]) -> Result<normalight_io::DecodedImage, IoError> {
    decode_image(name, bytes, ColorMode::Auto)
}

#[test]
fn every_format_round_trips() {
    let truth = rgb8(16, 12).into_rgb8().into_raw();
    for (name, format) in FORMATS {
        let decoded = decode(name, &sample(format)).unwrap();
        assert_eq!((decoded.image.width, decoded.image.height), (16, 12));
        assert_eq!(decoded.image.channels, 3);
        assert!(decoded.alpha.is_none());
        let lossy = format == ImageFormat::Jpeg;
        // EXR alone is linear; 8 bits are made for viewing unless something says otherwise.
        let srgb = format != ImageFormat::OpenExr;
        assert_eq!(decoded.image.transfer == Transfer::Srgb, srgb, "{name}");
        match decoded.image.samples {
            Samples::U8(found) => {
                let worst = found.iter().zip(&truth).map(|(a, b)| a.abs_diff(*b)).max();
                assert!(
                    worst.unwrap() <= if lossy { 12 } else { 0 },
                    "{name}: {worst:?}"
                );
            }
            Samples::F32(found) => {
                let close = |(a, b): (&f32, &u8)| (a - f32::from(*b) / 255.0).abs() < 1e-3;
                assert!(found.iter().zip(&truth).all(close), "{name}");
            }
            Samples::U16(_) => panic!("{name}"),
        }
    }
}

#[test]
fn sixteen_bits_float_and_grey_stay() {
    let grey16 = DynamicImage::ImageLuma16(rgb8(9, 5).into_luma16());
    let rgb16 = DynamicImage::ImageRgb16(rgb8(9, 5).into_rgb16());
    for (name, format) in [FORMATS[0], FORMATS[2]] {
        for (image, channels) in [(&grey16, 1), (&rgb16, 3)] {
            let found = decode(name, &encode(image, format)).unwrap().image;
            assert_eq!(found.channels, channels);
            let truth: Vec<u16> = image
                .as_bytes()
                .chunks(2)
                .map(|b| u16::from_ne_bytes([b[0], b[1]]))
                .collect();
            assert_eq!(found.samples, Samples::U16(truth));
        }
    }
    let float = DynamicImage::ImageRgb32F(rgb8(9, 5).into_rgb32f());
    let found = decode("a.tiff", &encode(&float, ImageFormat::Tiff))
        .unwrap()
        .image;
    assert_eq!(found.samples, Samples::F32(float.into_rgb32f().into_raw()));
}

#[test]
fn colour_modes() {
    let png = sample(ImageFormat::Png);
    let exr = sample(ImageFormat::OpenExr);
    let jpeg = sample(ImageFormat::Jpeg);
    let transfer = |name, bytes, mode| decode_image(name, bytes, mode).unwrap().image.transfer;
    assert_eq!(transfer("a.png", &png, ColorMode::Srgb), Transfer::Srgb);
    assert_eq!(transfer("a.exr", &exr, ColorMode::Srgb), Transfer::Linear);
    assert_eq!(
        transfer("a.jpg", &jpeg, ColorMode::Linear),
        Transfer::Linear
    );
}

#[test]
fn alpha_is_kept_aside() {
    for format in [ImageFormat::Png, ImageFormat::Tga, ImageFormat::WebP] {
        let name = FORMATS
            .iter()
            .find(|(_, known)| *known == format)
            .unwrap()
            .0;
        let mut image = rgb8(8, 6).into_rgba8();
        let opaque = encode(&DynamicImage::ImageRgba8(image.clone()), format);
        assert!(decode(name, &opaque).unwrap().alpha.is_none(), "{name}");
        image.get_pixel_mut(2, 1).0[3] = 9;
        let decoded = decode(name, &encode(&DynamicImage::ImageRgba8(image), format)).unwrap();
        let alpha = decoded.alpha.unwrap();
        assert_eq!((alpha.count(), alpha.inside()[8 + 2]), (47, false));
        assert_eq!(
            decoded.image.samples,
            Samples::U8(rgb8(8, 6).into_rgb8().into_raw())
        );
    }
}

#[test]
fn exif_orientation_is_applied() {
    // One EXIF entry: orientation (0x0112) = 6, turn by 90 degrees clockwise.
    let exif = [
        &b"II*\0\x08\0\0\0\x01\0"[..],
        &[0x12, 0x01, 3, 0, 1, 0, 0, 0, 6, 0, 0, 0, 0, 0, 0, 0],
    ]
    .concat();
    assert_eq!(
        Orientation::from_exif_chunk(&exif),
        Some(Orientation::Rotate90)
    );
    let image = rgb8(16, 12).into_rgb8();
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 100);
    encoder.set_exif_metadata(exif).unwrap();
    encoder.encode_image(&image).unwrap();
    let turned = decode("a.jpeg", &bytes).unwrap().image;
    assert_eq!((turned.width, turned.height), (12, 16));
    let Samples::U8(samples) = turned.samples else {
        panic!()
    };
    // The left column, bottom first, is now the upper row; green grows downwards.
    let corner = image.get_pixel(0, 11).0;
    assert!(samples[1].abs_diff(corner[1]) < 12);
    assert!(
        samples[1] > samples[3 * 11 + 1] + 20,
        "the left column is now the upper row"
    );
}

#[test]
fn content_decides_over_the_extension() {
    let png = sample(ImageFormat::Png);
    for name in ["x/a.jpg", "a.TGA", "a.exr"] {
        assert_eq!(
            decode(name, &png).unwrap().image.samples,
            decode("a.png", &png).unwrap().image.samples
        );
    }
    let heic = b"\0\0\0\x18ftypheic\0\0\0\0mif1heic";
    let error = decode("a.jpg", heic).unwrap_err();
    assert!(error.to_string().contains("HEIC") && error.to_string().contains("export"));
    let error = decode("a.png", b"no image at all").unwrap_err();
    assert!(
        matches!(&error, IoError::NotAnImage { name, .. } if name == "a.png"),
        "{error}"
    );
    assert!(matches!(
        decode("a.png", b""),
        Err(IoError::NotAnImage { .. })
    ));
    assert!(matches!(
        decode("notes.txt", &png),
        Err(IoError::NotAnImage { .. })
    ));
    assert!(matches!(
        decode("a.tga", b"no image at all, but long enough"),
        Err(IoError::Decode { .. })
    ));
}

#[test]
fn cut_files_are_named() {
    for (name, format) in FORMATS {
        let whole = sample(format);
        for part in [1, 3, 6, 9] {
            let cut = &whole[..whole.len() * part / 10];
            let error = decode(name, cut).expect_err(name);
            assert!(error.to_string().starts_with(name), "{error}");
        }
    }
}

#[test]
fn huge_sizes_are_refused_from_the_header() {
    // A TGA header alone: 65535 x 65535 pixels, 24 bits, RLE.
    let mut tga = vec![
        0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 24, 0,
    ];
    tga.extend([0x80; 64]);
    let error = decode("big.tga", &tga).unwrap_err();
    assert!(
        matches!(&error, IoError::TooManyPixels { name, width: 65_535, height: 65_535, limit: MAX_PIXELS } if name == "big.tga"),
        "{error}"
    );
    // A PNG whose header promises 20000 x 20000.
    let mut png = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut png);
    let rows = vec![0; 20_000 * 20_000 / 100];
    encoder
        .write_image(&rows, 20_000, 200, image::ExtendedColorType::L8)
        .unwrap();
    png[20..24].copy_from_slice(&20_000u32.to_be_bytes());
    let checksum = crc32(&png[12..29]).to_be_bytes();
    png[29..33].copy_from_slice(&checksum);
    assert!(matches!(
        decode("big.png", &png),
        Err(IoError::TooManyPixels { .. })
    ));
}

/// As above for formats whose size is easily rewritten in a whole file.
#[test]
fn rewritten_sizes_are_refused() {
    let mut bmp = sample(ImageFormat::Bmp);
    bmp[18..22].copy_from_slice(&60_000i32.to_le_bytes());
    bmp[22..26].copy_from_slice(&60_000i32.to_le_bytes());
    let mut jpeg = sample(ImageFormat::Jpeg);
    let frame = jpeg
        .windows(2)
        .position(|mark| mark == [0xFF, 0xC0])
        .unwrap();
    jpeg[frame + 5..frame + 9].fill(0xF0);
    // Lossless WebP: 14 bits of width - 1 and 14 of height - 1 after the mark 0x2F.
    let mut webp = sample(ImageFormat::WebP);
    assert_eq!((&webp[12..16], webp[20]), (&b"VP8L"[..], 0x2F));
    let size = 16_382u32 | 16_382 << 14 | u32::from(webp[24] & 0xF0) << 24;
    webp[21..25].copy_from_slice(&size.to_le_bytes());
    for (name, bytes) in [("a.bmp", bmp), ("a.jpg", jpeg), ("a.webp", webp)] {
        let error = decode(name, &bytes).unwrap_err();
        assert!(
            matches!(&error, IoError::TooManyPixels { name: n, .. } if n == name),
            "{error}"
        );
    }
}

/// The checksum of PNG chunks, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
        })
    })
}
