//! EXR: compressions, layers, parts, windows; made with the library's own writer.
use crate::kinds::{decode, notices};
use exr::meta::attribute::IntegerBounds;
use exr::prelude::*;
use normalight_core::Samples;
use normalight_io::Notice;
use std::io::Cursor;

const WIDE: usize = 19;
const HIGH: usize = 17;

fn plane(turn: usize) -> Vec<f32> {
    let places = (0..WIDE * HIGH).map(|k| (k % WIDE, k / WIDE));
    places
        .map(|(x, y)| ((x * (turn + 2) + y * 3 + turn) % 23) as f32 / 8.0)
        .collect()
}

fn channel(name: &str, turn: usize) -> AnyChannel<FlatSamples> {
    AnyChannel::new(name, FlatSamples::F32(plane(turn)))
}

fn layer(
    name: &str,
    channels: &[(&str, usize)],
    encoding: Encoding,
) -> exr::image::Layer<AnyChannels<FlatSamples>> {
    let channels = channels.iter().map(|(name, turn)| channel(name, *turn));
    exr::image::Layer::new(
        (WIDE, HIGH),
        LayerAttributes::named(name),
        encoding,
        AnyChannels::sort(channels.collect()),
    )
}

fn written(layers: Vec<exr::image::Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    let window = IntegerBounds::from_dimensions((WIDE, HIGH));
    let layers = layers.into_iter().collect::<SmallVec<_>>();
    let image = Image::from_layers(ImageAttributes::new(window), layers);
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

fn values(bytes: &[u8]) -> (usize, Vec<f32>) {
    let found = decode("a.exr", bytes).unwrap().image;
    let Samples::F32(values) = found.samples else {
        panic!()
    };
    (found.channels, values)
}

fn woven(turns: &[usize]) -> Vec<f32> {
    let planes: Vec<Vec<f32>> = turns.iter().map(|&turn| plane(turn)).collect();
    let pixels = (0..WIDE * HIGH).flat_map(|k| planes.iter().map(move |plane| plane[k]));
    pixels.collect()
}

const RGB: [(&str, usize); 3] = [("R", 0), ("G", 1), ("B", 2)];

#[test]
fn lossless_compressions_and_tiles() {
    let methods = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ];
    let blocks = [Blocks::ScanLines, Blocks::Tiles(Vec2(8, 8))];
    for compression in methods {
        for blocks in blocks {
            let encoding = Encoding {
                compression,
                blocks,
                line_order: LineOrder::Increasing,
            };
            let bytes = written(vec![layer("", &RGB, encoding)]);
            assert_eq!(
                values(&bytes),
                (3, woven(&[0, 1, 2])),
                "{compression} {blocks:?}"
            );
        }
    }
}

/// Half-precision data would be near; 32-bit floats lose their last bits in PXR24 only.
#[test]
fn lossy_compressions_are_near() {
    for compression in [
        Compression::PXR24,
        Compression::B44,
        Compression::DWAA(None),
    ] {
        let encoding = Encoding {
            compression,
            ..Encoding::SMALL_LOSSLESS
        };
        let (channels, found) = values(&written(vec![layer("", &RGB, encoding)]));
        assert_eq!(channels, 3);
        let truth = woven(&[0, 1, 2]);
        assert!(
            found.iter().zip(truth).all(|(a, b)| (a - b).abs() < 0.2),
            "{compression}"
        );
    }
}

fn plain(name: &str, channels: &[(&str, usize)]) -> exr::image::Layer<AnyChannels<FlatSamples>> {
    layer(name, channels, Encoding::FAST_LOSSLESS)
}

#[test]
fn luminance_is_one_channel() {
    assert_eq!(
        values(&written(vec![plain("", &[("Y", 4)])])),
        (1, plane(4))
    );
    // A lone colour is grey, too.
    assert_eq!(
        values(&written(vec![plain("", &[("R", 3)])])),
        (1, plane(3))
    );
}

#[test]
fn the_finished_picture_is_taken_among_layers_and_parts() {
    let layers = |turn| {
        [
            ("V.Diffuse.R", 9),
            ("V.Diffuse.G", 9),
            ("V.Diffuse.B", 9),
            ("V.Combined.R", turn),
            ("V.Combined.G", turn + 1),
            ("V.Combined.B", turn + 2),
            // Not a luminance.
            ("V.Normal.X", 5),
            ("V.Normal.Y", 6),
            ("V.Normal.Z", 7),
            ("V.Depth.Z", 8),
        ]
    };
    let bytes = written(vec![plain("", &layers(0))]);
    assert_eq!(values(&bytes), (3, woven(&[0, 1, 2])));
    let told = notices("exr", |turn| {
        written(vec![plain("", &layers(turn as usize))])
    });
    let expected = Notice::SeveralLayers {
        file: "1.exr".to_owned(),
        taken: "V.Combined".to_owned(),
        others: vec!["V.Diffuse".to_owned()],
    };
    assert!(told.contains(&expected), "{told:?}");

    let parts = vec![
        plain("depth", &[("Z", 5)]),
        plain("left", &RGB),
        plain("right", &[("R", 7), ("G", 7), ("B", 7)]),
    ];
    assert_eq!(values(&written(parts)), (3, woven(&[0, 1, 2])));
}

#[test]
fn what_is_no_picture_is_refused_with_its_channels() {
    let bytes = written(vec![plain("", &[("N.X", 1), ("N.Y", 2), ("N.Z", 3)])]);
    let error = decode("a.exr", &bytes).unwrap_err().to_string();
    assert!(
        error.contains("N.X, N.Y, N.Z") && error.contains("R, G and B"),
        "{error}"
    );
    let chroma = written(vec![plain("", &[("BY", 1), ("RY", 2), ("Y", 3)])]);
    let error = decode("a.exr", &chroma).unwrap_err().to_string();
    assert!(
        error.contains("luminance") && error.contains("RGB"),
        "{error}"
    );
    let mut deep = written(vec![plain("", &RGB)]);
    deep[5] |= 0b1000;
    let error = decode("a.exr", &deep).unwrap_err().to_string();
    assert!(
        error.contains("deep data") && error.contains("flatten"),
        "{error}"
    );
}

/// The display window is the frame: black around a smaller data window, and nothing beyond.
#[test]
fn data_lies_in_the_display_window() {
    let window = IntegerBounds::new((-2, 1), (12usize, 30usize));
    let mut part = plain("", &[("Y", 0)]);
    part.attributes.layer_position = Vec2(3, 4);
    let image = Image::from_layers(ImageAttributes::new(window), smallvec_of(part));
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    let found = decode("a.exr", &bytes.into_inner()).unwrap().image;
    assert_eq!((found.width, found.height), (12, 30));
    let Samples::F32(found) = found.samples else {
        panic!()
    };
    let truth = plane(0);
    for y in 0..30 {
        for x in 0..12 {
            let (column, row) = (x as i32 - 5, y as i32 - 3);
            let inside = column >= 0 && (0..HIGH as i32).contains(&row);
            let expected = if inside {
                truth[row as usize * WIDE + column as usize]
            } else {
                0.0
            };
            assert_eq!(found[y * 12 + x], expected, "{x} {y}");
        }
    }
}

fn smallvec_of<T>(one: T) -> SmallVec<[T; 2]> {
    std::iter::once(one).collect()
}

#[test]
fn infinite_light_is_the_brightest() {
    let make = |turn: u32| {
        let mut plane = plane(turn as usize);
        if turn == 1 {
            (plane[4], plane[5]) = (f32::INFINITY, f32::NEG_INFINITY);
        }
        let channels =
            AnyChannels::sort(smallvec_list(AnyChannel::new("Y", FlatSamples::F32(plane))));
        let part = exr::image::Layer::new(
            (WIDE, HIGH),
            LayerAttributes::named(""),
            Encoding::UNCOMPRESSED,
            channels,
        );
        written(vec![part])
    };
    let told = notices("exr", make);
    let expected = Notice::Infinite {
        file: "1.exr".to_owned(),
        samples: 2,
    };
    assert!(told.contains(&expected), "{told:?}");
    let (_, found) = values(&make(1));
    let brightest = found.iter().copied().fold(0.0, f32::max);
    assert_eq!(found[4..6], [brightest, 0.0]);
}

fn smallvec_list<T>(one: T) -> SmallVec<[T; 4]> {
    std::iter::once(one).collect()
}
