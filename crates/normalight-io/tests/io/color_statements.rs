//! What files say of their colours: profiles, chunks and attributes that the tests write
//! themselves, against the formulas of the standards.
use crate::common::tagged::{ADOBE, assert_light, decode, expected, gamma, picture, png, srgb};
use crate::common::{file, shaded_png, values};
use image::{ExtendedColorType, ImageEncoder, RgbImage};
use moxcms::ColorProfile;
use normalight_core::{Samples, Transfer};
use normalight_io::{ColorMode, Notice, ReadOptions, decode_image, read_stack};
use std::io::Write;

/// From linear Display P3 to linear sRGB (SMPTE EG 432-1 against ITU-R BT.709).
const P3: [[f32; 3]; 3] = [
    [1.2249, -0.2247, 0.0],
    [-0.0420, 1.0419, 0.0],
    [-0.0197, -0.0786, 1.0979],
];

fn code_points(primaries: u8, transfer: u8, full: u8) -> (&'static [u8; 4], Vec<u8>) {
    (b"cICP", vec![primaries, transfer, 0, full])
}

fn icc(profile: &[u8]) -> (&'static [u8; 4], Vec<u8>) {
    let mut packed = b"p\0\0".to_vec();
    let mut encoder = flate2::write::ZlibEncoder::new(&mut packed, flate2::Compression::fast());
    encoder.write_all(profile).unwrap();
    encoder.finish().unwrap();
    (b"iCCP", packed)
}

fn srgb_chunk() -> (&'static [u8; 4], Vec<u8>) {
    (b"sRGB", vec![0])
}

#[test]
fn gamma_comes_with_its_primaries() {
    // The chromaticities of Adobe RGB.
    let points = [31270, 32900, 64000, 33000, 21000, 71000, 15000, 6000u32];
    let chromaticities = points.iter().flat_map(|value| value.to_be_bytes());
    let chunk = (b"cHRM", chromaticities.collect());
    let adobe = decode("a.png", &png(&[gamma(0.45471), chunk.clone()]));
    assert_light(&adobe, &expected(srgb, Some(ADOBE)));
    let linear = decode("a.png", &png(&[gamma(1.0), chunk]));
    assert_light(&linear, &expected(|code| code, Some(ADOBE)));
    // Points on a line are no primaries.
    let line = (b"cHRM", 30000u32.to_be_bytes().repeat(8));
    let found = decode("a.png", &png(&[gamma(0.45455), line]));
    assert_eq!(found.image.transfer, Transfer::Srgb);
}

#[test]
fn code_points_of_all_kinds() {
    let with = |primaries, transfer| decode("a.png", &png(&[code_points(primaries, transfer, 1)]));
    assert_eq!(with(1, 13).image.transfer, Transfer::Srgb);
    let linear = with(1, 8).image;
    assert_eq!(linear.transfer, Transfer::Linear);
    assert_eq!(linear.samples, Samples::U8(picture().into_raw()));
    assert_light(&with(12, 13), &expected(srgb, Some(P3)));
    // ITU-R BT.709: below 0.081 straight, else a power.
    let bt709 = |code: f32| match code {
        code if code < 0.081 => code / 4.5,
        code => ((code + 0.099) / 1.099).powf(1.0 / 0.45),
    };
    assert_light(&with(1, 1), &expected(bt709, None));
    // SMPTE ST 2084 in cd/m2, white at 203.
    let pq = |code: f32| {
        let power = code.powf(1.0 / 78.843_75);
        let ratio = (power - 0.835_937_5).max(0.0) / (18.851_563 - 18.6875 * power);
        10_000.0 / 203.0 * ratio.powf(1.0 / 0.159_301_76)
    };
    assert_light(&with(1, 16), &expected(pq, None));
    // ITU-R BT.2100: the scene's light, white at a code of 0.75.
    let hlg = |code: f32| match code {
        code if code <= 0.5 => code * code / 3.0,
        code => (((code - 0.559_910_7) / 0.178_832_77).exp() + 0.284_668_92) / 12.0,
    };
    assert_light(&with(1, 18), &expected(|code| hlg(code) / hlg(0.75), None));
}

#[test]
fn chunks_are_ranked_as_the_standard_says() {
    let profile = ColorProfile::new_adobe_rgb().encode().unwrap();
    let all = [
        code_points(1, 8, 1),
        icc(&profile),
        srgb_chunk(),
        gamma(0.55556),
    ];
    let adobe = expected(|code| code.powf(2.199_218_8), Some(ADOBE));
    assert_eq!(
        decode("a.png", &png(&all)).image.samples,
        Samples::U8(picture().into_raw())
    );
    assert_light(&decode("a.png", &png(&all[1..])), &adobe);
    let found = decode("a.png", &png(&all[2..])).image.transfer;
    assert_eq!(found, Transfer::Srgb);
    let power = expected(|code| code.powf(1.8), None);
    assert_light(&decode("a.png", &png(&all[3..])), &power);
    // What is asked counts, whatever the file says.
    let asked = decode_image("a.png", &png(&all[1..]), ColorMode::Linear).unwrap();
    assert_eq!(asked.image.samples, Samples::U8(picture().into_raw()));
    assert_eq!(asked.image.transfer, Transfer::Linear);
}

/// A profile whose tables give the colours of sRGB's corners in Lab (D50; Lindbloom), straight
/// between them.
fn table_profile() -> Vec<u8> {
    let corners = [
        [0.0, 0.0, 0.0],
        [29.57, 68.30, -112.03],
        [87.82, -79.29, 80.99],
        [90.67, -50.66, -14.96],
        [54.29, 80.81, 69.89],
        [60.17, 93.55, -60.50],
        [97.61, -15.75, 93.39],
        [100.0, 0.0, 0.0],
    ];
    let lab = corners.iter().flat_map(|[l, a, b]: &[f64; 3]| {
        [
            l / 100.0 * 65_280.0,
            (a + 128.0) * 256.0,
            (b + 128.0) * 256.0,
        ]
        .map(|value| value.round() as u16)
    });
    let straight = || moxcms::LutStore::Store16([0u16, 65_535].repeat(3));
    let mut profile = ColorProfile::new_srgb();
    profile.pcs = moxcms::DataColorSpace::Lab;
    (profile.red_trc, profile.green_trc, profile.blue_trc) = (None, None, None);
    profile.cicp = None;
    profile.lut_a_to_b_colorimetric = Some(moxcms::LutWarehouse::Lut(moxcms::LutDataType {
        num_input_channels: 3,
        num_output_channels: 3,
        num_clut_grid_points: 2,
        matrix: moxcms::Matrix3d::IDENTITY,
        num_input_table_entries: 2,
        num_output_table_entries: 2,
        input_table: straight(),
        clut_table: moxcms::LutStore::Store16(lab.collect()),
        output_table: straight(),
        lut_type: moxcms::LutType::Lut16,
    }));
    profile.encode().unwrap()
}

#[test]
fn tables_are_honoured() {
    let mut picture = RgbImage::new(8, 1);
    for (k, pixel) in picture.pixels_mut().enumerate() {
        pixel.0 = [k & 4, k & 2, k & 1].map(|bit| if bit > 0 { 255 } else { 0 });
    }
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.set_icc_profile(table_profile()).unwrap();
    encoder
        .write_image(&picture, 8, 1, ExtendedColorType::Rgb8)
        .unwrap();
    let found = decode("a.png", &bytes).image;
    assert_eq!(found.transfer, Transfer::Linear);
    let lights = values(&found.samples);
    for (code, light) in picture.iter().zip(lights) {
        let wanted = f32::from(*code) / 255.0;
        // The library is off by 2 % in some corners of tables as coarse as these.
        assert!((light - wanted).abs() < 0.03, "{code}: {light} {wanted}");
    }
}

#[test]
fn grey_profiles_are_honoured() {
    let profile = ColorProfile::new_gray_with_gamma(1.8).encode().unwrap();
    let codes: Vec<u8> = (0..16).map(|k| 17 * k).collect();
    let mut bytes = Vec::new();
    let mut encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder.set_icc_profile(profile).unwrap();
    encoder
        .write_image(&codes, 4, 4, ExtendedColorType::L8)
        .unwrap();
    let found = decode("a.png", &bytes).image;
    for (code, light) in codes.iter().zip(values(&found.samples)) {
        assert!((light - (f32::from(*code) / 255.0).powf(1.8)).abs() < 0.003);
    }
}

#[test]
fn exr_says_its_primaries() {
    use exr::meta::attribute::Chromaticities;
    use exr::prelude::{Image, SpecificChannels, Vec2, WritableImage};
    let pixels = |place: Vec2<usize>| {
        let light = 0.1 + 0.05 * place.x() as f32;
        (light, 0.5, 2.0)
    };
    let mut image = Image::from_channels((8, 8), SpecificChannels::rgb(pixels));
    image.attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.21, 0.71),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.329),
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    let found = decode("a.exr", bytes.get_ref());
    let wanted = (0..64).flat_map(|k| {
        let (r, g, b) = pixels(Vec2(k % 8, k / 8));
        ADOBE.map(|row| row[0] * r + row[1] * g + row[2] * b)
    });
    assert_light(&found, &wanted.collect::<Vec<_>>());
}

/// The notices of three shots with these chunks.
fn notices(chunks: [Vec<(&[u8; 4], Vec<u8>)>; 3]) -> (String, Vec<Notice>) {
    let shots = chunks.iter().enumerate().map(|(turn, chunks)| {
        let plain = shaded_png(16, 12, turn as u32);
        let tagged = png(chunks);
        let added = &tagged[33..tagged.len() - (png(&[]).len() - 33)];
        let bytes = [&plain[..33], added, &plain[33..]].concat();
        file(&format!("{turn}.png"), bytes)
    });
    let input = read_stack(shots.collect(), &ReadOptions::default()).unwrap();
    (input.plan.color.taken.clone(), input.plan.notices)
}

#[test]
fn damaged_profiles_are_said_and_others_believed() {
    let garbage = || icc(&[7; 300]);
    let unpackable = || (b"iCCP", b"p\0\0no zlib".to_vec());
    let taken = |notices: &[Notice], file: &str| {
        notices.iter().find_map(|notice| match notice {
            Notice::ProfileNotUnderstood {
                file: of, taken, ..
            } if of == file => Some(taken.clone()),
            _ => None,
        })
    };
    let (color, said) = notices([
        vec![garbage()],
        vec![unpackable(), srgb_chunk()],
        vec![code_points(1, 13, 0)],
    ]);
    assert_eq!(color, "sRGB");
    for name in ["0.png", "1.png", "2.png"] {
        assert_eq!(taken(&said, name).as_deref(), Some("sRGB"), "{said:?}");
    }
    // Another chunk is believed instead.
    let linear = || vec![garbage(), gamma(1.0)];
    let (color, said) = notices([linear(), linear(), linear()]);
    assert_eq!(color, "linear");
    assert_eq!(taken(&said, "1.png").as_deref(), Some("linear"));
}

#[test]
fn mixed_stacks_are_said_once() {
    let (color, said) = notices([
        vec![gamma(1.0)],
        vec![srgb_chunk()],
        vec![srgb_chunk(), gamma(0.45455)],
    ]);
    assert_eq!(color, "linear and sRGB");
    let mixed: Vec<&Notice> = said
        .iter()
        .filter(|notice| matches!(notice, Notice::ColorMixed { .. }))
        .collect();
    let [notice] = mixed[..] else {
        panic!("{said:?}");
    };
    let words = notice.to_string();
    assert!(
        words.contains("0.png linear") && words.contains("1.png sRGB"),
        "{words}"
    );
    let (_, alike) = notices([vec![srgb_chunk()], vec![srgb_chunk()], vec![srgb_chunk()]]);
    let of_the_mask = |notice: &Notice| matches!(notice, Notice::MaskGuessedWhole);
    assert!(alike.iter().all(of_the_mask), "{alike:?}");
}
