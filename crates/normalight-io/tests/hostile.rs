//! Bytes that the fuzz targets found, or that were thought of while they were written: each once took
//! endless time or memory, ended the program, or was read as something else.
mod common;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, SmallVec, WritableImage,
};
use normalight_core::{Light, Vec3};
use normalight_io::{ColorMode, decode_image, lights_csv, lights_lp, read_lights};
use std::io::Cursor;

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

/// Once a call for each pair of quotes, until the stack was full.
#[test]
fn a_line_of_quotes() {
    let text = "\"a\"".repeat(500_000);
    assert!(read_lights("l.lp", text.as_bytes(), &names(&["a.png"])).is_err());
}

/// Once each number moved all those before it.
#[test]
fn a_line_of_numbers() {
    let text = "1 ".repeat(1_000_000);
    assert!(read_lights("l.lp", text.as_bytes(), &names(&["a.png"])).is_err());
}

fn npy(head: &str, numbers: &[f32]) -> Vec<u8> {
    let mut file = b"\x93NUMPY\x01\0".to_vec();
    file.extend((head.len() as u16).to_le_bytes());
    file.extend(head.bytes());
    file.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    file
}

#[test]
fn heads_of_numpy_files() {
    let head =
        |shape: &str| format!("{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}");
    let photograph = names(&["a.png"]);
    let read = |file: &[u8]| read_lights("l.npy", file, &photograph);
    assert!(read(&npy(&head("(1, 3)"), &[0.0, 0.6, 0.8])).is_ok());
    for shape in [
        "(4294967296, 4294967297, 3)".to_owned(),
        "(0xFFFFFFFFFFFFFFFF, 3)".to_owned(),
        "(9_999_999_999, 9_999_999_999)".to_owned(),
        format!("{}1{}", "(".repeat(8000), ")".repeat(8000)),
    ] {
        assert!(
            read(&npy(&head(&shape), &[0.0, 0.6, 0.8])).is_err(),
            "{shape:.40}"
        );
    }
    // Four gigabytes of head are promised.
    assert!(read(b"\x93NUMPY\x02\0\xFF\xFF\xFF\xFF{").is_err());
    assert!(read(b"\x93NUMPY").is_err());
}

/// Each layer was within the limit, all together were not.
#[test]
fn many_large_layers() {
    let layer = |name: &str| {
        let channel = |name: &str| AnyChannel::new(name, FlatSamples::F32(vec![0.5; 4]));
        let channels: SmallVec<[_; 4]> = [channel("Z"), channel("id")].into_iter().collect();
        let attributes = LayerAttributes::named(name);
        let channels = AnyChannels::sort(channels);
        Layer::new((2, 2), attributes, Encoding::UNCOMPRESSED, channels)
    };
    let layers: Vec<_> = ["a", "b", "c"].map(layer).into();
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((2, 2)));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layers(attributes, layers);
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    let mut bytes = bytes.into_inner();
    let error = decode_image("a.exr", &bytes, ColorMode::Auto).unwrap_err();
    assert!(error.to_string().contains("found Z, id"), "{error}");
    // The windows of all layers now end at 9999, 9999.
    let window = b"dataWindow\0box2i\0\x10\0\0\0";
    let mut found = 0;
    for at in 0..bytes.len() - window.len() {
        if bytes[at..].starts_with(window) {
            let end = at + window.len() + 8;
            bytes[end..end + 4].copy_from_slice(&9999i32.to_le_bytes());
            bytes[end + 4..end + 8].copy_from_slice(&9999i32.to_le_bytes());
            found += 1;
        }
    }
    assert_eq!(found, 3);
    let error = decode_image("a.exr", &bytes, ColorMode::Auto).unwrap_err();
    assert!(error.to_string().contains("are too many"), "{error}");
}

/// What is written is read again, whatever the photographs are called.
#[test]
fn names_of_all_kinds_are_written_and_read() {
    let names = names(&["#1.png", "%2.png", "3", "4 5", "\"6\".png", "a\n7.png"]);
    let lights: Vec<Light> = (0..names.len())
        .map(|k| Light::new(Vec3::new(k as f32, 1.0, 2.0), 1.0))
        .collect();
    for (file, bytes) in [
        ("lights.csv", lights_csv(&names, &lights).unwrap()),
        ("lights.lp", lights_lp(&names, &lights).unwrap()),
    ] {
        let read = read_lights(file, &bytes, &names).unwrap();
        for (read, written) in read.iter().zip(&lights) {
            assert!(read.direction.distance(written.direction) < 1e-5);
        }
    }
}
