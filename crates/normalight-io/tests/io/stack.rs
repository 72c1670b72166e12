//! Whole stacks: what is found, what is refused.
use crate::common::{encode, file, mask_png, rgb8, three};
use image::{DynamicImage, ImageFormat, Rgb32FImage, RgbImage};
use normalight_core::{CoreError, MaskSource};
use normalight_io::{IoError, MaskChoice, NamedBytes, Notice, ReadOptions, StackInput, read_stack};

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &ReadOptions::default())
}

#[test]
fn order_and_mask_sources() {
    let mut files = three(16, 12);
    files.reverse();
    let input = read(files.clone()).unwrap();
    let names: Vec<_> = input
        .stack
        .images()
        .iter()
        .map(|image| image.name.as_str())
        .collect();
    assert_eq!(names, ["1.png", "2.png", "10.png"]);
    assert_eq!(
        (input.mask_source, input.file_names.len()),
        (MaskSource::Guessed, 3)
    );

    let transparent = {
        let mut image = rgb8(16, 12).into_rgba8();
        image.get_pixel_mut(0, 0).0[3] = 0;
        encode(&DynamicImage::ImageRgba8(image), ImageFormat::Png)
    };
    files[2].bytes = transparent;
    let input = read(files.clone()).unwrap();
    assert_eq!(
        (input.mask_source, input.mask.count()),
        (MaskSource::Alpha, 16 * 12 - 1)
    );

    files.push(file("obj/Mask.png", mask_png(16, 12, |x, _| x > 3)));
    let input = read(files.clone()).unwrap();
    assert_eq!(input.mask_source, MaskSource::File("Mask.png".into()));
    assert_eq!(input.mask.count(), 12 * 12);

    let mut options = ReadOptions {
        mask: MaskChoice::WholeFrame,
        ..ReadOptions::default()
    };
    let input = read_stack(files.clone(), &options).unwrap();
    assert_eq!(
        (input.mask_source, input.mask.count()),
        (MaskSource::WholeFrame, 192)
    );
    options.mask = MaskChoice::File(file("mine.png", mask_png(16, 12, |x, y| x + y == 0)));
    let input = read_stack(files, &options).unwrap();
    assert_eq!(
        (input.mask_source, input.mask.count()),
        (MaskSource::File("mine.png".into()), 1)
    );
}

#[test]
fn lists_and_subsets() {
    let mut files = three(16, 12);
    files.push(file("4.png", files[0].bytes.clone()));
    files.push(file("names.txt", b"10.png\n1.png\n4.png\n2.png\n".to_vec()));
    let options = ReadOptions {
        images: Some(3),
        ..ReadOptions::default()
    };
    let input = read_stack(files.clone(), &options).unwrap();
    let names: Vec<_> = input
        .stack
        .images()
        .iter()
        .map(|image| image.name.as_str())
        .collect();
    assert_eq!(
        (names, input.picked, input.file_names.len()),
        (vec!["10.png", "1.png", "4.png"], vec![0, 1, 2], 4)
    );
    let options = ReadOptions {
        images: Some(2),
        ..ReadOptions::default()
    };
    let error = read_stack(files.clone(), &options).unwrap_err();
    assert!(
        matches!(&error, IoError::TooFewRequested { name, found: 2, expected: 3 } if name == "names.txt")
    );
    files.last_mut().unwrap().bytes = b"10.png\nmissing.png".to_vec();
    let error = read(files).unwrap_err();
    assert!(matches!(&error, IoError::ListedFileMissing { list, entry }
        if list == "names.txt" && entry == "missing.png"));
}

#[test]
fn bad_stacks_are_explained() {
    assert!(matches!(
        read(vec![]),
        Err(IoError::TooFewImages { found: 0, .. })
    ));
    assert!(matches!(
        read(three(16, 12)[..2].to_vec()),
        Err(IoError::TooFewImages { found: 2, .. })
    ));

    let mut files = three(16, 12);
    files[1].bytes = encode(&rgb8(12, 16), ImageFormat::Png);
    let error = read(files).unwrap_err();
    assert!(
        matches!(&error, IoError::Core(CoreError::SizeMismatch { name, .. }) if name == "2.png")
    );

    assert!(matches!(
        read(three(1, 1)),
        Err(IoError::Core(CoreError::TooSmall { width: 1, .. }))
    ));

    let black = encode(
        &DynamicImage::ImageRgb8(RgbImage::new(8, 8)),
        ImageFormat::Png,
    );
    let files = ["1.png", "2.png", "3.png"].map(|name| file(name, black.clone()));
    assert!(matches!(
        read(files.to_vec()),
        Err(IoError::Core(CoreError::AllBlack { images: 3 }))
    ));

    let mut files = three(16, 12);
    files.push(file("mask.png", mask_png(16, 12, |_, _| false)));
    let error = read(files.clone()).unwrap_err();
    assert!(matches!(&error, IoError::Core(CoreError::EmptyMask { name }) if name == "mask.png"));
    files[3].bytes = mask_png(12, 16, |_, _| true);
    let error = read(files).unwrap_err();
    assert!(
        matches!(&error, IoError::Core(CoreError::MaskSize { name, .. }) if name == "mask.png")
    );
}

/// Renderers write NaN where there is nothing.
#[test]
fn nan_in_exr_is_black_and_said() {
    for bad in [f32::NAN, -f32::NAN] {
        let mut images = (1..=3).map(|k| {
            Rgb32FImage::from_fn(24, 24, |x, y| {
                image::Rgb([0.1 + 0.01 * (x * k + y) as f32; 3])
            })
        });
        let mut images: [Rgb32FImage; 3] = std::array::from_fn(|_| images.next().unwrap());
        images[1].get_pixel_mut(3, 3).0[1] = bad;
        let exr =
            |image: Rgb32FImage| encode(&DynamicImage::ImageRgb32F(image), ImageFormat::OpenExr);
        let files = images.map(exr).into_iter().zip(["1.exr", "2.exr", "3.exr"]);
        let input = read(files.map(|(bytes, name)| file(name, bytes)).collect()).unwrap();
        assert!(input.plan.notices.contains(&Notice::NotNumbers {
            file: "2.exr".into(),
            samples: 1
        }));
        let mut pixel = [[0.0; 3]];
        input.stack.linear_pixels(1, &[3 * 24 + 3], &mut pixel);
        assert!(pixel[0][1] == 0.0 && pixel[0][0] > 0.1);
    }
}

#[test]
fn foreign_files_are_ignored_or_named() {
    let mut files = three(16, 12);
    files.push(file("notes.md", b"not an image".to_vec()));
    files.push(file("huge.txt", vec![b'x'; 5 << 20]));
    files.push(file(".hidden.png", b"not an image".to_vec()));
    assert_eq!(read(files.clone()).unwrap().file_names.len(), 3);
    let error = read(files[3..].to_vec()).unwrap_err();
    assert!(matches!(&error, IoError::NotAnImage { name, .. } if name == "notes.md"));
    let photographs = ["a.heic", "b.heic", "c.heic"].map(|name| file(name, vec![1; 99]));
    let error = read(photographs.to_vec()).unwrap_err();
    assert!(matches!(&error, IoError::NotAnImage { name, .. } if name == "a.heic"));
    files[1].bytes = b"not an image".to_vec();
    let error = read(files).unwrap_err();
    assert!(matches!(&error, IoError::NotAnImage { name, .. } if name == "2.png"));
}

#[test]
fn folders_of_a_dropped_tree_do_not_count() {
    let mut files = three(16, 12);
    for file in &mut files {
        file.name = format!("normal_tests/ball/{}", file.name);
    }
    assert_eq!(
        read(files).unwrap().picked_names(),
        ["1.png", "2.png", "10.png"]
    );
}
