//! Animations: the first picture counts, and that is said.
use crate::common::file;
use normalight_core::Samples;
use normalight_io::{MaskChoice, Notice, ReadOptions, read_stack};

/// A grey PNG of two pictures.
fn moving_png(first: impl Fn(u32) -> u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 16, 16);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_animated(2, 0).unwrap();
    let mut writer = encoder.write_header().unwrap();
    let picture: Vec<u8> = (0..256).map(&first).collect();
    writer.write_image_data(&picture).unwrap();
    writer.write_image_data(&[1; 256]).unwrap();
    writer.finish().unwrap();
    bytes
}

/// A WebP of one picture with an extended header that says it moves.
fn moving_webp() -> Vec<u8> {
    let still = crate::common::sample(image::ImageFormat::WebP);
    let picture = &still[12..];
    let mut frame = b"ANMF".to_vec();
    frame.extend((16 + picture.len() as u32).to_le_bytes());
    frame.extend([0, 0, 0, 0, 0, 0, 15, 0, 0, 11, 0, 0, 10, 0, 0, 0]);
    frame.extend(picture);
    let mut body = b"WEBPVP8X\x0A\0\0\0\x02\0\0\0\x0F\0\0\x0B\0\0".to_vec();
    body.extend(b"ANIM\x06\0\0\0\0\0\0\0\0\0");
    body.extend(frame);
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((body.len() as u32).to_le_bytes());
    bytes.extend(body);
    bytes
}

#[test]
fn the_first_picture_counts_and_is_told() {
    let shots = (0..3u32).map(|turn| {
        let shade = move |k: u32| (60 + 7 * (k % 16) * turn % 90 + k / 16 * 5) as u8;
        file(&format!("{turn}.png"), moving_png(shade))
    });
    let options = ReadOptions {
        mask: MaskChoice::WholeFrame,
        ..ReadOptions::default()
    };
    let input = read_stack(shots.collect(), &options).unwrap();
    let notice = Notice::Animation {
        file: "1.png".to_owned(),
    };
    assert!(input.plan.notices.contains(&notice), "{}", input.plan);
    let Samples::U8(codes) = &input.stack.images()[0].samples else {
        panic!()
    };
    assert_eq!((codes[0], codes[17]), (60, 65));
}

#[test]
fn moving_webp_gives_its_first_picture() {
    let found = crate::kinds::decode("a.webp", &moving_webp())
        .unwrap()
        .image;
    let still = crate::common::sample(image::ImageFormat::WebP);
    let still = crate::kinds::decode("a.webp", &still).unwrap().image;
    let (Samples::U8(found), Samples::U8(truth)) = (found.samples, still.samples) else {
        panic!()
    };
    // Putting pictures over one another rounds.
    assert!(found.iter().zip(&truth).all(|(a, b)| a.abs_diff(*b) <= 1));
    assert_eq!(found.len(), truth.len());
}
