//! Sets as others publish them.
use crate::common::published::{entry, half_ball};
use crate::common::{encode, rgb8};
use image::{DynamicImage, ImageFormat, Rgb, RgbImage};
use normalight_core::Vec3;
use normalight_io::{
    IoError, PublishedEntry, PublishedPart, PublishedSet, PublishedWriter, write_files,
};
use std::path::Path;

/// A picture of normals: to the camera in the middle, nothing around.
fn normals_png(width: u32, height: u32) -> Vec<u8> {
    let image = RgbImage::from_fn(width, height, |x, y| match (x, y) {
        (0, _) => Rgb([127, 128, 127]),
        (_, 0) => Rgb([128, 128, 128]),
        (1, _) => Rgb([255, 128, 128]),
        _ => Rgb([128, 128, 255]),
    });
    encode(&DynamicImage::ImageRgb8(image), ImageFormat::Png)
}

/// A set without our extras, on Windows line ends.
fn hand_made(root: &Path) {
    let image = encode(&rgb8(8, 6), ImageFormat::Png);
    write_files(
        root,
        &[("train_mtrl.txt", "egg/wax\r\n\r\n"), ("val_mtrl.txt", "")],
    )
    .unwrap();
    let shape = root.join("Images/egg");
    write_files(&shape, &[("egg_normal.png", normals_png(8, 6))]).unwrap();
    let lights = b"a.png 0 0 2\r\nb.png 0.6 0 0.8\r\nc.png 0 -0.6 0.8 0.5\r\n".to_vec();
    let files = [
        ("a.png", image.clone()),
        ("b.png", image.clone()),
        ("c.png", image),
        ("egg_wax.txt", lights),
    ];
    write_files(&shape.join("wax"), &files).unwrap();
}

#[test]
fn a_set_without_extras() {
    let place = tempfile::tempdir().unwrap();
    hand_made(place.path());
    let set = PublishedSet::open(place.path()).unwrap();
    assert!(set.val().is_empty());
    let object = set.read(&set.train()[0]).unwrap();
    assert_eq!((object.stack.len(), object.mask.count()), (3, 7 * 5));
    assert_eq!(object.lights[0].direction, Vec3::Z);
    assert_eq!(object.lights[1].intensity, [1.0; 3]);
    assert_eq!(object.lights[2].intensity, [0.5; 3]);
    assert_eq!(object.normals.normals()[0], Vec3::ZERO);
    assert!((object.normals.normals()[9] - Vec3::X).length() < 0.01);
    assert_eq!(object.stack.images()[0].name, "a.png");
}

#[test]
fn faults_of_lists_are_named() {
    let place = tempfile::tempdir().unwrap();
    let open = || PublishedSet::open(place.path()).unwrap_err();
    assert!(matches!(open(), IoError::Read { name, .. } if name.ends_with("train_mtrl.txt")));
    let put = |name: &str, text: &str| write_files(place.path(), &[(name, text)]).unwrap();
    put("train_mtrl.txt", "\n\n");
    assert!(matches!(open(), IoError::SetFormat { name, .. } if name.ends_with("train_mtrl.txt")));
    for bad in [
        "egg",
        "egg/",
        "/wax",
        "../wax",
        "egg/..",
        "egg/../../x",
        "/etc/passwd",
        "egg\\wax",
        "egg/a\\b",
        "C:/wax",
        "egg/./x",
        "e\u{0}g/wax",
    ] {
        for list in ["train_mtrl.txt", "val_mtrl.txt"] {
            put("train_mtrl.txt", "egg/wax\n");
            put(list, &format!("egg/wax\n{bad}\n"));
            let error = open();
            let IoError::SetLine { name, line: 2, .. } = &error else {
                panic!("{bad:?}: {error}");
            };
            assert!(name.ends_with(list));
        }
        put("val_mtrl.txt", "");
    }
    assert!(PublishedEntry::new("..", "wax").is_err());
}

#[test]
fn faults_of_objects_are_named() {
    let place = tempfile::tempdir().unwrap();
    hand_made(place.path());
    let set = PublishedSet::open(place.path()).unwrap();
    let shape = place.path().join("Images/egg");
    let read = || set.read(&entry("egg", "wax")).unwrap_err();
    let lights = |text: &str| write_files(&shape.join("wax"), &[("egg_wax.txt", text)]).unwrap();

    let gone = set.read(&entry("egg", "gold")).unwrap_err();
    assert!(matches!(gone, IoError::Read { name, .. } if name.ends_with("egg_gold.txt")));
    write_files(&shape, &[("egg_normal.png", normals_png(8, 7))]).unwrap();
    assert!(matches!(read(), IoError::SetFormat { name, .. } if name.ends_with("egg_normal.png")));
    write_files(
        &shape,
        &[(
            "egg_normal.png",
            encode(&rgb8(8, 6).to_luma8().into(), ImageFormat::Png),
        )],
    )
    .unwrap();
    assert!(matches!(read(), IoError::SetFormat { .. }));
    write_files(&shape, &[("egg_normal.png", normals_png(1, 1))]).unwrap();
    read();
    std::fs::remove_file(shape.join("egg_normal.png")).unwrap();
    assert!(matches!(read(), IoError::Read { name, .. } if name.ends_with("egg_normal.png")));
    write_files(&shape, &[("egg_normal.png", normals_png(8, 6))]).unwrap();

    lights("a.png 0 0 1\nb.png 0 0 1\n");
    assert!(matches!(read(), IoError::TooFewImages { found: 2, .. }));
    lights("a.png 0 0 1\nb.png 0 0 1\nd.png 0 0 1\n");
    assert!(matches!(read(), IoError::Read { name, .. } if name.ends_with("d.png")));
    for bad in [
        "../../egg_normal.png 0 0 1",
        "/etc/passwd 0 0 1",
        "x\\a.png 0 0 1",
        "a.png 0 0",
        "a.png 0 0 0",
        "a.png 0 0 nan",
        "a.png 0 0 1 1 1",
        "a.png 0 0 1 1 0 1",
        "a.png",
        "a.png x y z",
    ] {
        lights(&format!("a.png 0 0 1\n{bad}\nb.png 0 0 1\n"));
        let error = read();
        let IoError::LightFormat { name, line: 2, .. } = &error else {
            panic!("{bad:?}: {error}");
        };
        assert!(name.ends_with("egg_wax.txt"));
    }
    lights("a.png 0 0 1\nb.png 0 0 1\nc.png 0 0 1\n");
    let small = encode(&rgb8(8, 5), ImageFormat::Png);
    write_files(&shape.join("wax"), &[("c.png", small)]).unwrap();
    assert!(read().to_string().contains("c.png"), "{}", read());
}

#[test]
fn smaller_objects() {
    let place = tempfile::tempdir().unwrap();
    let big = half_ball(96);
    let name = entry("ball", "gold");
    let mut writer = PublishedWriter::create(place.path()).unwrap();
    writer
        .write(&big.as_entry(&name), PublishedPart::Train)
        .unwrap();
    writer.finish().unwrap();
    let object = PublishedSet::open(place.path())
        .unwrap()
        .read(&name)
        .unwrap();
    for side in [48, 64, 96] {
        let small = object.resized(side).unwrap();
        let truth = half_ball(side);
        assert_eq!((small.stack.width(), small.stack.height()), (side, side));
        // Only pixels on the outline, of about 2.8 sides.
        let differing = small.mask.inside().iter().zip(truth.mask.inside());
        assert!(differing.filter(|(one, other)| one != other).count() <= side);
        let mut worst: f32 = 0.0;
        for (pixel, normal) in small.normals.normals().iter().enumerate() {
            assert_eq!(*normal != Vec3::ZERO, small.mask.inside()[pixel]);
            if small.mask.inside()[pixel] && truth.normals.normals()[pixel].z > 0.5 {
                worst = worst.max((normal - truth.normals.normals()[pixel]).length());
            }
        }
        assert!(worst < 0.03, "{worst}");
        // The light from the camera shades by the normal's z, without the black background.
        let pixels: Vec<usize> = (0..side * side).collect();
        let mut values = vec![[0.0; 3]; side * side];
        small.stack.linear_pixels(3, &pixels, &mut values);
        for (pixel, value) in values.iter().enumerate() {
            let expected = 0.9 * small.normals.normals()[pixel].z;
            assert!(
                (value[0] - expected).abs() < 0.05,
                "{pixel}: {value:?} {expected}"
            );
        }
    }
    assert!(matches!(object.resized(97), Err(IoError::SetFormat { .. })));
    assert!(object.resized(0).is_err());
    let other = tempfile::tempdir().unwrap();
    hand_made(other.path());
    let oblong = PublishedSet::open(other.path())
        .unwrap()
        .read(&entry("egg", "wax"))
        .unwrap();
    assert!(matches!(oblong.resized(4), Err(IoError::SetFormat { .. })));
}
