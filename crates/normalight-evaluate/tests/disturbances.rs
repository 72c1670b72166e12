//! Disturbed photographs against what their definition says.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use normalight_core::{
    ImageStack, Light, Mask, NormalMap, Rect, Samples, StackImage, Transfer, Vec3,
};
use normalight_evaluate::{BenchmarkObject, Disturbance, EvaluateError};

const SIDE: usize = 20;

/// Three photographs of a square of 10 x 10 pixels with a gradient, in grey.
fn object() -> BenchmarkObject {
    let inside = |pixel: usize| {
        let (x, y) = (pixel % SIDE, pixel / SIDE);
        (5..15).contains(&x) && (5..15).contains(&y)
    };
    let image = |bright: f32| StackImage {
        name: format!("{bright}.png"),
        width: SIDE,
        height: SIDE,
        channels: 1,
        samples: Samples::F32(
            (0..SIDE * SIDE)
                .map(|pixel| bright * (1 + pixel) as f32 / 400.0)
                .collect(),
        ),
        transfer: Transfer::Linear,
    };
    BenchmarkObject {
        name: "square".to_owned(),
        stack: ImageStack::new([0.2, 0.4, 0.6].map(image).into()).unwrap(),
        mask: Mask::new(SIDE, SIDE, (0..SIDE * SIDE).map(inside).collect()),
        lights: Some(vec![Light::new(Vec3::Z, 1.0); 3]),
        normals: Some(NormalMap::new(SIDE, SIDE, vec![Vec3::Z; SIDE * SIDE])),
    }
}

fn done(text: &str) -> BenchmarkObject {
    text.parse::<Disturbance>()
        .unwrap()
        .apply(&object())
        .unwrap()
}

/// Red of each pixel of a photograph.
fn red(object: &BenchmarkObject, image: usize) -> Vec<f32> {
    let mut planes = vec![0.0; 3 * SIDE * SIDE];
    object
        .stack
        .linear_tile(image, Rect::whole(SIDE, SIDE), &mut planes);
    planes.truncate(SIDE * SIDE);
    planes
}

fn apart(one: &[f32], other: &[f32]) -> f32 {
    one.iter()
        .zip(other)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max)
}

#[test]
fn masks_move_by_pixels() {
    for (text, side) in [("grown:2", 14), ("shrunk:3", 4), ("grown:50", SIDE)] {
        assert_eq!(done(text).mask.count(), side * side, "{text}");
    }
    let gone = "shrunk:5".parse::<Disturbance>().unwrap().apply(&object());
    assert!(matches!(gone, Err(EvaluateError::Core(_))));
}

#[test]
fn room_light_is_a_share_of_the_mean() {
    let (before, after) = (object(), done("ambient:0.5"));
    let expected: Vec<f32> = (0..SIDE * SIDE)
        .map(|at| red(&before, 0)[at] + 0.5 * red(&before, 1)[at])
        .collect();
    // The second photograph is the mean of the three.
    assert!(apart(&red(&after, 0), &expected) < 1e-6);
}

#[test]
fn a_share_of_the_samples_is_clipped() {
    let object = done("clipped:0.1");
    let inside = object.mask.pixels();
    let clipped = (0..3)
        .map(|image| {
            let red = red(&object, image);
            inside.iter().filter(|&&pixel| red[pixel] >= 1.0).count()
        })
        .sum::<usize>();
    assert!((28..=32).contains(&clipped), "{clipped} of 300");
}

#[test]
fn encoded_values_are_taken_as_light() {
    let (before, after) = (red(&object(), 2), red(&done("encoded"), 2));
    let brightest = before[14 * SIDE + 14];
    let pixel = 7 * SIDE + 9;
    // The curve of sRGB, IEC 61966-2-1, away from its straight beginning.
    let expected = 1.055 * (before[pixel] / brightest).powf(1.0 / 2.4) - 0.055;
    assert!((after[pixel] - expected).abs() < 1e-3);
}

#[test]
fn jpeg_loses_more_at_lower_quality() {
    let before = red(&object(), 1);
    let [good, bad] = ["jpeg:100", "jpeg:5"].map(|text| apart(&red(&done(text), 1), &before));
    assert!(good < 0.01 && bad > 2.0 * good, "{good} {bad}");
}

#[test]
fn written_as_read() {
    for text in [
        "jpeg:75",
        "ambient:0.25",
        "clipped:0.02",
        "encoded",
        "grown:3",
        "shrunk:2",
    ] {
        let disturbance: Disturbance = text.parse().unwrap();
        assert_eq!(disturbance.to_string(), text);
        let json = serde_json::to_string(&disturbance).unwrap();
        assert_eq!(
            serde_json::from_str::<Disturbance>(&json).unwrap(),
            disturbance
        );
    }
    for wrong in [
        "jpeg",
        "jpeg:0",
        "jpeg:101",
        "ambient:0",
        "ambient:x",
        "clipped:1",
        "encoded:2",
        "grown:-1",
        "",
    ] {
        assert!(wrong.parse::<Disturbance>().is_err(), "{wrong}");
    }
}
