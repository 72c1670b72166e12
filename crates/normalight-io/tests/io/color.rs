//! How stacks that say nothing of their colours are taken.
use crate::common::{encode, file, mask_png};
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma};
use normalight_core::Transfer;
use normalight_io::{
    ColorMode, ColorReason, NamedBytes, Notice, ReadOptions, StackInput, read_stack,
};

const SIDE: u32 = 64;

/// A matt sphere under a lamp, 0 to 1; some grain of albedo, shadows where they belong.
fn light(x: u32, y: u32, lamp: f32) -> f32 {
    let [x, y] = [x, y].map(|v| (v as f32 + 0.5) / SIDE as f32 * 2.2 - 1.1);
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    if z == 0.0 {
        return 0.0;
    }
    let albedo = 0.75 + 0.15 * (7.0 * x).sin() * (5.0 * y).cos();
    let (tilt, turn) = (0.45, lamp * 0.63);
    let [lx, ly, lz] = [
        tilt * turn.cos(),
        tilt * turn.sin(),
        (1.0f32 - tilt * tilt).sqrt(),
    ];
    albedo * (x * lx + y * ly + z * lz).max(0.0)
}

fn stack(encoded: bool, deep: bool, name: impl Fn(usize) -> String) -> Vec<NamedBytes> {
    let curve = if encoded {
        Transfer::Srgb
    } else {
        Transfer::Linear
    };
    let value = |x, y, lamp: usize| curve.encode(light(x, y, lamp as f32));
    let mut files: Vec<NamedBytes> = (0..10)
        .map(|lamp| {
            let picture = match deep {
                true => DynamicImage::ImageLuma16(ImageBuffer::from_fn(SIDE, SIDE, |x, y| {
                    Luma([(value(x, y, lamp) * 65_535.0) as u16])
                })),
                false => DynamicImage::ImageLuma8(ImageBuffer::from_fn(SIDE, SIDE, |x, y| {
                    Luma([(value(x, y, lamp) * 255.0).round() as u8])
                })),
            };
            file(&name(lamp), encode(&picture, ImageFormat::Png))
        })
        .collect();
    files.push(file(
        "mask.png",
        mask_png(SIDE, SIDE, |x, y| light(x, y, 0.0) > 0.0),
    ));
    files
}

fn read(files: Vec<NamedBytes>, color: ColorMode) -> (StackInput, Transfer) {
    let input = read_stack(
        files,
        &ReadOptions {
            color,
            ..ReadOptions::default()
        },
    )
    .unwrap();
    let transfer = input.stack.images()[0].transfer;
    assert!(
        input
            .stack
            .images()
            .iter()
            .all(|image| image.transfer == transfer)
    );
    (input, transfer)
}

fn looks_otherwise(input: &StackInput) -> bool {
    input
        .plan
        .notices
        .iter()
        .any(|notice| matches!(notice, Notice::LooksOtherwise { .. }))
}

#[test]
fn shading_decides_where_8_bits_say_nothing() {
    let names = |lamp| format!("IMG_{lamp}.png");
    for (encoded, expected) in [(false, Transfer::Linear), (true, Transfer::Srgb)] {
        let (input, transfer) = read(stack(encoded, false, names), ColorMode::Auto);
        assert_eq!(transfer, expected, "{}", input.plan);
        assert_eq!(input.plan.color.because, ColorReason::Shading);
        assert!(!looks_otherwise(&input));
        // What is asked counts, but a contradiction is said.
        let (input, transfer) = read(stack(encoded, false, names), ColorMode::Linear);
        assert_eq!(
            (transfer, looks_otherwise(&input)),
            (Transfer::Linear, encoded)
        );
        assert_eq!(input.plan.color.because, ColorReason::Asked);
        let (input, transfer) = read(stack(encoded, false, names), ColorMode::Srgb);
        assert_eq!(
            (transfer, looks_otherwise(&input)),
            (Transfer::Srgb, !encoded)
        );
    }
}

#[test]
fn deep_pngs_are_linear_with_a_word() {
    let names = |lamp| format!("IMG_{lamp}.png");
    let (input, transfer) = read(stack(false, true, names), ColorMode::Auto);
    assert_eq!(
        (transfer, looks_otherwise(&input)),
        (Transfer::Linear, false)
    );
    let unstated = Notice::ColorUnstated {
        taken: "linear".into(),
        sure: None,
    };
    assert!(input.plan.notices.contains(&unstated));
    let (input, transfer) = read(stack(true, true, names), ColorMode::Auto);
    assert_eq!(
        (transfer, looks_otherwise(&input)),
        (Transfer::Linear, true)
    );
}

/// Few photographs tell nothing: such files are usually made for viewing.
#[test]
fn few_photographs_are_taken_as_usual() {
    let mut files = stack(false, false, |lamp| format!("{lamp}.png"));
    files.drain(4..10);
    let (input, transfer) = read(files, ColorMode::Auto);
    assert_eq!(
        (transfer, input.plan.color.because),
        (Transfer::Srgb, ColorReason::Usual)
    );
}

#[test]
fn benchmarks_are_linear_by_their_layout() {
    let mut files = stack(true, false, |lamp| format!("{:03}.png", lamp + 1));
    let names: String = (1..=10).map(|k| format!("{k:03}.png\n")).collect();
    files.push(file("filenames.txt", names.into_bytes()));
    files.push(file("light_directions.txt", b"0 0 1\n".repeat(10)));
    let (input, transfer) = read(files, ColorMode::Auto);
    assert_eq!(
        (transfer, input.plan.color.because),
        (Transfer::Linear, ColorReason::Benchmark)
    );
    // A list with the lights beside the names, as published sets have it.
    let mut files = stack(true, false, |lamp| format!("{lamp}.png"));
    let list: String = (0..10).map(|k| format!("{k}.png 0 0 1 1 1 1\n")).collect();
    files.push(file("vase_lights.txt", list.into_bytes()));
    let (input, transfer) = read(files, ColorMode::Auto);
    assert_eq!(
        (transfer, input.plan.color.because),
        (Transfer::Linear, ColorReason::Benchmark)
    );
}
