use super::*;
use crate::{Samples, StackImage, Transfer, Vec3};

const SIDE: usize = 60;

/// A ball on black, of patches, under a lamp and the light of the room.
fn ball(lamp: Vec3, lamp_light: f32, room: f32, transfer: Transfer) -> StackImage {
    let value = |pixel: usize| {
        let x = (pixel % SIDE) as f32 / 30.0 - 1.0;
        let y = 1.0 - (pixel / SIDE) as f32 / 30.0;
        let z = 1.0 - x * x - y * y;
        if z <= 0.0 {
            return 0.0;
        }
        let normal = Vec3::new(x, y, z.sqrt());
        let albedo = 0.5 + 0.2 * (9.0 * x).sin() * (7.0 * y).cos();
        albedo * (lamp_light * normal.dot(lamp).max(0.0) + room * (0.7 + 0.3 * normal.y))
    };
    let code = |pixel: usize| (transfer.encode(value(pixel).min(1.0)) * 65_535.0).round() as u16;
    StackImage {
        name: String::new(),
        width: SIDE,
        height: SIDE,
        channels: 1,
        samples: Samples::U16((0..SIDE * SIDE).map(code).collect()),
        transfer,
    }
}

fn lamp(index: usize) -> Vec3 {
    let turn = 2.4 * index as f32;
    Vec3::new(0.7 * turn.cos(), 0.7 * turn.sin(), 0.7).normalize()
}

fn lit(images: Vec<StackImage>) -> ShotLight {
    let disc = (0..SIDE * SIDE).map(|pixel| {
        let (x, y) = ((pixel % SIDE) as f32 - 30.0, (pixel / SIDE) as f32 - 30.0);
        x.hypot(y) < 28.0
    });
    let mask = Mask::new(SIDE, SIDE, disc.collect());
    ShotLight::new(&ImageStack::new(images).unwrap(), &mask)
}

#[test]
fn only_the_shot_without_lamp_is_ambient() {
    let shot = |index: usize, light: f32| ball(lamp(index), light, 0.15, Transfer::Srgb);
    let mut images: Vec<StackImage> = (0..8).map(|k| shot(k, 0.8)).collect();
    assert_eq!(lit(images.clone()).ambient(), None);
    // A dim lamp is none, however near the camera.
    images[3] = ball(Vec3::Z, 0.2, 0.0, Transfer::Srgb);
    assert_eq!(lit(images.clone()).ambient(), None);
    images[3] = shot(3, 0.0);
    assert_eq!(lit(images).ambient(), Some(3));
}

#[test]
fn only_the_shot_with_the_room_lit_is_named() {
    let shot = |index: usize, room: f32| ball(lamp(index), 0.6, room, Transfer::Linear);
    let mut images: Vec<StackImage> = (0..8).map(|k| shot(k, 0.02)).collect();
    assert_eq!(lit(images.clone()).room_lit(), None);
    // A lamp beside the camera is as flat, but no brighter.
    images[5] = ball(Vec3::Z, 0.5, 0.02, Transfer::Linear);
    assert_eq!(lit(images.clone()).room_lit(), None);
    images[5] = shot(5, 0.7);
    assert_eq!(lit(images).room_lit(), Some(5));
}

#[test]
fn without_the_room_there_is_the_lamp_alone() {
    for transfer in [Transfer::Linear, Transfer::Srgb] {
        let both = ball(lamp(1), 0.8, 0.2, transfer);
        let room = ball(lamp(1), 0.0, 0.2, transfer);
        let lamp_alone = ball(lamp(1), 0.8, 0.0, transfer);
        let mut expected = Vec::new();
        lamp_alone.with_light(|_, light| {
            expected.push(light);
            light
        });
        without_ambient(&both, &room).with_light(|place, light| {
            assert!((light - expected[place]).abs() < 1e-4, "{place}: {light}");
            light
        });
    }
    let full = StackImage {
        samples: Samples::U16(vec![65_535; SIDE * SIDE]),
        ..ball(Vec3::Z, 1.0, 0.0, Transfer::Srgb)
    };
    let room = ball(Vec3::Z, 0.0, 0.5, Transfer::Srgb);
    assert_eq!(without_ambient(&full, &room).samples, full.samples);
}

#[test]
fn differences_do_not_depend_on_brightness() {
    let shots = (0..3).map(|k| ball(lamp(k.min(1)), 0.2 + 0.2 * k as f32, 0.0, Transfer::Linear));
    let light = lit(shots.collect());
    assert!(light.difference(1, 2) < 0.003);
    assert!(light.difference(0, 1) > 0.3);
    assert!(light.mean(2) > light.mean(1) && light.bright() > light.mean(2));
}
