//! Captures in archives are what they are in folders.
use crate::common::archives::{ZipEntry, all_ways, gzip, tar_end, tar_entry, tar_of, zip, zip_of};
use crate::common::{file, mask_png, shaded_png, three};
use normalight_core::MaskSource;
use normalight_io::{
    IoError, LeftOut, LeftOutReason, MaskChoice, NamedBytes, Notice, ReadOptions, StackInput,
    UnpackedFiles, read_named, read_paths, read_stack, write_files,
};
use std::path::Path;

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &ReadOptions::default())
}

fn read_path(path: &Path) -> Result<StackInput, IoError> {
    read_paths(&[path.to_owned()], &ReadOptions::default())
}

/// Photographs, a list in another order, a mask, a map, and what systems leave behind.
fn capture(folder: &str) -> Vec<NamedBytes> {
    let named = |name: &str, bytes| file(&format!("{folder}{name}"), bytes);
    let mut files: Vec<NamedBytes> = (1..=5)
        .map(|k| named(&format!("IMG_{k}.png"), shaded_png(16, 12, k)))
        .collect();
    files.push(named("mask.png", mask_png(16, 12, |x, y| x > 3 && y > 2)));
    files.push(named("normal.png", shaded_png(16, 12, 9)));
    let list = b"IMG_4.png\r\nIMG_2.png\r\nIMG_5.png\r\nIMG_1.png\r\n";
    files.push(named("filenames.txt", list.to_vec()));
    files.push(named(
        "lights.lp",
        b"4\nIMG_1.png 0 0 1\nIMG_2.png 0 0.6 0.8\nIMG_4.png 0.6 0 0.8\nIMG_5.png -0.6 0 0.8\n"
            .to_vec(),
    ));
    files.push(named("._IMG_1.png", b"resources".to_vec()));
    files.push(named("Thumbs.db", b"small".to_vec()));
    files
}

fn is_helper(left: &LeftOut) -> bool {
    left.reason == LeftOutReason::System
}

fn check_equal(input: &StackInput, expected: &StackInput, what: &str) {
    assert_eq!(input.stack.images(), expected.stack.images(), "{what}");
    assert_eq!(input.mask.inside(), expected.mask.inside(), "{what}");
    assert_eq!(input.mask_source, expected.mask_source, "{what}");
    assert_eq!(input.file_names, expected.file_names, "{what}");
    assert_eq!(input.picked, expected.picked, "{what}");
    assert_eq!(input.plan.color, expected.plan.color, "{what}");
    let said = |input: &StackInput| -> Vec<Notice> {
        let notices = input.plan.notices.iter();
        let other = notices.filter(|notice| !matches!(notice, Notice::FromArchive { .. }));
        other.cloned().collect()
    };
    assert_eq!(said(input), said(expected), "{what}");
}

fn from_archive(input: &StackInput) -> (&str, &str) {
    let found = input.plan.notices.iter().find_map(|notice| match notice {
        Notice::FromArchive { archive, folder } => Some((archive.as_str(), folder.as_str())),
        _ => None,
    });
    found.expect("it is said that the files came out of an archive")
}

#[test]
fn an_archive_gives_what_the_folder_gives() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("capture");
    let plain: Vec<(String, Vec<u8>)> =
        capture("").into_iter().map(|f| (f.name, f.bytes)).collect();
    write_files(&folder, &plain).unwrap();
    let expected = read_path(&folder).unwrap();
    assert_eq!(
        expected.file_names,
        [4, 2, 5, 1].map(|k| format!("IMG_{k}.png"))
    );
    assert_eq!(expected.mask_source, MaskSource::File("mask.png".into()));
    let lights = expected
        .read_lights_path(&folder.join("lights.lp"))
        .unwrap();
    for inner in ["", "vase/", "a/b/"] {
        let mut files = capture(inner);
        files.push(file(&format!("__MACOSX/{inner}._IMG_1.png"), b"x".to_vec()));
        for (number, (name, bytes)) in all_ways(&files).into_iter().enumerate() {
            let what = format!("{name}, way {number}, folder {inner:?}");
            let input = read(vec![file(name, bytes.clone())]).unwrap();
            check_equal(&input, &expected, &what);
            assert_eq!(
                from_archive(&input),
                (name, inner.trim_end_matches('/')),
                "{what}"
            );
            assert_eq!(
                input
                    .plan
                    .left_out
                    .iter()
                    .filter(|&left| is_helper(left))
                    .count(),
                3
            );
            write_files(place.path(), &[(name, &bytes)]).unwrap();
            let path = place.path().join(name);
            check_equal(&read_path(&path).unwrap(), &expected, &what);
            // Lights and masks may be given out of it.
            let given = path.join(inner).join("lights.lp");
            assert_eq!(input.read_lights_path(&given).unwrap(), lights, "{what}");
            let mask = MaskChoice::File(read_named(&path.join(inner).join("mask.png")).unwrap());
            let options = ReadOptions {
                mask,
                ..ReadOptions::default()
            };
            let masked = read_paths(std::slice::from_ref(&path), &options).unwrap();
            assert_eq!(masked.mask.inside(), expected.mask.inside());
        }
    }
    let error = read_named(&place.path().join("capture.zip/none.png")).unwrap_err();
    assert!(matches!(&error, IoError::Read { .. }), "{error}");
    assert!(error.to_string().contains("none.png"), "{error}");
}

#[test]
fn only_picked_images_are_read() {
    // A damaged photograph that is not picked does no harm, as in a folder.
    let mut entries: Vec<ZipEntry> = (1..=9)
        .map(|k| ZipEntry::stored(&format!("{k}.png"), &shaded_png(16, 12, k)))
        .collect();
    entries[1].crc ^= 1;
    let options = ReadOptions {
        images: Some(3),
        ..ReadOptions::default()
    };
    let archive = file("a.zip", zip(&entries));
    let input = read_stack(vec![archive.clone()], &options).unwrap();
    assert_eq!(
        (input.picked.as_slice(), input.file_names.len()),
        (&[0, 2, 5][..], 9)
    );
    let error = read(vec![archive]).unwrap_err();
    assert!(matches!(&error, IoError::Archive { .. }), "{error}");
}

#[test]
fn content_decides_over_the_extension() {
    for (name, bytes, said) in [
        ("capture.bin", zip_of(&three(16, 12)), true),
        ("capture", tar_of(&three(16, 12)), true),
        ("capture.zip", gzip(&tar_of(&three(16, 12))), true),
        ("CAPTURE.TGZ", gzip(&tar_of(&three(16, 12))), false),
    ] {
        let place = tempfile::tempdir().unwrap();
        write_files(place.path(), &[(name, &bytes)]).unwrap();
        // Given by its name, and lying in a folder alone.
        for path in [place.path().join(name), place.path().to_owned()] {
            let input = read_path(&path).unwrap();
            assert_eq!(input.stack.len(), 3);
            let is_said = input.plan.notices.iter().any(|notice| {
                matches!(notice, Notice::ContentOverExtension { file, .. } if file == name)
            });
            assert_eq!(is_said, said, "{name}");
        }
    }
}

#[test]
fn names_of_all_systems() {
    let shots: Vec<Vec<u8>> = (1..=4).map(|k| shaded_png(16, 12, k)).collect();
    let entry = |name: &[u8], flags: u16, k: usize| ZipEntry {
        name: name.to_vec(),
        flags,
        ..ZipEntry::stored("", &shots[k])
    };
    // ü in the code page of DOS, in UTF-8 with and without its flag, and backslashes.
    let input = read(vec![file(
        "a.zip",
        zip(&[
            entry(b"B\x81ste\\1.png", 0, 0),
            entry("B\u{fc}ste/2.png".as_bytes(), 1 << 11, 1),
            entry("B\u{fc}ste/3.png".as_bytes(), 0, 2),
            entry("./B\u{fc}ste//4.png".as_bytes(), 0, 3),
        ]),
    )])
    .unwrap();
    assert_eq!(input.file_names, ["1.png", "2.png", "3.png", "4.png"]);
    assert_eq!(from_archive(&input).1, "B\u{fc}ste");
    // Beyond a hundred bytes, and in Latin-1.
    let long = "x".repeat(150);
    let mut tar = tar_of(&[
        file(&format!("{long}/1.png"), shots[0].clone()),
        file(&format!("{long}/2.png"), shots[1].clone()),
    ]);
    tar.truncate(tar.len() - tar_end().len());
    tar.extend(tar_entry(b"./B\xFCste.png", b'0', &shots[2]));
    tar.extend(tar_end());
    let input = read(vec![file("a.tar", tar)]).unwrap();
    assert_eq!(input.file_names, ["B\u{fc}ste.png", "1.png", "2.png"]);
}

#[test]
fn the_page_gets_the_same_files() {
    let mut files = capture("v/");
    files.push(file("old/1.png", shaded_png(16, 12, 3)));
    let archive = file("a.tgz", gzip(&tar_of(&files)));
    let mut unpacked = UnpackedFiles::open(archive.clone()).unwrap().unwrap();
    let given: Vec<NamedBytes> = (0..unpacked.names().len())
        .map(|index| unpacked.take(index).unwrap())
        .collect();
    assert_eq!(given.len(), files.len() - 1);
    check_equal(
        &read(given).unwrap(),
        &read(vec![archive]).unwrap(),
        "unpacked",
    );
    assert!(
        UnpackedFiles::open(file("1.png", shaded_png(16, 12, 1)))
            .unwrap()
            .is_none()
    );
}
