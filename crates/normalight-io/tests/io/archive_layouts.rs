//! Captures in archives among other things.
use crate::common::archives::{ZipEntry, gzip, tar_end, tar_entry, tar_of, zip, zip_of};
use crate::common::{file, mask_png, shaded_png, three};
use normalight_core::MaskSource;
use normalight_io::{
    IoError, LeftOut, LeftOutReason, NamedBytes, Notice, Order, ReadOptions, StackInput,
    read_paths, read_stack, write_files,
};
use std::path::Path;

fn read(files: Vec<NamedBytes>) -> Result<StackInput, IoError> {
    read_stack(files, &ReadOptions::default())
}

fn read_path(path: &Path) -> Result<StackInput, IoError> {
    read_paths(&[path.to_owned()], &ReadOptions::default())
}

fn from_archive(input: &StackInput) -> (&str, &str) {
    let found = input.plan.notices.iter().find_map(|notice| match notice {
        Notice::FromArchive { archive, folder } => Some((archive.as_str(), folder.as_str())),
        _ => None,
    });
    found.expect("it is said that the files came out of an archive")
}

#[test]
fn a_project_with_several_folders() {
    let shots = |folder: &str, seed: u32| -> Vec<NamedBytes> {
        let name = |k| format!("{folder}_{k}.png");
        (1..=4)
            .map(|k| file(&name(k), shaded_png(16, 12, seed + k)))
            .collect()
    };
    let mut files = shots("Stela/jpeg-exports/Stela", 0);
    files.push(file(
        "Stela/finished-files/preview.png",
        shaded_png(16, 12, 9),
    ));
    files.push(file("Stela/original-captures/a.NEF", b"raw".to_vec()));
    files.push(file("Stela/assembly-files/Stela.lp", b"1\n".to_vec()));
    files.push(file(
        "Stela/results/mask.png",
        mask_png(16, 12, |x, _| x > 8),
    ));
    let input = read(vec![file("stela.zip", zip_of(&files))]).unwrap();
    assert_eq!(
        input.file_names,
        [1, 2, 3, 4].map(|k| format!("Stela_{k}.png"))
    );
    assert_eq!(from_archive(&input), ("stela.zip", "Stela/jpeg-exports"));
    assert_ne!(input.mask_source, MaskSource::File("mask.png".into()));
    let elsewhere: Vec<&str> = input
        .plan
        .left_out
        .iter()
        .filter(|left| left.reason == LeftOutReason::OtherFolder)
        .map(|left| left.file.as_str())
        .collect();
    assert_eq!(
        elsewhere,
        ["Stela/finished-files/preview.png", "Stela/results/mask.png"]
    );
    assert!(
        input.plan.to_string().contains("Stela/jpeg-exports"),
        "{}",
        input.plan
    );

    // Two captures: neither is guessed, and either can be given.
    let mut two = shots("bear/bear", 0);
    two.extend(shots("cat/cat", 4));
    let place = tempfile::tempdir().unwrap();
    write_files(place.path(), &[("two.zip", zip_of(&two))]).unwrap();
    let path = place.path().join("two.zip");
    let error = read_path(&path).unwrap_err();
    assert!(
        matches!(&error, IoError::PhotographsBelow { below, .. } if below == "4 in bear, 4 in cat"),
        "{error}"
    );
    let cat = read_path(&path.join("cat")).unwrap();
    assert_eq!(cat.file_names, [1, 2, 3, 4].map(|k| format!("cat_{k}.png")));
    assert!(matches!(
        read_path(&path.join("dog")),
        Err(IoError::Read { .. })
    ));

    // One shot in each folder.
    let apart: Vec<NamedBytes> = (1..=4)
        .map(|k| file(&format!("light{k}/IMG.png"), shaded_png(16, 12, k)))
        .collect();
    let input = read(vec![file("apart.tgz", gzip(&tar_of(&apart)))]).unwrap();
    assert_eq!(input.picked_names()[3], "light4/IMG.png");
}

#[test]
fn archives_beside_other_files() {
    let archive = file("photos.zip", zip_of(&three(16, 12)));
    let mask = file("mask.png", mask_png(16, 12, |x, _| x > 3));
    let list = file("names.txt", b"10.png\n2.png\n1.png\n".to_vec());
    // With a mask and a list beside it, it is opened.
    let input = read(vec![archive.clone(), mask.clone(), list]).unwrap();
    assert_eq!(input.file_names, ["10.png", "2.png", "1.png"]);
    assert_eq!(input.mask_source, MaskSource::File("mask.png".into()));
    assert_eq!(input.plan.order, Order::List("names.txt".into()));
    assert_eq!(from_archive(&input), ("photos.zip", ""));
    // Beside photographs it is not, and that is said.
    let mut files = three(16, 12);
    files.push(archive.clone());
    let input = read(files).unwrap();
    assert_eq!(input.stack.len(), 3);
    let left = LeftOut {
        file: "photos.zip".into(),
        reason: LeftOutReason::Archive,
    };
    assert_eq!(input.plan.left_out, [left]);
    assert!(
        input.plan.to_string().contains("photos.zip (an archive"),
        "{}",
        input.plan
    );
    // On a disk as in memory.
    let place = tempfile::tempdir().unwrap();
    let both = [(&archive.name, &archive.bytes), (&mask.name, &mask.bytes)];
    write_files(place.path(), &both).unwrap();
    let given = both.map(|(name, _)| place.path().join(name));
    for paths in [&given[..], &[place.path().to_owned()]] {
        let input = read_paths(paths, &ReadOptions::default()).unwrap();
        assert_eq!((input.stack.len(), input.mask_label()), (3, "mask.png"));
    }
    // Two archives with a capture each are two captures.
    let other = file("other.zip", zip_of(&three(16, 12)));
    let error = read(vec![archive, other]).unwrap_err().to_string();
    assert!(error.contains("3 in other.zip, 3 in photos.zip"), "{error}");
}

#[test]
fn links_and_inner_archives_are_named() {
    let mut tar = tar_of(&three(16, 12));
    tar.truncate(tar.len() - tar_end().len());
    tar.extend(tar_entry(b"11.png", b'2', b""));
    tar.extend(tar_entry(b"more", b'5', b""));
    tar.extend(tar_entry(b"more.zip", b'0', &zip_of(&three(16, 12))));
    tar.extend(tar_end());
    let mut entries: Vec<ZipEntry> = three(16, 12)
        .iter()
        .map(|shot| ZipEntry::deflated(&shot.name, &shot.bytes))
        .collect();
    entries.push(ZipEntry {
        mode: 0o120_777,
        ..ZipEntry::stored("11.png", b"1.png")
    });
    entries.push(ZipEntry::stored("more/", b""));
    entries.push(ZipEntry::stored("more.zip", &zip_of(&three(16, 12))));
    for archive in [file("a.tar", tar), file("a.zip", zip(&entries))] {
        let input = read(vec![archive]).unwrap();
        assert_eq!(input.stack.len(), 3);
        let left = |name: &str| {
            let mut all = input.plan.left_out.iter();
            all.find(|left| left.file == name)
                .map(|left| left.reason.clone())
        };
        assert_eq!(left("11.png"), Some(LeftOutReason::Link));
        assert_eq!(left("more.zip"), Some(LeftOutReason::Archive));
        assert_eq!(input.plan.left_out.len(), 2);
    }
}
