//! Masks as programs write them.
mod common;

use common::{encode, file, mask_png, shaded_png};
use image::{DynamicImage, GrayImage, ImageFormat, Luma};
use normalight_core::{CoreError, MaskSource};
use normalight_io::{
    IoError, NamedBytes, Notice, ReadOptions, StackInput, decode_mask, read_stack,
};

fn grey_png(width: u32, height: u32, value: impl Fn(u32, u32) -> u8) -> Vec<u8> {
    let image = GrayImage::from_fn(width, height, |x, y| Luma([value(x, y)]));
    encode(&DynamicImage::ImageLuma8(image), ImageFormat::Png)
}

/// A disc in the middle of 20 x 20 pixels.
fn disc(x: u32, y: u32) -> bool {
    (x as i32 - 10).pow(2) + (y as i32 - 10).pow(2) < 36
}

#[test]
fn masks_as_programs_write_them() {
    let truth = decode_mask("m.png", &mask_png(20, 20, disc)).unwrap();
    let two = |low: u8, high: u8| grey_png(20, 20, |x, y| if disc(x, y) { high } else { low });
    for (low, high) in [(0, 255), (0, 1), (3, 200), (0, 90), (200, 255)] {
        assert_eq!(
            decode_mask("m.png", &two(low, high)).unwrap(),
            truth,
            "{low} {high}"
        );
    }
    let labels = grey_png(20, 20, |x, y| u8::from(disc(x, y)) * (1 + u8::from(x > 10)));
    assert_eq!(decode_mask("m.png", &labels).unwrap(), truth);
    assert_eq!(decode_mask("m.png", &two(255, 0)).unwrap(), truth);
    let wide = image::ImageBuffer::from_fn(20, 20, |x, y| Luma([u16::from(disc(x, y))]));
    let wide = encode(&DynamicImage::ImageLuma16(wide), ImageFormat::Png);
    assert_eq!(decode_mask("m.png", &wide).unwrap(), truth);
    let clear = image::RgbaImage::from_fn(20, 20, |x, y| {
        image::Rgba([255, 255, 255, 255 * u8::from(disc(x, y))])
    });
    let clear = encode(&DynamicImage::ImageRgba8(clear), ImageFormat::Png);
    assert_eq!(decode_mask("m.png", &clear).unwrap(), truth);
    // A mask of everything and one of nothing are no two values.
    assert_eq!(
        decode_mask("m.png", &grey_png(9, 9, |_, _| 255))
            .unwrap()
            .count(),
        81
    );
    assert_eq!(
        decode_mask("m.png", &grey_png(9, 9, |_, _| 0))
            .unwrap()
            .count(),
        0
    );
}

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &ReadOptions::default())
}

#[test]
fn what_was_done_with_a_mask_is_said() {
    let mut files: Vec<NamedBytes> = (0..4)
        .map(|turn| file(&format!("{turn}.png"), shaded_png(20, 20, turn)))
        .collect();
    files.push(file(
        "mask.png",
        grey_png(20, 20, |x, y| 255 * u8::from(!disc(x, y))),
    ));
    let input = read(files.clone()).unwrap();
    let inverted = Notice::MaskInverted {
        file: "mask.png".into(),
    };
    assert!(input.plan.notices.contains(&inverted), "{}", input.plan);
    assert_eq!(input.mask_source, MaskSource::File("mask.png".into()));
    files[4].bytes = mask_png(10, 10, |x, _| x > 3);
    let error = read(files).unwrap_err();
    assert!(matches!(error, IoError::Core(CoreError::MaskSize { .. })));
}
