//! A small benchmark folder made here: its truth must come back, its faults must be named.
use crate::common::{encode, mask_png, rgb8};
use image::{ImageBuffer, ImageFormat, Rgb};
use normalight_core::Vec3;
use normalight_io::{
    IoError, ReadOptions, list_diligent_objects, pack_files, read_diligent_object, read_paths,
    write_files,
};
use std::io::{Read, Write};
use std::path::Path;

const WIDTH: usize = 6;
const HEIGHT: usize = 5;

/// One part of a MATLAB 5 file: type, size, content, padding to eight bytes.
fn element(kind: u32, content: &[u8]) -> Vec<u8> {
    let mut bytes = [kind.to_le_bytes(), (content.len() as u32).to_le_bytes()].concat();
    bytes.extend(content);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// A MATLAB 5 file with one array of doubles, stored columns first.
fn mat(name: &str, size: [i32; 3], value: impl Fn(usize, usize, usize) -> f64) -> Vec<u8> {
    let [rows, columns, planes] = size.map(|side| side as usize);
    let mut values = Vec::new();
    for plane in 0..planes {
        for column in 0..columns {
            for row in 0..rows {
                values.extend(value(row, column, plane).to_le_bytes());
            }
        }
    }
    let parts = [
        element(6, &[6, 0, 0, 0, 0, 0, 0, 0]),
        element(5, &size.map(i32::to_le_bytes).concat()),
        element(1, name.as_bytes()),
        element(9, &values),
    ];
    let mut file = vec![b' '; 124];
    file.extend([0x00, 0x01, b'I', b'M']);
    file.extend(element(14, &parts.concat()));
    file
}

/// Different in every pixel, so that rows and columns cannot be mixed up.
fn normal(row: usize, column: usize) -> Vec3 {
    Vec3::new(0.1 * column as f32, -0.2 * row as f32, 1.0).normalize()
}

fn truth() -> Vec<u8> {
    let size = [HEIGHT as i32, WIDTH as i32, 3];
    mat("Normal_gt", size, |row, column, plane| {
        f64::from(normal(row, column)[plane])
    })
}

fn write_object(folder: &Path) {
    let image = encode(&rgb8(WIDTH as u32, HEIGHT as u32), ImageFormat::Png);
    let mut files: Vec<(String, Vec<u8>)> = (1..=4)
        .map(|index| (format!("{index:03}.png"), image.clone()))
        .collect();
    let mask = mask_png(WIDTH as u32, HEIGHT as u32, |x, _| x > 0);
    files.extend([
        ("mask.png".to_owned(), mask),
        ("Normal_gt.mat".to_owned(), truth()),
        (
            "filenames.txt".to_owned(),
            b"001.png\n002.png\n003.png\n004.png\n".to_vec(),
        ),
        (
            "light_directions.txt".to_owned(),
            b"0 0 1\n1 0 1\n0 1 1\n-1 0 1\n".to_vec(),
        ),
        (
            "light_intensities.txt".to_owned(),
            b"1 1 1\n2 2 2\n3 3 3\n4 5 6\n".to_vec(),
        ),
    ]);
    write_files(folder, &files).unwrap();
}

#[test]
fn truth_comes_back() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("eggPNG");
    write_object(&folder);
    write_files(place.path(), &[("objects.txt", "eggPNG\n\n")]).unwrap();
    let listed = list_diligent_objects(place.path()).unwrap();
    assert_eq!(listed, std::slice::from_ref(&folder));
    std::fs::remove_file(place.path().join("objects.txt")).unwrap();
    assert_eq!(list_diligent_objects(place.path()).unwrap(), listed);
    assert_eq!(list_diligent_objects(&folder).unwrap(), listed);

    let object = read_diligent_object(&folder, None).unwrap();
    assert_eq!(object.name, "egg");
    assert_eq!(object.input.mask.count(), (WIDTH - 1) * HEIGHT);
    assert_eq!(object.lights.unwrap()[3].intensity, [4.0, 5.0, 6.0]);
    assert_eq!(object.normals_file.as_deref(), Some("Normal_gt.mat"));
    for (index, found) in object.normals.unwrap().normals().iter().enumerate() {
        let expected = normal(index / WIDTH, index % WIDTH);
        assert!((*found - expected).length() < 1e-6, "{index}");
    }
    let few = read_diligent_object(&folder, Some(3)).unwrap();
    assert_eq!(
        (few.input.picked, few.lights.unwrap().len()),
        (vec![0, 1, 2], 3)
    );
}

#[test]
fn faults_are_named() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("eggPNG");
    write_object(&folder);
    let read = || read_diligent_object(&folder, None).unwrap_err();
    let replace = |name: &str, bytes: Vec<u8>| write_files(&folder, &[(name, bytes)]).unwrap();
    for (name, size) in [
        ("Normal_gt", [5, 5, 3]),
        ("Normal_gt", [6, 5, 3]),
        ("other", [5, 6, 3]),
    ] {
        replace("Normal_gt.mat", mat(name, size, |_, _, _| 1.0));
        let error = read();
        assert!(
            matches!(&error, IoError::TruthFormat { name, .. } if name.ends_with("Normal_gt.mat"))
        );
    }
    replace("Normal_gt.mat", b"nothing".to_vec());
    assert!(matches!(read(), IoError::TruthFormat { .. }));
    std::fs::remove_file(folder.join("light_intensities.txt")).unwrap();
    assert!(
        matches!(read(), IoError::Read { name, .. } if name.ends_with("light_intensities.txt"))
    );
    let empty = tempfile::tempdir().unwrap();
    let error = list_diligent_objects(empty.path()).unwrap_err();
    assert!(matches!(error, IoError::TruthFormat { .. }));
    // A missing object must not hide the others: only reading it fails.
    write_files(place.path(), &[("objects.txt", "gone\neggPNG\n")]).unwrap();
    let listed = list_diligent_objects(place.path()).unwrap();
    assert_eq!(listed.len(), 2);
    let error = read_diligent_object(&listed[0], None).unwrap_err();
    assert!(matches!(error, IoError::Read { name, .. } if name.ends_with("gone")));
}

/// DiLiGenT10^2 and DiLiGenT-Pi keep their normals back, LUCES has no light directions and normals of its own name.
#[test]
fn truth_that_is_kept_back() {
    let place = tempfile::tempdir().unwrap();
    let [withheld, near] = ["BALL_POM", "Bell"].map(|name| place.path().join(name));
    for folder in [&withheld, &near] {
        write_object(folder);
        std::fs::remove_file(folder.join("Normal_gt.mat")).unwrap();
        // Pictures that are all the same are refused.
        for index in 1..=4u32 {
            let shade = |x: u32, y: u32| Rgb([((x * index + y * 3) * 9 + 20) as u8; 3]);
            let image = ImageBuffer::<Rgb<u8>, _>::from_fn(WIDTH as u32, HEIGHT as u32, shade);
            let image = encode(&image.into(), ImageFormat::Png);
            write_files(folder, &[(format!("{index:03}.png"), image)]).unwrap();
        }
    }
    for name in [
        "light_directions.txt",
        "light_intensities.txt",
        "filenames.txt",
    ] {
        std::fs::remove_file(near.join(name)).unwrap();
    }
    let codes =
        |normal: Vec3| (normal.to_array()).map(|v| ((v + 1.0) / 2.0 * 65_535.0).round() as u16);
    let normals = ImageBuffer::<Rgb<u16>, _>::from_fn(WIDTH as u32, HEIGHT as u32, |x, y| {
        Rgb(codes(normal(y as usize, x as usize)))
    });
    let normals = encode(&normals.into(), ImageFormat::Png);
    write_files(&near, &[("normals.png", normals)]).unwrap();
    let listed = list_diligent_objects(place.path()).unwrap();
    assert_eq!(listed, [withheld.clone(), near.clone()]);
    let object = read_diligent_object(&withheld, None).unwrap();
    assert!(object.normals.is_none() && object.normals_file.is_none());
    assert_eq!(object.lights.unwrap().len(), 4);
    let object = read_diligent_object(&near, None).unwrap();
    assert_eq!((object.input.stack.len(), object.lights), (4, None));
    assert_eq!(object.normals_file.as_deref(), Some("normals.png"));
    for (index, found) in object.normals.unwrap().normals().iter().enumerate() {
        let expected = normal(index / WIDTH, index % WIDTH);
        assert!((*found - expected).length() < 1e-4, "{index}");
    }
    // A file that says that it is the truth comes first.
    let flat = mat("Normal_gt", [5, 6, 3], |_, _, plane| {
        f64::from(plane as u8 / 2)
    });
    write_files(&near, &[("Normal_gt.mat", flat)]).unwrap();
    let object = read_diligent_object(&near, None).unwrap();
    assert_eq!(object.normals.unwrap().normals()[7], Vec3::Z);
}

/// Estimates go to servers in such archives.
#[test]
fn results_are_packed() {
    let place = tempfile::tempdir().unwrap();
    let files = [("a.mat", vec![1u8; 300]), ("b.mat", b"other".to_vec())];
    write_files(place.path(), &files).unwrap();
    pack_files(place.path(), "both.zip", &["a.mat", "b.mat"]).unwrap();
    let file = std::fs::File::open(place.path().join("both.zip")).unwrap();
    let mut archive = zip::ZipArchive::new(file).unwrap();
    for (name, content) in &files {
        let mut found = Vec::new();
        archive
            .by_name(name)
            .unwrap()
            .read_to_end(&mut found)
            .unwrap();
        assert_eq!(&found, content);
    }
    let error = pack_files(place.path(), "all.zip", &["a.mat", "c.mat"]).unwrap_err();
    assert!(matches!(error, IoError::Read { name, .. } if name.ends_with("c.mat")));
    assert!(!place.path().join("all.zip").exists());
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 3);
}

/// Whoever estimates from such a folder is told how far off the result is.
#[test]
fn truth_is_found_beside_photographs() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("eggPNG");
    write_object(&folder);
    let read = || read_paths(std::slice::from_ref(&folder), &ReadOptions::default()).unwrap();
    let input = read();
    let known = input.truth.unwrap();
    let object = read_diligent_object(&folder, None).unwrap();
    assert_eq!(Some(known.normals), object.normals);
    assert_eq!(input.plan.truth.as_deref(), Some("Normal_gt.mat"));
    assert!(
        input
            .plan
            .to_string()
            .contains("true normals: Normal_gt.mat")
    );
    assert!(input.plan.left_out.is_empty());
    // What cannot be compared with stops nothing, and is said.
    write_files(&folder, &[("Normal_gt.mat", &truth()[..200])]).unwrap();
    let input = read();
    assert!(input.truth.is_none() && input.plan.truth.is_none());
    assert!(
        input
            .plan
            .to_string()
            .contains("nothing is compared with it")
    );
}

/// MATLAB compresses by default.
#[test]
fn packed_truth() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("eggPNG");
    write_object(&folder);
    let plain = read_diligent_object(&folder, None).unwrap().normals;
    let mut packer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    packer.write_all(&truth()[128..]).unwrap();
    let packed = packer.finish().unwrap();
    let mut file = truth()[..128].to_vec();
    // Another variable before it, whose packed size is no multiple of eight.
    for content in [&[0x78, 0x9C, 1, 0, 0][..], &packed] {
        file.extend(15u32.to_le_bytes());
        file.extend((content.len() as u32).to_le_bytes());
        file.extend(content);
    }
    write_files(&folder, &[("Normal_gt.mat", &file)]).unwrap();
    assert_eq!(read_diligent_object(&folder, None).unwrap().normals, plain);
    for length in 0..file.len() {
        write_files(&folder, &[("Normal_gt.mat", &file[..length])]).unwrap();
        let error = read_diligent_object(&folder, None).unwrap_err();
        assert!(matches!(error, IoError::TruthFormat { .. }), "{length}");
    }
    // Promises far more than it may: nothing of that size is unpacked.
    let mut packer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    packer.write_all(&vec![0; 1 << 26]).unwrap();
    let bomb = packer.finish().unwrap();
    file.truncate(128);
    file.extend(15u32.to_le_bytes());
    file.extend((bomb.len() as u32).to_le_bytes());
    file.extend(&bomb);
    write_files(&folder, &[("Normal_gt.mat", &file)]).unwrap();
    assert!(matches!(
        read_diligent_object(&folder, None),
        Err(IoError::TruthFormat { .. })
    ));
}

/// Any damage to the truth gives an error or a map, never a panic.
#[test]
fn damaged_truth() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("eggPNG");
    write_object(&folder);
    let whole = truth();
    let path = folder.join("Normal_gt.mat");
    let read = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        let _ = read_diligent_object(&folder, None);
    };
    for at in 116..whole.len().min(240) {
        for value in [0, 1, 0x7F, 0x80, 0xFF, whole[at] ^ 1] {
            let mut bytes = whole.clone();
            bytes[at] = value;
            read(&bytes);
        }
        read(&whole[..at]);
    }
    for huge in [
        [0xFF; 4],
        [0xF8, 0xFF, 0xFF, 0xFF],
        [0xFF, 0xFF, 0xFF, 0x7F],
    ] {
        for at in (128..200).step_by(4) {
            let mut bytes = whole.clone();
            bytes[at..at + 4].copy_from_slice(&huge);
            read(&bytes);
        }
    }
}
