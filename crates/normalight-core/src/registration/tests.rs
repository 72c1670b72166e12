//! On closed-form scenes: a textured, bumpy sphere on a textured ground, under one lamp a shot.
use super::*;
use crate::{Samples, StackImage, Transfer, Vec3};
use proptest::prelude::*;

const WIDTH: usize = 150;
const HEIGHT: usize = 130;

/// Albedo at a place: two kinds of patches, or none.
fn albedo(x: f32, y: f32, seed: f32) -> f32 {
    let waves = (0.21 * x + seed).sin() * (0.17 * y - 0.5 * seed).cos()
        + (0.11 * x - 0.14 * y + 2.0 * seed).sin();
    0.5 + 0.3 / (1.0 + (-12.0 * waves).exp()) - 0.15
}

/// Light at any place of the plane, so that a shifted camera sees exactly the same scene.
fn light(x: f32, y: f32, lamp: Vec3, seed: f32) -> f32 {
    let (u, v) = ((x - 75.0) / 48.0, (y - 65.0) / 48.0);
    let inside = 1.0 - u * u - v * v;
    let bump = |x: f32| 0.12 * (0.35 * x + seed).cos();
    let (normal, kind) = match inside > 0.0 {
        true => (Vec3::new(u + bump(x), -v + bump(y), inside.sqrt()), 1.0),
        false => (Vec3::Z, 0.15),
    };
    let shade = normal.normalize().dot(lamp).max(0.0) + 0.02;
    kind * albedo(x, y, seed) * shade
}

fn shot(lamp: Vec3, shift: [f32; 2], seed: f32) -> StackImage {
    let pixels = 0..WIDTH * HEIGHT;
    let value = |pixel: usize| {
        // Four samples a pixel: edges are not of one pixel.
        let part = |k: usize| {
            let x = (pixel % WIDTH) as f32 + 0.5 * (k % 2) as f32 - 0.25 - shift[0];
            let y = (pixel / WIDTH) as f32 + 0.5 * (k / 2) as f32 - 0.25 - shift[1];
            light(x, y, lamp, seed)
        };
        let sum: f32 = (0..4).map(part).sum();
        sum / 4.0
    };
    StackImage {
        name: String::new(),
        width: WIDTH,
        height: HEIGHT,
        channels: 1,
        samples: Samples::U8(pixels.map(|p| (value(p) * 255.0).round() as u8).collect()),
        transfer: Transfer::Linear,
    }
}

/// Lamps all around, 20 to 65 degrees from the camera.
fn lamp(index: usize) -> Vec3 {
    let turn = 2.4 * index as f32;
    let tilt = 0.35 + 0.8 * ((index * 5) % 7) as f32 / 7.0;
    Vec3::new(tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos())
}

fn stack(shifts: &[[f32; 2]]) -> ImageStack {
    let shots = shifts.iter().enumerate();
    ImageStack::new(shots.map(|(k, &s)| shot(lamp(k), s, 1.0)).collect()).unwrap()
}

fn disc() -> Mask {
    let inside = (0..WIDTH * HEIGHT).map(|pixel| {
        let (x, y) = ((pixel % WIDTH) as f32 - 75.0, (pixel / WIDTH) as f32 - 65.0);
        x.hypot(y) < 48.0
    });
    Mask::new(WIDTH, HEIGHT, inside.collect())
}

/// Largest distance of found shifts from the true ones, up to a shift that all share.
fn farthest(found: &[ShotShift], truth: &[[f32; 2]]) -> f32 {
    let apart: Vec<[f32; 2]> = found
        .iter()
        .zip(truth)
        .map(|(found, truth)| [0, 1].map(|axis| found.shift[axis] - truth[axis]))
        .collect();
    let middle = joint::geometric_median(&apart);
    let distances = apart
        .iter()
        .map(|off| (off[0] - middle[0]).hypot(off[1] - middle[1]));
    distances.fold(0.0, f32::max)
}

#[test]
fn a_still_camera_under_moving_light_has_not_moved() {
    let found = register_shots(&stack(&[[0.0; 2]; 9]), &disc());
    for shot in &found.shifts {
        assert!(shot.pixels() < 0.35 && shot.certainty < 3.0, "{shot:?}");
    }
    assert_eq!(found.groups.len(), 1);
}

/// Shifts as they are found where the camera is still, and these: each light draws the outline a
/// little to its own side, which no shift can be told from.
fn beside(shifts: &[[f32; 2]]) -> Vec<[f32; 2]> {
    static STILL: std::sync::OnceLock<Vec<ShotShift>> = std::sync::OnceLock::new();
    let still = STILL.get_or_init(|| register_shots(&stack(&[[0.0; 2]; 9]), &disc()).shifts);
    let pairs = shifts.iter().zip(still);
    pairs
        .map(|(shift, still)| [0, 1].map(|axis| shift[axis] + still.shift[axis]))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]
    #[test]
    fn some_moved_shots_are_found(
        turn in 0.0f32..std::f32::consts::TAU,
        pixels in 1.2f32..14.0,
        which in 0usize..9,
    ) {
        let mut shifts = [[0.0; 2]; 9];
        shifts[which] = [pixels * turn.cos(), pixels * turn.sin()];
        shifts[(which + 4) % 9] = [-1.5, 2.25];
        let found = register_shots(&stack(&shifts), &disc()).shifts;
        prop_assert!(farthest(&found, &shifts) < 0.35, "{found:?} {shifts:?}");
        prop_assert!(farthest(&found, &beside(&shifts)) < 0.25, "{found:?} {shifts:?}");
        for (shot, truth) in found.iter().zip(&shifts) {
            let moved = truth[0].hypot(truth[1]) > 0.0;
            prop_assert_eq!(shot.certainty > 5.0, moved, "{:?}", shot);
        }
    }

    #[test]
    fn a_camera_in_the_hand_is_followed(walk in proptest::collection::vec(-6.0f32..6.0, 18)) {
        let shifts: Vec<[f32; 2]> = walk.chunks_exact(2).map(|at| [at[0], at[1]]).collect();
        let found = register_shots(&stack(&shifts), &disc()).shifts;
        prop_assert!(farthest(&found, &shifts) < 0.45, "{found:?} {shifts:?}");
        prop_assert!(farthest(&found, &beside(&shifts)) < 0.3, "{found:?} {shifts:?}");
    }
}

#[test]
fn a_camera_that_stood_in_two_places_is_found() {
    let shifts: Vec<[f32; 2]> = (0..10)
        .map(|k| if k < 5 { [0.0; 2] } else { [21.0, -9.0] })
        .collect();
    let found = register_shots(&stack(&shifts), &disc()).shifts;
    assert!(farthest(&found, &shifts) < 0.5, "{found:?}");
}

#[test]
fn moved_back_a_shot_shows_what_the_still_camera_saw() {
    let shift = [2.3, -1.6];
    let still = shot(lamp(2), [0.0; 2], 1.0);
    let back = translated(&shot(lamp(2), shift, 1.0), shift);
    let (Samples::U8(still), Samples::U8(back)) = (&still.samples, &back.samples) else {
        panic!("other samples");
    };
    let seen = keep_seen(&Mask::whole(WIDTH, HEIGHT), shift);
    // 2.3 columns at the right and 1.6 rows at the top are not seen.
    assert_eq!(seen.count(), (WIDTH - 3) * (HEIGHT - 2));
    let inside = seen.pixels();
    let off = |pixel: &usize| f32::from(still[*pixel].abs_diff(back[*pixel]));
    let mean = inside.iter().map(off).sum::<f32>() / inside.len() as f32;
    assert!(mean < 0.6, "{mean}");
    let untouched = translated(&shot(lamp(2), shift, 1.0), [0.0; 2]);
    assert_eq!(untouched, shot(lamp(2), shift, 1.0));
}

#[test]
fn larger_pictures_are_as_exact_as_they_can_be() {
    // Each pixel three times three times: a shift of 2 is one of 6.
    let shifts = [[0.0, 0.0], [2.0, -3.0], [0.0, 0.0], [0.0, 0.0], [0.0; 2]];
    let large = |(index, &shift): (usize, &[f32; 2])| {
        let small = shot(lamp(index), shift, 1.0);
        let Samples::U8(codes) = &small.samples else {
            panic!("other samples");
        };
        let pixels = 0..9 * WIDTH * HEIGHT;
        let code = |at: usize| codes[at / (3 * WIDTH) / 3 * WIDTH + at % (3 * WIDTH) / 3];
        StackImage {
            width: 3 * WIDTH,
            height: 3 * HEIGHT,
            samples: Samples::U8(pixels.map(code).collect()),
            ..small
        }
    };
    let stack = ImageStack::new(shifts.iter().enumerate().map(large).collect()).unwrap();
    let found = register_shots(&stack, &Mask::whole(3 * WIDTH, 3 * HEIGHT)).shifts;
    let shifts = shifts.map(|shift| shift.map(|pixels| 3.0 * pixels));
    assert!(farthest(&found, &shifts) < 0.3, "{found:?}");
}

#[test]
fn other_scenes_are_other_groups() {
    let scene = |index: usize| shot(lamp(index), [0.0; 2], 1.0);
    let other = |index: usize| {
        let mut image = shot(lamp(index), [0.0; 2], 4.0);
        let Samples::U8(codes) = &mut image.samples else {
            panic!("other samples");
        };
        // Another outline and turned patches.
        codes.reverse();
        for (pixel, code) in codes.iter_mut().enumerate() {
            let (x, y) = (pixel % WIDTH, pixel / WIDTH);
            if x + y < 90 || x > y + 40 {
                *code = 3;
            }
        }
        image
    };
    let images = vec![scene(0), other(1), scene(2), scene(3), other(4), other(5)];
    let stack = ImageStack::new(images).unwrap();
    let found = register_shots(&stack, &Mask::whole(WIDTH, HEIGHT));
    assert_eq!(found.groups, [[0, 2, 3], [1, 4, 5]]);
}

#[test]
fn black_shots_are_nowhere() {
    let mut images: Vec<StackImage> = (0..4).map(|k| shot(lamp(k), [0.0; 2], 1.0)).collect();
    images[1].samples = Samples::U8(vec![0; WIDTH * HEIGHT]);
    let stack = ImageStack::new(images).unwrap();
    let found = register_shots(&stack, &disc());
    assert_eq!(found.shifts[1], ShotShift::default());
    assert_eq!(found.groups, [[0, 2, 3]]);
}
