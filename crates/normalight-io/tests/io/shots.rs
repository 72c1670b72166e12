//! Photographs that cannot work, or only with help: each of its kind is said.
use crate::common::{encode, file, mask_png};
use image::{DynamicImage, GrayImage, ImageFormat};
use normalight_io::{
    AmbientChoice, ColorMode, IoError, LeftOutReason, NamedBytes, Notice, ReadOptions, StackInput,
    read_stack,
};

const WIDTH: u32 = 120;
const HEIGHT: u32 = 110;

/// What a shot differs in.
#[derive(Clone, Copy)]
struct Shot {
    /// Azimuth of the lamp, 45 degrees from the camera, in radians.
    turn: f32,
    /// What the camera moved the picture by, right and down.
    shift: [f32; 2],
    /// Light of the lamp and of the room.
    light: [f32; 2],
    /// Which object.
    object: f32,
}

fn lit(index: usize) -> Shot {
    Shot {
        turn: 2.4 * index as f32,
        shift: [0.0; 2],
        light: [0.7, 0.02],
        object: 0.0,
    }
}

/// A patched ball with a bumpy outline on black; sRGB codes.
fn picture(shot: Shot) -> GrayImage {
    let lamp = [shot.turn.cos() * 0.7, shot.turn.sin() * 0.7, 0.714];
    let light = |x: f32, y: f32| {
        let (u, v) = ((x - 60.0) / 42.0, (55.0 - y) / 42.0);
        let around = v.atan2(u);
        let reach = 0.9 + 0.1 * ((5.0 + shot.object) * around + shot.object).cos();
        let z = reach * reach - u * u - v * v;
        if z <= 0.0 {
            return 0.0;
        }
        let length = (u * u + v * v + z).sqrt();
        let shade = (u * lamp[0] + v * lamp[1] + z.sqrt() * lamp[2]) / length;
        let waves = (0.31 * x + shot.object).sin() * (0.27 * y).cos()
            + ((0.13 + 0.05 * shot.object) * x - 0.2 * y).sin();
        let albedo = 0.35 + 0.4 / (1.0 + (-12.0 * waves).exp());
        albedo * (shot.light[0] * shade.max(0.0) + shot.light[1])
    };
    GrayImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let sum: f32 = (0..4)
            .map(|k| {
                let (x, y) = (x as f32 - shot.shift[0], y as f32 - shot.shift[1]);
                light(
                    x + 0.5 * (k % 2) as f32 - 0.25,
                    y + 0.5 * (k / 2) as f32 - 0.25,
                )
            })
            .sum();
        let linear = (sum / 4.0).clamp(0.0, 1.0);
        let code = match linear <= 0.003_130_8 {
            true => 12.92 * linear,
            false => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
        };
        image::Luma([(255.0 * code).round() as u8])
    })
}

fn png(shot: Shot) -> Vec<u8> {
    encode(&DynamicImage::ImageLuma8(picture(shot)), ImageFormat::Png)
}

fn eight(change: impl Fn(usize, &mut Shot)) -> Vec<NamedBytes> {
    let shots = (0..8).map(|index| {
        let mut shot = lit(index);
        change(index, &mut shot);
        file(&format!("{index}.png"), png(shot))
    });
    let mask = mask_png(WIDTH, HEIGHT, |x, y| {
        (x as f32 - 60.0).hypot(y as f32 - 55.0) < 33.0
    });
    shots.chain([file("mask.png", mask)]).collect()
}

/// The pictures are encoded, whatever their shading looks like.
fn srgb() -> ReadOptions {
    ReadOptions {
        color: ColorMode::Srgb,
        ..ReadOptions::default()
    }
}

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &srgb())
}

/// Notices but that about the colour, which is not stated here.
fn notices(input: &StackInput) -> Vec<Notice> {
    let notices = input.plan.notices.iter().cloned();
    notices
        .filter(|notice| !matches!(notice, Notice::ColorUnstated { .. }))
        .collect()
}

fn off(input: &StackInput, shot: usize, truth: Shot) -> f32 {
    let truth = picture(truth);
    let pixels = input.mask.pixels();
    let mut found = vec![[0.0; 3]; pixels.len()];
    input.stack.linear_pixels(shot, &pixels, &mut found);
    let decode = |code: u8| {
        let value = f32::from(code) / 255.0;
        match value <= 0.040_45 {
            true => value / 12.92,
            false => ((value + 0.055) / 1.055).powf(2.4),
        }
    };
    let pairs = found.iter().zip(&pixels);
    let sum: f32 = pairs
        .map(|(rgb, &pixel)| (rgb[1] - decode(truth.as_raw()[pixel])).abs())
        .sum();
    sum / pixels.len() as f32
}

#[test]
fn good_photographs_are_not_talked_about() {
    assert_eq!(notices(&read(eight(|_, _| ())).unwrap()), []);
}

#[test]
fn a_moved_camera_is_said_and_repaired() {
    let shift = |pixels: [f32; 2]| {
        eight(move |index, shot| {
            if index == 3 || index == 5 {
                shot.shift = pixels;
            }
        })
    };
    let error = read(shift([6.0, -5.0])).unwrap_err();
    let IoError::CameraMoved { files, pixels, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!(files, "3.png, 5.png");
    assert!((pixels - 61f32.sqrt()).abs() < 0.4, "{error}");
    assert!(error.to_string().contains("--align"), "{error}");

    let small = read(shift([1.3, 0.9])).unwrap();
    let found = notices(&small);
    assert!(
        matches!(&found[..], [Notice::CameraMoved { files, pixels }]
            if *files == ["3.png", "5.png"] && (pixels - 1.58).abs() < 0.4),
        "{found:?}"
    );

    let options = ReadOptions {
        align: true,
        ..srgb()
    };
    let repaired = read_stack(shift([6.0, -5.0]), &options).unwrap();
    assert_eq!(notices(&repaired), []);
    let most = repaired.plan.aligned.unwrap();
    assert!((most - 61f32.sqrt()).abs() < 0.4, "{most}");
    assert!(
        repaired
            .plan
            .to_string()
            .contains("aligned: photographs moved by")
    );
    for shot in [3, 5] {
        let wrong = off(&repaired, shot, lit(shot));
        assert!(wrong < 0.01, "{shot}: {wrong}");
    }
    assert_eq!(off(&repaired, 2, lit(2)), 0.0);
    let still = read_stack(eight(|_, _| ()), &options).unwrap();
    assert_eq!(still.plan.aligned, Some(0.0));
}

#[test]
fn several_objects_are_refused() {
    let error = read(eight(|index, shot| shot.object = (index / 2) as f32)).unwrap_err();
    assert!(
        matches!(&error, IoError::DifferentObjects { groups, .. } if groups.contains("0.png, 1.png")),
        "{error}"
    );
    let one = read(eight(|index, shot| {
        if index == 4 {
            shot.object = 3.0;
        }
    }));
    let found = notices(&one.unwrap());
    let expected = Notice::Unlike {
        files: vec!["4.png".into()],
    };
    assert!(found.contains(&expected), "{found:?}");
}

#[test]
fn a_lamp_that_stands_still_is_refused() {
    let jpeg = |quality: u8, shot: Shot| {
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, quality);
        encoder.encode_image(&picture(shot)).unwrap();
        bytes
    };
    let again = [95, 85, 75, 90, 80].map(|quality| {
        let mut shot = lit(1);
        // The camera chose another exposure.
        shot.light[0] -= 0.002 * f32::from(quality - 70);
        file(&format!("{quality}.jpg"), jpeg(quality, shot))
    });
    let error = read(again.to_vec()).unwrap_err();
    assert!(
        matches!(&error, IoError::LampStill { difference, .. } if *difference < 0.015),
        "{error}"
    );

    let found = notices(&read(eight(|index, shot| shot.turn = 0.012 * index as f32)).unwrap());
    assert!(
        found
            .iter()
            .any(|notice| matches!(notice, Notice::LampHardlyMoved { .. })),
        "{found:?}"
    );
    let found = notices(
        &read(eight(|index, shot| {
            if index == 6 {
                shot.turn = lit(2).turn
            }
        }))
        .unwrap(),
    );
    let expected = Notice::NearlyIdentical {
        files: vec!["6.png".into()],
    };
    assert_eq!(found, [expected]);
}

#[test]
fn light_where_it_should_not_be_is_said() {
    let found = notices(&read(eight(|_, shot| shot.light = [2.8, 0.08])).unwrap());
    assert!(
        found
            .iter()
            .any(|notice| matches!(notice, Notice::Overexposed { share } if *share > 0.2)),
        "{found:?}"
    );
    let room = eight(|index, shot| {
        if index == 5 {
            shot.light[1] = 0.6;
        }
    });
    let found = notices(&read(room).unwrap());
    let expected = Notice::RoomLit {
        file: "5.png".into(),
    };
    assert!(found.contains(&expected), "{found:?}");
}

#[test]
fn a_picture_without_lamp_is_left_out_or_subtracted() {
    let room = 0.15;
    let with_room = |_: usize, shot: &mut Shot| shot.light[1] = room;
    let dark = Shot {
        light: [0.0, room],
        ..lit(0)
    };
    let alone = |shot: usize| Shot {
        light: [0.7, 0.0],
        ..lit(shot)
    };
    let auto = ReadOptions {
        ambient: AmbientChoice::Auto,
        ..srgb()
    };
    // By its name, and by what it shows.
    for name in ["scene_off.png", "9.png"] {
        let files = || {
            let mut files = eight(with_room);
            files.push(file(name, png(dark)));
            files
        };
        let left = read(files()).unwrap();
        assert_eq!(left.stack.len(), 8, "{name}");
        let expected = Notice::AmbientLeftOut { file: name.into() };
        assert_eq!(notices(&left), [expected]);
        let reasons = [LeftOutReason::Ambient, LeftOutReason::ShowsNoLamp];
        assert!(
            left.plan
                .left_out
                .iter()
                .any(|left| reasons.contains(&left.reason))
        );
        let taken = read_stack(files(), &auto).unwrap();
        assert_eq!((taken.stack.len(), taken.picked.len()), (8, 8));
        assert_eq!(taken.plan.ambient.as_deref(), Some(name));
        assert_eq!(notices(&taken), []);
        for shot in 0..8 {
            assert!(off(&left, shot, alone(shot)) > 0.05);
            let wrong = off(&taken, shot, alone(shot));
            assert!(wrong < 0.003, "{name}, {shot}: {wrong}");
        }
    }
    let found = notices(&read_stack(eight(|_, _| ()), &auto).unwrap());
    assert_eq!(found, [Notice::NoAmbient]);

    let given = |light: f32| ReadOptions {
        ambient: AmbientChoice::File(file(
            "else/where.png",
            png(Shot {
                light: [0.0, light],
                ..dark
            }),
        )),
        ..srgb()
    };
    let taken = read_stack(eight(with_room), &given(room)).unwrap();
    assert_eq!(taken.plan.ambient.as_deref(), Some("where.png"));
    assert!(off(&taken, 1, alone(1)) < 0.003);
    let error = read_stack(eight(with_room), &given(0.5)).unwrap_err();
    assert!(
        matches!(&error, IoError::AmbientBrighter { name, share } if name == "where.png" && *share > 0.3),
        "{error}"
    );
    let found = notices(&read_stack(eight(with_room), &given(0.19)).unwrap());
    assert!(
        found
            .iter()
            .any(|notice| matches!(notice, Notice::AmbientBrighter { .. })),
        "{found:?}"
    );
    let small = ReadOptions {
        ambient: AmbientChoice::File(file("small.png", crate::common::shaded_png(16, 12, 0))),
        ..srgb()
    };
    let error = read_stack(eight(with_room), &small).unwrap_err();
    assert!(error.to_string().contains("small.png: 16x12"), "{error}");
}
