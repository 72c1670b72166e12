//! What in a tree is a capture.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
mod common;

use common::Place;
use normalight_batch::{BatchError, CaptureKind, Found, PassedOverReason, find_captures};
use std::fs;
use std::path::Path;

fn captures(found: &Found) -> Vec<(String, CaptureKind, Option<usize>)> {
    let captures = found.captures.iter();
    captures
        .map(|one| (one.name(), one.kind, one.photographs))
        .collect()
}

fn file(path: impl AsRef<Path>, bytes: &[u8]) {
    fs::create_dir_all(path.as_ref().parent().unwrap()).unwrap();
    fs::write(path, bytes).unwrap();
}

#[test]
fn folders_folders_in_them_archives_and_pages() {
    let place = Place::new();
    let root = place.root();
    place.capture("a/vase 10");
    place.capture("a/vase 2");
    place.capture("a/vase 2/detail/handle");
    for light in ["north", "south", "west"] {
        file(root.join("b/lamps").join(light).join("shot.jpg"), b"x");
    }
    file(root.join("c/one.zip"), b"PK\x03\x04 and so on");
    file(root.join("c/two.dat"), b"PK\x03\x04 and so on");
    file(root.join("d/photographs.zip"), b"PK\x03\x04 and so on");
    file(root.join("d/mask.png"), b"x");
    // An archive beside photographs is a copy of them, or something else of theirs.
    place.capture("e");
    file(root.join("e/all.zip"), b"PK\x03\x04 and so on");
    for (name, pages) in [("stack", 4), ("scan", 2)] {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut encoder = tiff::encoder::TiffEncoder::new(&mut bytes).unwrap();
        for _ in 0..pages {
            encoder
                .write_image::<tiff::encoder::colortype::Gray8>(8, 8, &[7; 64])
                .unwrap();
        }
        file(root.join("f").join(name).join("pages.tif"), bytes.get_ref());
        file(root.join("g").join(format!("{name}.tif")), bytes.get_ref());
    }
    file(root.join("f/third/single.tif"), b"II*\0");
    file(root.join("h/1.png"), b"x");
    file(root.join("h/notes.txt"), b"nothing");

    let found = find_captures(&root).unwrap();
    use CaptureKind::{Archive, Folder, OneInEachFolder, Pages};
    let expected = [
        ("a/vase 2", Folder, Some(3)),
        ("a/vase 2/detail/handle", Folder, Some(3)),
        ("a/vase 10", Folder, Some(3)),
        ("b/lamps", OneInEachFolder, Some(3)),
        ("c/one.zip", Archive, None),
        ("c/two.dat", Archive, None),
        ("d", Folder, None),
        ("e", Folder, Some(3)),
        ("f/stack/pages.tif", Pages, Some(4)),
        ("g/stack.tif", Pages, Some(4)),
    ];
    let expected = expected.map(|(name, kind, count)| (name.to_owned(), kind, count));
    assert_eq!(captures(&found), expected);
    let passed_over = found.passed_over.iter();
    let passed_over: Vec<String> = passed_over
        .map(|one| one.path.display().to_string())
        .collect();
    assert_eq!(passed_over, ["f/scan", "f/third", "h"]);
    let lines = found.lines(false).join("\n");
    assert!(
        lines.contains("e: 3 photographs\n  left out: all.zip"),
        "{lines}"
    );
    assert!(lines.contains("h: no capture: 1 photograph(s)"), "{lines}");
}

#[test]
fn results_and_hidden_folders_are_no_captures() {
    let place = Place::new();
    let vase = place.capture("vase");
    for (name, bytes) in common::by_hand(&vase) {
        // Even with a name that nobody would take for a map.
        let shots = ["1.png", "2.png", "3.png"].map(|shot| Path::new("vase/result").join(shot));
        for shot in shots {
            file(place.root().join(shot), &bytes);
        }
        file(place.root().join("vase/result").join(name), &bytes);
    }
    place.capture(".trash/vase");
    place.capture("__MACOSX/vase");
    let found = find_captures(&place.root()).unwrap();
    assert_eq!(
        captures(&found),
        [("vase".to_owned(), CaptureKind::Folder, Some(3))]
    );
    assert_eq!(found.passed_over.len(), 1);
    assert_eq!(found.passed_over[0].reason, PassedOverReason::Result);
}

#[test]
fn what_is_wrong_with_enough_photographs_is_their_estimates_affair() {
    let place = Place::new();
    let twice = place.capture("twice");
    for shot in ["1.jpg", "2.jpg", "3.jpg"] {
        file(twice.join(shot), b"x");
    }
    let listed = place.capture("listed");
    file(listed.join("names.txt"), b"1.png\nmissing.png\n");
    file(place.root().join("office/names.txt"), b"Ada\nGrace\n");
    let found = find_captures(&place.root()).unwrap();
    let names: Vec<String> = found.captures.iter().map(|one| one.name()).collect();
    assert_eq!(names, ["listed", "twice"]);
    assert_eq!(found.passed_over, []);
}

#[test]
fn the_root_itself_gets_a_name_of_its_own() {
    let place = Place::new();
    place.capture("");
    place.capture("captures/inner");
    let found = find_captures(&place.root()).unwrap();
    let results: Vec<_> = found
        .captures
        .iter()
        .map(|one| one.result.clone())
        .collect();
    assert_eq!(
        results,
        [Path::new("captures-itself"), Path::new("captures/inner")]
    );
    assert_eq!(found.captures[0].name(), ".");
}

#[test]
fn nothing_is_no_capture() {
    let place = Place::new();
    let missing = find_captures(&place.root()).unwrap_err();
    assert!(matches!(missing, BatchError::Read { .. }));
    file(place.root().join("a/b/1.png"), b"x");
    assert_eq!(find_captures(&place.root()).unwrap().captures, []);
    let given = find_captures(&place.root().join("a/b/1.png")).unwrap_err();
    assert!(matches!(given, BatchError::NotAFolder { .. }));
}

#[cfg(unix)]
#[test]
fn links_to_folders_are_said_and_not_followed() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    let vase = place.capture("vase");
    symlink(place.root(), vase.join("circle")).unwrap();
    symlink(&vase, place.root().join("again")).unwrap();
    symlink("nowhere", place.root().join("broken")).unwrap();
    // Links to files are files.
    fs::create_dir(place.root().join("linked")).unwrap();
    for shot in ["1.png", "2.png", "3.png"] {
        symlink(vase.join(shot), place.root().join("linked").join(shot)).unwrap();
    }
    let found = find_captures(&place.root()).unwrap();
    let names: Vec<String> = found.captures.iter().map(|one| one.name()).collect();
    assert_eq!(names, ["linked", "vase"]);
    let reasons: Vec<_> = found.passed_over.iter().map(ToString::to_string).collect();
    assert_eq!(reasons[0], "again: a link to a folder, not followed");
    assert!(reasons[1].starts_with("broken: cannot be looked at: "));
    assert_eq!(reasons[2], "vase/circle: a link to a folder, not followed");
}
