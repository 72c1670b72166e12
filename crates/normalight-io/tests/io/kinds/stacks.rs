//! What only several photographs show: agreement, repetition, values beyond all numbers.
use crate::common::{encode, file, rgb8, shaded_png, three};
use image::{DynamicImage, ImageEncoder, ImageFormat};
use normalight_io::{IoError, MaskChoice, NamedBytes, Notice, ReadOptions, StackInput, read_stack};

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
