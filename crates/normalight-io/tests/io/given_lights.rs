//! Lights that were given against the photographs.
use crate::common::{encode, file};
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma};
use normalight_core::{Light, Vec3};
use normalight_io::{LightAxes, NamedBytes, Notice, ReadOptions, StackInput, read_stack};

const SIDE: u32 = 96;

fn directions() -> Vec<Vec3> {
    let of = |k: u32| {
        let (turn, tilt) = (k as f32 * 2.4, [0.4, 0.8][k as usize % 2]);
        Vec3::new(turn.cos() * tilt, turn.sin() * tilt, 1.0).normalize()
    };
    (0..8).map(of).collect()
}

fn brightness(k: usize) -> f32 {
    [0.9, 0.5, 0.7, 0.6][k % 4]
}

/// A matte ball of 16 bits under lamps of different brightness, with its mask.
fn ball() -> StackInput {
    let normal = |x: u32, y: u32| {
        let (x, y) = ((x as f32 - 47.5) / 40.0, (47.5 - y as f32) / 40.0);
        let z = 1.0 - x * x - y * y;
        (z > 0.0).then(|| Vec3::new(x, y, z.sqrt()))
    };
    let png = |value: &dyn Fn(Vec3) -> f32| {
        let image = ImageBuffer::from_fn(SIDE, SIDE, |x, y| {
            Luma([normal(x, y).map_or(0, |n| (65_535.0 * value(n)) as u16)])
        });
        encode(&DynamicImage::ImageLuma16(image), ImageFormat::Png)
    };
    let mut files: Vec<NamedBytes> = directions()
        .into_iter()
        .enumerate()
        .map(|(k, light)| {
            let shade = |n: Vec3| brightness(k) * n.dot(light).max(0.0);
            file(&format!("{k}.png"), png(&shade))
        })
        .collect();
    files.push(file("mask.png", png(&|_| 1.0)));
    read_stack(files, &ReadOptions::default()).unwrap()
}

/// What is made of directions, changed, in a file without intensities.
fn given(change: impl Fn(Vec3) -> Vec3, order: &[usize]) -> (Vec<Light>, Vec<Notice>) {
    let mut input = ball();
    let lights = directions();
    let lines = order.iter().map(|&k| {
        let [x, y, z] = change(lights[k]).to_array();
        format!("{x} {y} {z}\n")
    });
    let text: String = lines.collect();
    let given = input
        .given_lights("lights.txt", text.as_bytes(), LightAxes::default())
        .unwrap();
    let before = input.plan.notices.len();
    let lights = input.accept_lights("lights.txt", given);
    (lights, input.plan.notices.split_off(before))
}

const ORDER: [usize; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

#[test]
fn brightness_is_found_where_the_file_is_silent() {
    let (lights, notices) = given(|light| light, &ORDER);
    assert_eq!(
        notices,
        [Notice::LightsWithoutIntensity {
            file: "lights.txt".into(),
            found: true
        }]
    );
    let mean = (0..8).map(brightness).sum::<f32>() / 8.0;
    for (k, light) in lights.iter().enumerate() {
        let found = light.mean_intensity() * mean;
        assert!((found / brightness(k) - 1.0).abs() < 0.03, "{k}: {found}");
    }
}

#[test]
fn other_axes_are_recognised_and_named() {
    let contradiction = |notices: &[Notice]| {
        notices.iter().find_map(|notice| match notice {
            Notice::LightsContradict { axes, .. } => Some(axes.clone()),
            _ => None,
        })
    };
    let down = |light: Vec3| Vec3::new(light.x, -light.y, light.z);
    let (_, notices) = given(down, &ORDER);
    let axes = contradiction(&notices);
    assert_eq!(axes, Some(Some("x-right,y-down,z-out".to_owned())));
    let (_, notices) = given(|light| light, &[5, 0, 7, 2, 6, 1, 3, 4]);
    assert_eq!(contradiction(&notices), Some(None), "{notices:?}");
}
