//! TIFF as programs write it, made here byte by byte.
use crate::kinds::writer::{Order, Tiff, bits, pack_bits, pack_lzw, short, tiff};
use crate::kinds::{decode, notices};
use normalight_core::Samples;
use normalight_io::{IoError, Notice};

#[test]
fn tiffs_of_scientists() {
    let values: Vec<f32> = (0..20).map(|k| k as f32 * 0.5).collect();
    let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let grey = [bits(1, 32), short(262, 1), short(339, 3)];
    let found = decode("a.tif", &tiff(5, 4, &grey, &data)).unwrap().image;
    assert_eq!(
        (found.channels, found.samples),
        (1, Samples::F32(values.clone()))
    );
    let halves: Vec<u8> = [0x0000u16, 0x3800, 0x3C00, 0x4000]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let grey = [bits(1, 16), short(262, 1), short(339, 3)];
    let found = decode("a.tif", &tiff(2, 2, &grey, &halves)).unwrap().image;
    assert_eq!(found.samples, Samples::F32(vec![0.0, 0.5, 1.0, 2.0]));

    let tags = [bits(2, 8), short(262, 1), short(277, 2), short(338, 2)];
    let found = decode("a.tif", &tiff(2, 2, &tags, &[9, 255, 8, 255, 7, 0, 6, 255])).unwrap();
    assert_eq!(found.image.samples, Samples::U8(vec![9, 8, 7, 6]));
    assert_eq!(found.alpha.unwrap().inside(), [true, true, false, true]);

    let mut map = vec![0u32; 768];
    for (index, color) in [(3, [65_535, 257 * 2, 0]), (7, [0, 257 * 9, 257 * 100])] {
        for channel in 0..3 {
            map[256 * channel + index] = color[channel];
        }
    }
    let tags = [bits(1, 8), short(262, 3), (320, 3, map)];
    let found = decode("a.tif", &tiff(2, 1, &tags, &[3, 7])).unwrap().image;
    assert_eq!(found.samples, Samples::U8(vec![255, 2, 0, 0, 9, 100]));

    // Luma and chroma of pure red, as JFIF defines them.
    let tags = [
        bits(3, 8),
        short(262, 6),
        short(277, 3),
        (530, 3, vec![1, 1]),
    ];
    let found = decode("a.tif", &tiff(2, 1, &tags, &[76, 85, 255, 128, 128, 128]))
        .unwrap()
        .image;
    let Samples::U8(codes) = found.samples else {
        panic!()
    };
    let expected = [254u8, 0, 0, 128, 128, 128];
    assert!(
        codes.iter().zip(expected).all(|(a, b)| a.abs_diff(b) <= 1),
        "{codes:?}"
    );
}

/// What a sample is, by its place; no two channels alike.
fn ramp(channels: usize, full: u32) -> impl Fn(u32, u32, usize) -> u32 {
    move |x, y, c| (x * 7 + y * 13 + c as u32 * 29 + channels as u32) % 301 * full / 300
}

/// The first `kept` of the channels, in the order of the picture.
fn expected(image: &Tiff, kept: usize, at: &impl Fn(u32, u32, usize) -> u32) -> Vec<u32> {
    let (width, height) = (image.width, image.height);
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    places
        .flat_map(|(x, y)| (0..kept).map(move |c| (x, y, c)))
        .map(|(x, y, c)| at(x, y, c))
        .collect()
}

/// Extra channels, differences, byte orders, tiles and planes, all against one closed form: the
/// library's decoder alone garbles several of these.
#[test]
fn extra_channels_come_out_whole_in_every_layout() {
    type Pack = fn(&[u8]) -> Vec<u8>;
    let packs: [Option<(u32, Pack)>; 4] =
        [None, None, Some((32_773, pack_bits)), Some((5, pack_lzw))];
    for order in [Order::Little, Order::Big] {
        for (depth, full) in [(8, 255), (16, 65_535)] {
            for (channels, photometric, kept) in
                [(1, 1, 1), (2, 1, 1), (3, 2, 3), (4, 2, 3), (6, 2, 3)]
            {
                for layout in 0..32 {
                    let image = Tiff {
                        order,
                        big: layout % 2 == 1,
                        tile: (layout / 2 % 2 == 1).then_some((16, 16)),
                        planar: layout / 4 % 2 == 1 && channels > 1,
                        differences: layout / 8 % 2 == 1,
                        pack: packs[layout / 16 * 2 + layout / 8 % 2],
                        ..Tiff::new(21, 18, depth, channels)
                    };
                    let at = ramp(channels, full);
                    let extra = vec![0; channels - kept];
                    let tags = [short(262, photometric), (338, 3, extra.clone())];
                    let tags = &tags[..if extra.is_empty() { 1 } else { 2 }];
                    let bytes = image.bytes(tags, &at);
                    let found = decode("a.tif", &bytes).unwrap().image;
                    let found = match found.samples {
                        Samples::U8(codes) => codes.into_iter().map(u32::from).collect::<Vec<_>>(),
                        Samples::U16(codes) => codes.into_iter().map(u32::from).collect(),
                        Samples::F32(_) => panic!(),
                    };
                    assert_eq!(
                        found,
                        expected(&image, kept, &at),
                        "{order:?} {depth} {channels} {layout}"
                    );
                }
            }
        }
    }
}

#[test]
fn channels_that_are_left_out_are_told() {
    let tags = [short(262, 2), (338, 3, vec![0, 0])];
    let image = Tiff::new(16, 16, 8, 5);
    let told = notices("tif", |turn| {
        image.bytes(&tags, &|x, y, c| {
            (40 + 7 * x * turn + 5 * y + 31 * c as u32) % 256
        })
    });
    for turn in 0..3 {
        let extra = Notice::ExtraChannels {
            file: format!("{turn}.tif"),
            channels: 2,
        };
        assert!(told.contains(&extra), "{told:?}");
    }
}

#[test]
fn numbers_of_all_widths_and_signs() {
    let floats = |depth, kind: u32, at: &dyn Fn(u32, u32, usize) -> u64| {
        let image = Tiff::new(3, 2, depth, 1);
        let bytes = image.bytes_wide(&[short(262, 1), short(339, kind)], at);
        match decode("a.tif", &bytes).unwrap().image.samples {
            Samples::F32(values) => values,
            other => panic!("{other:?}"),
        }
    };
    let double = |x: u32, y: u32, _: usize| (f64::from(x) - f64::from(y) * 0.25).to_bits();
    assert_eq!(floats(64, 3, &double), [0.0, 1.0, 2.0, -0.25, 0.75, 1.75]);
    let signed = |x: u32, y: u32, _: usize| (x as i64 * 60 - y as i64 * 127) as u64;
    let close = |found: Vec<f32>, full: f64| {
        let truth = [0.0, 60.0, 120.0, -127.0, -67.0, -7.0].map(|value| (value / full) as f32);
        assert!(
            found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 1e-6),
            "{found:?}"
        );
    };
    close(floats(8, 2, &signed), 127.0);
    close(floats(16, 2, &signed), 32_767.0);
    close(floats(32, 2, &signed), 2_147_483_647.0);
    let whole = floats(32, 1, &|x, _, _| [0, 0x8000_0000, 0xFFFF_FFFF][x as usize]);
    assert_eq!(whole, [0.0, 0.5, 1.0, 0.0, 0.5, 1.0]);
}

#[test]
fn samples_within_bytes() {
    for (depth, full) in [
        (1u16, 1u32),
        (2, 3),
        (4, 15),
        (10, 1023),
        (12, 4095),
        (14, 16_383),
    ] {
        for channels in [1, 3] {
            let image = Tiff::new(7, 5, depth, channels);
            let at = |x: u32, y: u32, c: usize| (x * 3 + y * 5 + c as u32) % (full + 1);
            let photometric = if channels == 3 { 2 } else { 1 };
            let bytes = image.bytes(&[short(262, photometric)], &at);
            let to = if depth < 8 { 255 } else { 65_535 };
            let truth = expected(&image, channels, &at).into_iter();
            let truth: Vec<u32> = truth.map(|code| (code * to + full / 2) / full).collect();
            let found: Vec<u32> = match decode("a.tif", &bytes).unwrap().image.samples {
                Samples::U8(codes) => codes.into_iter().map(u32::from).collect(),
                Samples::U16(codes) => codes.into_iter().map(u32::from).collect(),
                Samples::F32(_) => panic!(),
            };
            assert_eq!(found, truth, "{depth} {channels}");
        }
    }
}

#[test]
fn grey_from_white_and_bits_from_the_other_end() {
    let grey = tiff(3, 1, &[bits(1, 8), short(262, 0)], &[0, 100, 255]);
    let found = decode("a.tif", &grey).unwrap().image.samples;
    assert_eq!(found, Samples::U8(vec![255, 155, 0]));
    let mask = |photometric, order, byte| {
        let tags = [bits(1, 1), short(262, photometric), short(266, order)];
        decode("a.tif", &tiff(4, 1, &tags, &[byte]))
            .unwrap()
            .image
            .samples
    };
    assert_eq!(mask(1, 1, 0b1100_0000), Samples::U8(vec![255, 255, 0, 0]));
    assert_eq!(mask(0, 1, 0b1100_0000), Samples::U8(vec![0, 0, 255, 255]));
    assert_eq!(mask(1, 2, 0b0000_0011), Samples::U8(vec![255, 255, 0, 0]));
    // Grey with transparency keeps it.
    let tags = [bits(2, 8), short(262, 0), short(277, 2), short(338, 2)];
    let found = decode("a.tif", &tiff(2, 1, &tags, &[10, 255, 20, 0])).unwrap();
    assert_eq!(found.image.samples, Samples::U8(vec![245, 235]));
    assert_eq!(found.alpha.unwrap().inside(), [true, false]);
}

#[test]
fn colours_under_transparency_are_restored() {
    let tags = |kind| [bits(4, 8), short(262, 2), short(277, 4), short(338, kind)];
    let data = [50, 100, 0, 128, 7, 8, 9, 255, 0, 0, 0, 0];
    let found = decode("a.tif", &tiff(3, 1, &tags(1), &data)).unwrap();
    let colours = vec![100, 199, 0, 7, 8, 9, 0, 0, 0];
    assert_eq!(found.image.samples, Samples::U8(colours));
    assert_eq!(found.alpha.unwrap().inside(), [true, true, false]);
    let found = decode("a.tif", &tiff(3, 1, &tags(2), &data)).unwrap();
    assert_eq!(
        found.image.samples,
        Samples::U8(vec![50, 100, 0, 7, 8, 9, 0, 0, 0])
    );
}

#[test]
fn zstandard_and_packed_runs() {
    let image = Tiff::new(9, 4, 16, 3);
    let at = ramp(3, 65_535);
    let samples = Samples::U16(
        expected(&image, 3, &at)
            .into_iter()
            .map(|v| v as u16)
            .collect(),
    );
    let data = image.chunk_bytes(&at);
    let squeezed =
        ruzstd::encoding::compress_to_vec(&data[..], ruzstd::encoding::CompressionLevel::Fastest);
    let tags = |method| {
        [
            bits(3, 16),
            short(262, 2),
            short(277, 3),
            short(259, method),
        ]
    };
    let whole = tiff(9, 4, &tags(50_000), &squeezed);
    assert_eq!(decode("a.tif", &whole).unwrap().image.samples, samples);
    let runs = tiff(9, 4, &tags(32_773), &pack_bits(&data));
    assert_eq!(decode("a.tif", &runs).unwrap().image.samples, samples);
    let cut = tiff(9, 4, &tags(50_000), &squeezed[..squeezed.len() / 2]);
    let error = decode("a.tif", &cut).unwrap_err();
    assert!(matches!(&error, IoError::Decode { .. }), "{error}");
    assert!(error.to_string().contains("Zstandard"), "{error}");
}

/// A strip that is shorter than its rows must not be filled from what follows it.
#[test]
fn short_strips_are_cut_off() {
    let tags = [bits(1, 8), short(262, 1)];
    let mut bytes = tiff(8, 8, &tags, &[7; 64]);
    let count = bytes.windows(4).position(|w| w == [0x17, 1, 4, 0]).unwrap();
    bytes[count + 8] = 63;
    let error = decode("a.tif", &bytes).unwrap_err().to_string();
    assert!(
        error.starts_with("a.tif:") && error.contains("cut off"),
        "{error}"
    );
}
