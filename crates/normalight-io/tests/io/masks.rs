//! Masks as programs write them.
use crate::common::{encode, file, mask_png, shaded_png};
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

#[test]
fn one_value_is_all_or_nothing() {
    for (value, count) in [(255, 81), (128, 81), (1, 81), (0, 0)] {
        let mask = decode_mask("m.png", &grey_png(9, 9, |_, _| value)).unwrap();
        assert_eq!(mask.count(), count, "{value}");
    }
}

/// A PNG of 1 bit a pixel; `colours` is its palette.
fn one_bit_png(colours: Option<[[u8; 3]; 2]>, inside: impl Fn(u32, u32) -> bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 20, 20);
    encoder.set_depth(png::BitDepth::One);
    encoder.set_color(png::ColorType::Grayscale);
    if let Some(colours) = colours {
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(colours.as_flattened().to_vec());
    }
    let mut rows = vec![0u8; 20 * 3];
    for (x, y) in (0..400).map(|pixel| (pixel % 20, pixel / 20)) {
        rows[(3 * y + x / 8) as usize] |= u8::from(inside(x, y)) << (7 - x % 8);
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&rows).unwrap();
    writer.finish().unwrap();
    bytes
}

/// A TIFF of 1 bit a pixel, white as `photometric` says: 0 where it is 0, 1 where it is 1.
fn one_bit_tiff(photometric: u16, inside: impl Fn(u32, u32) -> bool) -> Vec<u8> {
    let mut data = vec![0u8; 20 * 3];
    for (x, y) in (0..400).map(|pixel| (pixel % 20, pixel / 20)) {
        let bit = u8::from(inside(x, y) == (photometric == 1));
        data[(3 * y + x / 8) as usize] |= bit << (7 - x % 8);
    }
    let mut bytes = b"II*\0".to_vec();
    bytes.extend((8 + data.len() as u32).to_le_bytes());
    bytes.extend(&data);
    let entries: [(u16, u32); 9] = [
        (256, 20),
        (257, 20),
        (258, 1),
        (259, 1),
        (262, photometric.into()),
        (273, 8),
        (277, 1),
        (278, 20),
        (279, data.len() as u32),
    ];
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, value) in entries {
        bytes.extend(tag.to_le_bytes());
        bytes.extend([4, 0, 1, 0, 0, 0]);
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes
}

#[test]
fn one_bit_in_both_polarities_and_palettes() {
    let truth = decode_mask("m.png", &mask_png(20, 20, disc)).unwrap();
    let outside = |x, y| !disc(x, y);
    assert_eq!(
        decode_mask("m.png", &one_bit_png(None, disc)).unwrap(),
        truth
    );
    assert_eq!(
        decode_mask("m.png", &one_bit_png(None, outside)).unwrap(),
        truth
    );
    for photometric in [0, 1] {
        let bytes = one_bit_tiff(photometric, disc);
        assert_eq!(
            decode_mask("m.tif", &bytes).unwrap(),
            truth,
            "{photometric}"
        );
    }
    // Blue is darker than red to the eye; which of them is the object only the border tells.
    let (red, blue) = ([255, 0, 0], [0, 0, 255]);
    for colours in [[red, blue], [blue, red], [[0; 3], blue], [[255; 3], red]] {
        let bytes = one_bit_png(Some(colours), disc);
        assert_eq!(decode_mask("m.png", &bytes).unwrap(), truth, "{colours:?}");
    }
}

#[test]
fn labels_of_parts_are_the_object() {
    let truth = decode_mask("m.png", &mask_png(20, 20, disc)).unwrap();
    // Three parts beside a black background, one of them dark.
    let parts = |values: [[u8; 3]; 3]| {
        let image = image::RgbImage::from_fn(20, 20, |x, y| {
            image::Rgb(match (disc(x, y), x) {
                (false, _) => [0; 3],
                (_, ..8) => values[0],
                (_, 8..12) => values[1],
                _ => values[2],
            })
        });
        encode(&DynamicImage::ImageRgb8(image), ImageFormat::Png)
    };
    for values in [
        [[60; 3], [160; 3], [250; 3]],
        [[0, 0, 128], [128, 0, 0], [0, 128, 0]],
    ] {
        let found = decode_mask("m.png", &parts(values)).unwrap();
        assert_eq!(found, truth, "{values:?}");
    }
}

/// The disc with soft edges: the covered part of each pixel, of 8 x 8 points.
fn coverage(x: u32, y: u32) -> f32 {
    let inside = (0..64).filter(|k| {
        let at = |place: u32, part: u32| place as f32 + (part as f32 + 0.5) / 8.0 - 10.5;
        at(x, k % 8).powi(2) + at(y, k / 8).powi(2) < 36.0
    });
    inside.count() as f32 / 64.0
}

#[test]
fn soft_edges_noise_and_small_values() {
    let hard = |x, y| coverage(x, y) >= 0.5;
    let truth = decode_mask("m.png", &mask_png(20, 20, hard)).unwrap();
    let soft = grey_png(20, 20, |x, y| (255.0 * coverage(x, y)).round() as u8);
    assert_eq!(decode_mask("m.png", &soft).unwrap(), truth);
    let wide = image::ImageBuffer::from_fn(20, 20, |x, y| Luma([3 * u16::from(hard(x, y))]));
    let wide = encode(&DynamicImage::ImageLuma16(wide), ImageFormat::Png);
    assert_eq!(decode_mask("m.png", &wide).unwrap(), truth);
    // JPEG rings at edges: few pixels there may differ, none elsewhere.
    for (low, high) in [(0, 255), (90, 160)] {
        let image = GrayImage::from_fn(200, 200, |x, y| {
            Luma([if disc(x / 10, y / 10) { high } else { low }])
        });
        let bytes = encode(&DynamicImage::ImageLuma8(image), ImageFormat::Jpeg);
        let found = decode_mask("m.jpg", &bytes).unwrap();
        let expected = mask_png(200, 200, |x, y| disc(x / 10, y / 10));
        let expected = decode_mask("m.png", &expected).unwrap();
        let pairs = found.inside().iter().zip(expected.inside());
        assert!(pairs.filter(|(a, b)| a != b).count() < 40, "{low} {high}");
    }
}

#[test]
fn a_picture_that_is_cut_out_is_its_transparency() {
    let truth = decode_mask("m.png", &mask_png(20, 20, disc)).unwrap();
    let picture = image::RgbaImage::from_fn(20, 20, |x, y| match disc(x, y) {
        true => image::Rgba([12 * x as u8, 12 * y as u8, 90, 255]),
        false => image::Rgba([0; 4]),
    });
    let bytes = encode(&DynamicImage::ImageRgba8(picture), ImageFormat::Png);
    assert_eq!(decode_mask("m.png", &bytes).unwrap(), truth);
    // A mask in the colours counts where some program left a corner transparent.
    let corner = image::RgbaImage::from_fn(20, 20, |x, y| {
        let value = 255 * u8::from(disc(x, y));
        image::Rgba([value, value, value, if x + y == 0 { 0 } else { 255 }])
    });
    let bytes = encode(&DynamicImage::ImageRgba8(corner), ImageFormat::Png);
    assert_eq!(decode_mask("m.png", &bytes).unwrap(), truth);
}

#[test]
fn inverted_masks_of_objects_that_cross_the_border() {
    // The object reaches the lower border; black is the object in the second.
    let bust = |x: u32, y: u32| disc(x, y) || (y >= 10 && (4..16).contains(&x));
    let plain = decode_mask("m.png", &mask_png(20, 20, bust)).unwrap();
    let inverted = decode_mask("m.png", &mask_png(20, 20, |x, y| !bust(x, y))).unwrap();
    assert_eq!(
        plain.count(),
        (0..400).filter(|p| bust(p % 20, p / 20)).count()
    );
    assert_eq!(inverted, plain);
    // A plate that fills most of the frame and has a hole is not inverted.
    let plate = |x: u32, y: u32| !((15..18).contains(&x) && (15..18).contains(&y));
    let found = decode_mask("m.png", &mask_png(40, 40, plate)).unwrap();
    assert_eq!(found.count(), 40 * 40 - 9);
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
    files[4].bytes = mask_png(10, 9, |x, _| x > 3);
    let error = read(files).unwrap_err();
    assert!(matches!(error, IoError::Core(CoreError::MaskSize { .. })));
    let said = error.to_string();
    assert!(said.contains("10x9") && said.contains("20x20"), "{said}");
}

fn shaded(width: u32, height: u32, mask: Vec<u8>) -> Vec<NamedBytes> {
    let mut files: Vec<NamedBytes> = (0..4)
        .map(|turn| file(&format!("{turn}.png"), shaded_png(width, height, turn)))
        .collect();
    files.push(file("mask.png", mask));
    files
}

#[test]
fn masks_of_another_scale_are_scaled_and_that_is_said() {
    let notice = |from| Notice::MaskScaled {
        file: "mask.png".into(),
        from,
        to: [30, 20],
    };
    // A third and rounded, twice as large, and half and rounded up.
    for (width, height) in [(10, 7), (60, 40), (16, 11)] {
        let mask = mask_png(width, height, |x, _| 2 * x >= width);
        let input = read(shaded(30, 20, mask)).unwrap();
        let size = [width as usize, height as usize];
        assert!(input.plan.notices.contains(&notice(size)), "{}", input.plan);
        let row: Vec<bool> = (0..30).map(|x| x >= 15).collect();
        for found in input.mask.inside().chunks_exact(30) {
            assert_eq!(found, row, "{width}x{height}");
        }
    }
    let error = read(shaded(30, 20, mask_png(20, 30, |x, _| x > 5))).unwrap_err();
    let said = error.to_string();
    assert!(said.contains("20x30") && said.contains("30x20"), "{said}");
}

#[test]
fn doubtful_masks_are_said() {
    let notices = |mask| read(shaded(20, 20, mask)).unwrap().plan.notices;
    let name = || "mask.png".to_owned();
    let full = notices(grey_png(20, 20, |_, _| 255));
    assert!(full.contains(&Notice::MaskFull { file: name() }));
    let labels = notices(grey_png(20, 20, |x, y| match (disc(x, y), x) {
        (false, _) => 0,
        (_, ..10) => 1,
        _ => 2,
    }));
    assert!(labels.contains(&Notice::MaskLabels {
        file: name(),
        parts: 2
    }));
    let ramp = notices(grey_png(20, 20, |x, y| 8 * x as u8 + (y as u8 % 7)));
    let soft = |notice: &Notice| matches!(notice, Notice::MaskSoft { share, .. } if *share > 0.4);
    assert!(ramp.iter().any(soft));
    // A good mask is not talked about.
    let good = notices(mask_png(20, 20, disc));
    assert!(
        !good
            .iter()
            .any(|notice| notice.to_string().starts_with("mask.png"))
    );
    let error = read(shaded(20, 20, grey_png(20, 20, |_, _| 0))).unwrap_err();
    assert!(matches!(error, IoError::Core(CoreError::EmptyMask { .. })));
}

#[test]
fn a_frame_without_a_mask_is_said_to_be_whole() {
    let mut files = shaded(20, 20, Vec::new());
    files.pop();
    let input = read(files).unwrap();
    assert_eq!(input.mask_source, MaskSource::Guessed);
    assert!(
        input.plan.notices.contains(&Notice::MaskGuessedWhole),
        "{}",
        input.plan
    );
    assert_eq!(input.mask.count(), 400);
}
