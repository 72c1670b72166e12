//! PNM, PFM, QOI, BMP and TGA.
use crate::common::{encode, rgb8};
use crate::kinds::decode;
use image::ImageFormat;
use normalight_core::Samples;

#[test]
fn float_maps_and_grey_maps() {
    let pgm = decode("a.pgm", b"P5\n# Yale\n3 2\n255\n\x01\x02\x03\x04\x05\x06")
        .unwrap()
        .image;
    assert_eq!(
        (pgm.width, pgm.channels, pgm.samples),
        (3, 1, Samples::U8(vec![1, 2, 3, 4, 5, 6]))
    );
    // Rows from the bottom, little-endian by the sign.
    let values = [1.0f32, 2.0, 3.0, 4.0];
    let little: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let big: Vec<u8> = values.iter().flat_map(|v| v.to_be_bytes()).collect();
    for (scale, data) in [("-1.0", &little), ("1.0", &big)] {
        let bytes = [format!("Pf\n2 2\n{scale}\n").as_bytes(), data].concat();
        let found = decode("a.pfm", &bytes).unwrap().image;
        let Samples::F32(found) = found.samples else {
            panic!()
        };
        assert_eq!(
            found.iter().step_by(3).copied().collect::<Vec<_>>(),
            [3.0, 4.0, 1.0, 2.0]
        );
        for cut in 0..bytes.len() {
            assert!(decode("a.pfm", &bytes[..cut]).is_err());
        }
    }
    assert!(decode("a.pfm", b"Pf\n99999999 99999999\n-1\n").is_err());
    assert!(decode("a.pfm", b"PF\n1000000 100\n-1\n").is_err());
}

fn codes(name: &str, bytes: &[u8]) -> (usize, Vec<u8>) {
    let found = decode(name, bytes).unwrap().image;
    let Samples::U8(codes) = found.samples else {
        panic!("{name}");
    };
    (found.channels, codes)
}

#[test]
fn anymaps_of_all_numbers() {
    let ascii = b"P2 # grey\n# as text\n3 1 4\n0 2\n4\n";
    assert_eq!(codes("a.pgm", ascii), (1, vec![0, 128, 255]));
    let colours = b"P3\n2 1\n255\n1 2 3  4 5 6\n";
    assert_eq!(codes("a.ppm", colours), (3, vec![1, 2, 3, 4, 5, 6]));
    // In bit maps 1 is black, and rows begin with a byte.
    assert_eq!(codes("a.pbm", b"P1\n3 1\n1 0 1\n"), (1, vec![0, 255, 0]));
    assert_eq!(
        codes("a.pbm", b"P4\n3 2\n\xA0\x40"),
        (1, vec![0, 255, 0, 255, 0, 255])
    );
    let sixteen = decode("a.pgm", b"P5 2 1 65535\n\x12\x34\xFF\xFF")
        .unwrap()
        .image;
    assert_eq!(sixteen.samples, Samples::U16(vec![0x1234, 0xFFFF]));
    // Twelve bits of a camera fill the scale.
    let twelve = decode("a.pgm", b"P5 2 1 4095\n\x0F\xFF\x08\x00")
        .unwrap()
        .image;
    assert_eq!(twelve.samples, Samples::U16(vec![65_535, 32_776]));
    let head = "P7\nWIDTH 2\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n";
    let pam = [head.as_bytes(), &[9, 8, 7, 255, 6, 5, 4, 0]].concat();
    assert_eq!(codes("a.pam", &pam), (3, vec![9, 8, 7, 6, 5, 4]));
    assert_eq!(
        decode("a.pam", &pam).unwrap().alpha.unwrap().inside(),
        [true, false]
    );
    for cut in [pam.len() - 1, 40, 3] {
        assert!(decode("a.pam", &pam[..cut]).is_err());
    }
}

#[test]
fn qoi_and_its_pieces() {
    let whole = encode(&rgb8(16, 12), ImageFormat::Qoi);
    assert_eq!(codes("a.qoi", &whole), (3, rgb8(16, 12).into_bytes()));
    assert!(decode("a.qoi", &whole[..whole.len() / 2]).is_err());
}

/// A BMP of one row: bits, compression, palette of (blue, green, red, 0), data.
fn bmp(width: u32, bits: u16, compression: u32, palette: &[[u8; 4]], data: &[u8]) -> Vec<u8> {
    let start = 54 + 4 * palette.len() as u32;
    let mut bytes = b"BM".to_vec();
    for word in [start + data.len() as u32, 0, start, 40, width, 1] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(1u16.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    for word in [
        compression,
        data.len() as u32,
        0,
        0,
        palette.len() as u32,
        0,
    ] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(palette.as_flattened());
    bytes.extend(data);
    bytes
}

#[test]
fn bitmaps_of_windows() {
    let palette = [[1, 2, 3, 0], [40, 50, 60, 0], [7, 8, 9, 0]];
    let colours = vec![60, 50, 40, 3, 2, 1, 9, 8, 7];
    let plain = bmp(3, 8, 0, &palette, &[1, 0, 2, 0]);
    assert_eq!(codes("a.bmp", &plain), (3, colours.clone()));
    // Runs: one of 1, then two as they are, and the end.
    let runs = bmp(3, 8, 1, &palette, &[1, 1, 1, 0, 1, 2, 0, 1]);
    assert_eq!(codes("a.bmp", &runs), (3, colours.clone()));
    let four = bmp(3, 4, 0, &palette, &[0x10, 0x20, 0, 0]);
    assert_eq!(codes("a.bmp", &four), (3, colours));
    let single = bmp(3, 1, 0, &[[0; 4], [255, 255, 255, 0]], &[0xA0, 0, 0, 0]);
    assert_eq!(
        codes("a.bmp", &single).1,
        [255, 255, 255, 0, 0, 0, 255, 255, 255]
    );
    let true_colour = bmp(1, 24, 0, &[], &[1, 2, 3, 0]);
    assert_eq!(codes("a.bmp", &true_colour), (3, vec![3, 2, 1]));
    assert_eq!(codes("a.dib", &true_colour), (3, vec![3, 2, 1]));
    // Five bits for each colour: blue 1, green 2, red 31.
    let fifteen = bmp(2, 16, 0, &[], &[0x41, 0x7C, 0, 0]);
    assert_eq!(codes("a.bmp", &fifteen).1[..3], [255, 16, 8]);
}

#[test]
fn targas() {
    let head = |kind, map: u8, bits, upright: u8| {
        let colours = if map > 0 { 3 } else { 0 };
        vec![
            0,
            map,
            kind,
            0,
            0,
            colours,
            0,
            24 * map,
            0,
            0,
            0,
            0,
            3,
            0,
            1,
            0,
            bits,
            upright,
        ]
    };
    let palette: [u8; 9] = [1, 2, 3, 40, 50, 60, 7, 8, 9];
    let colours = vec![60, 50, 40, 3, 2, 1, 3, 2, 1];
    let mapped = [&head(1, 1, 8, 0x20)[..], &palette, &[1, 0, 0]].concat();
    assert_eq!(codes("a.tga", &mapped), (3, colours.clone()));
    // A packet of one as it is, then a run of two.
    let runs = [&head(9, 1, 8, 0x20)[..], &palette, &[0, 1, 0x81, 0]].concat();
    assert_eq!(codes("a.tga", &runs), (3, colours.clone()));
    let run = [&head(10, 0, 24, 0x20)[..], &[0, 40, 50, 60, 0x81, 1, 2, 3]].concat();
    assert_eq!(codes("a.tga", &run), (3, colours));
    let grey = [&head(3, 0, 8, 0x20)[..], &[9, 8, 7]].concat();
    assert_eq!(codes("a.tga", &grey), (1, vec![9, 8, 7]));
    // The first row may be the lowest: all the same for one row. From the right it is not.
    let mirrored = [&head(3, 0, 8, 0x30)[..], &[9, 8, 7]].concat();
    assert_eq!(codes("a.tga", &mirrored), (1, vec![7, 8, 9]));
    let fifteen = [&head(2, 0, 16, 0x20)[..], &[0x41, 0x7C, 0, 0, 0, 0]].concat();
    assert_eq!(codes("a.tga", &fifteen).1[..3], [255, 16, 8]);
}
