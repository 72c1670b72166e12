//! Photographs that are the pages of one TIFF.
use crate::common::{encode, file, mask_png};
use image::{DynamicImage, ImageFormat, RgbImage};
use normalight_core::{MaskSource, Samples};
use normalight_io::{
    NamedBytes, Notice, ReadOptions, StackInput, UnpackedFiles, is_archive, read_stack,
};
use std::io::Cursor;
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, colortype};

const SIZE: (u32, u32) = (24, 18);

fn page(turn: usize) -> RgbImage {
    RgbImage::from_fn(SIZE.0, SIZE.1, |x, y| {
        let along = [x, y, 40 - x, 40 - y][turn % 4];
        image::Rgb([30 + 4 * along as u8, 20 + 5 * along as u8, 90 - along as u8])
    })
}

/// Written by the library's encoder, in several strips a page.
fn paged(count: usize, compression: Compression) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes)
        .unwrap()
        .with_compression(compression);
    for turn in 0..count {
        let mut image = encoder
            .new_image::<colortype::RGB8>(SIZE.0, SIZE.1)
            .unwrap();
        image.rows_per_strip(5).unwrap();
        image.write_data(page(turn).as_raw()).unwrap();
    }
    bytes.into_inner()
}

fn read(files: Vec<NamedBytes>) -> StackInput {
    read_stack(files, &ReadOptions::default()).unwrap()
}

fn said(input: &StackInput) -> bool {
    let expected = Notice::PagesAsPhotographs {
        file: "stack.tif".to_owned(),
        pages: input.stack.len(),
    };
    input.plan.notices.contains(&expected)
}

#[test]
fn pages_are_what_files_of_one_page_are() {
    let singles = (0..4).map(|turn| {
        let png = encode(&DynamicImage::ImageRgb8(page(turn)), ImageFormat::Png);
        file(&format!("{turn}.png"), png)
    });
    let expected = read(singles.collect());
    for compression in [
        Compression::Uncompressed,
        Compression::Lzw,
        Compression::Deflate(DeflateLevel::Fast),
        Compression::Packbits,
    ] {
        let input = read(vec![file("stack.tif", paged(4, compression))]);
        assert!(said(&input), "{:?}", input.plan.notices);
        let names = ["stack_page1.tif", "stack_page4.tif"];
        assert_eq!([&input.file_names[0], &input.file_names[3]], names);
        for (found, expected) in input.stack.images().iter().zip(expected.stack.images()) {
            assert_eq!(found.samples, expected.samples);
        }
    }
}

#[test]
fn what_lies_beside_them_counts() {
    let files = vec![
        file("stack.tif", paged(5, Compression::Lzw)),
        file("mask.png", mask_png(SIZE.0, SIZE.1, |x, y| x > 3 && y > 2)),
    ];
    let input = read(files);
    assert_eq!(input.stack.len(), 5);
    assert_eq!(input.mask_source, MaskSource::File("mask.png".to_owned()));
    assert!(said(&input));
}

#[test]
fn a_page_that_shows_them_before_has_them_too() {
    let bytes = paged(3, Compression::Lzw);
    assert!(is_archive("stack.tif", &bytes[..512.min(bytes.len())]));
    let unpacked = UnpackedFiles::open(file("stack.tif", bytes))
        .unwrap()
        .unwrap();
    assert_eq!(unpacked.names().len(), 3);
    for count in 1..3 {
        let few = file("stack.tif", paged(count, Compression::Lzw));
        assert!(UnpackedFiles::open(few).unwrap().is_none());
    }
}

/// ImageJ writes large stacks as one page with the others behind it, which only its description tells.
#[test]
fn stacks_of_imagej_have_one_directory() {
    let grey = |turn: usize| DynamicImage::ImageRgb8(page(turn)).to_luma8();
    let text = b"ImageJ=1.53t\nimages=4\nslices=4\n\0";
    let pixels: Vec<Vec<u8>> = (0..4).map(|turn| grey(turn).into_raw()).collect();
    // Tag, kind (2 text, 4 a number), count, value or place.
    let text_at = 8 + 2 + 12 * 8 + 4;
    let entries = [
        [256, 4, 1, SIZE.0],
        [257, 4, 1, SIZE.1],
        [258, 4, 1, 8],
        [259, 4, 1, 1],
        [262, 4, 1, 1],
        [270, 2, text.len() as u32, text_at],
        [273, 4, 1, text_at + text.len() as u32],
        [279, 4, 1, SIZE.0 * SIZE.1],
    ];
    let mut bytes = b"II*\0\x08\0\0\0\x08\0".to_vec();
    for [tag, kind, count, value] in entries {
        bytes.extend((tag as u16).to_le_bytes());
        bytes.extend((kind as u16).to_le_bytes());
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes.extend(text);
    pixels.iter().for_each(|page| bytes.extend(page));
    let input = read(vec![file("stack.tif", bytes)]);
    assert!(said(&input));
    let again = |notice: &&Notice| matches!(notice, Notice::SeveralPages { .. });
    assert_eq!(input.plan.notices.iter().find(again), None);
    for (image, page) in input.stack.images().iter().zip(pixels) {
        assert_eq!(image.samples, Samples::U8(page));
    }
}

#[test]
fn pages_of_several_sizes_are_one_picture() {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    for size in [24u32, 12, 6] {
        let data = vec![90; (size * size) as usize];
        encoder
            .write_image::<colortype::Gray8>(size, size, &data)
            .unwrap();
    }
    let pyramid = file("stack.tif", bytes.into_inner());
    let error = read_stack(vec![pyramid], &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("1 image(s)"), "{error}");
}
