//! Archives that are refused, in words; and damaged ones, which never panic.
use crate::common::archives::{ZipEntry, all_ways, gzip, tar_end, tar_entry, tar_of, zip, zip_of};
use crate::common::{file, shaded_png, three};
use normalight_core::StackImage;
use normalight_io::{
    IoError, MAX_ARCHIVE_FILES, NamedBytes, ReadOptions, read_paths, read_stack, write_files,
};
use std::collections::BTreeSet;

fn read(name: &str, bytes: Vec<u8>) -> Result<usize, IoError> {
    let input = read_stack(vec![file(name, bytes)], &ReadOptions::default());
    input.map(|input| input.stack.len())
}

/// The words of an error about an archive, which must name it.
fn refused(name: &str, bytes: Vec<u8>) -> String {
    let error = read(name, bytes).unwrap_err();
    assert!(
        matches!(&error, IoError::Archive { name: named, .. } if named == name),
        "{error}"
    );
    error.to_string()
}

/// Three photographs, and an entry more.
fn with(entry: ZipEntry) -> Vec<u8> {
    let shots = three(16, 12);
    let shots = shots
        .iter()
        .map(|shot| ZipEntry::deflated(&shot.name, &shot.bytes));
    zip(&shots.chain([entry]).collect::<Vec<_>>())
}

fn shot(name: &str) -> ZipEntry {
    ZipEntry::deflated(name, &shaded_png(16, 12, 7))
}

#[test]
fn encryption_and_unknown_compression() {
    assert_eq!(read("a.zip", with(shot("11.png"))).unwrap(), 4);
    let encrypted = ZipEntry {
        flags: 1,
        ..shot("11.png")
    };
    let words = refused("a.zip", with(encrypted.clone()));
    assert!(
        words.contains("encrypted") && words.contains("11.png") && words.contains("password"),
        "{words}"
    );
    for (method, name) in [(9, "Deflate64"), (14, "LZMA"), (77, "unknown")] {
        let words = refused(
            "a.zip",
            with(ZipEntry {
                method,
                ..shot("11.png")
            }),
        );
        assert!(
            words.contains("11.png") && words.to_lowercase().contains(&name.to_lowercase()),
            "{words}"
        );
    }
    // Of what nobody reads it does not matter.
    let helper = ZipEntry {
        name: b"__MACOSX/._1.png".to_vec(),
        ..encrypted
    };
    assert_eq!(read("a.zip", with(helper)).unwrap(), 3);
}

#[test]
fn paths_that_lead_elsewhere() {
    for (path, shown) in [
        ("../../11.png", "../../11.png"),
        ("/etc/11.png", "/etc/11.png"),
        ("a\\..\\..\\11.png", "a\\\\..\\\\..\\\\11.png"),
        ("C:\\11.png", "C:\\\\11.png"),
        ("../\u{1b}[31m.png", "../\\u{1b}[31m.png"),
    ] {
        let words = refused("a.zip", with(shot(path)));
        assert!(
            words.contains(shown) && !words.contains('\u{1b}'),
            "{words}"
        );
        let mut tar = tar_entry(path.as_bytes(), b'0', b"x");
        tar.extend(tar_of(&three(16, 12)));
        let words = refused("a.tar.gz", gzip(&tar));
        assert!(
            words.contains(shown) && !words.contains('\u{1b}'),
            "{words}"
        );
    }
}

#[test]
fn names_twice_and_nothing() {
    let words = refused("a.zip", with(shot("2.png")));
    assert!(words.contains("two files of one name"), "{words}");
    // The same once backslashes are slashes.
    let both = zip(&[shot("a/1.png"), shot("a\\1.png"), shot("2.png")]);
    let words = refused("a.zip", both);
    assert!(
        words.contains("two files of one name") && words.contains("a/1.png"),
        "{words}"
    );
    let mut twice = three(16, 12);
    twice.push(twice[0].clone());
    let words = refused("a.tar", tar_of(&twice));
    assert!(
        words.contains("two files of one name") && words.contains("1.png"),
        "{words}"
    );
    for (name, bytes) in [
        ("a.zip", zip(&[])),
        ("a.zip", zip(&[ZipEntry::stored("photos/", b"")])),
        ("a.tar.gz", gzip(&tar_end())),
        (
            "a.tar",
            [tar_entry(b"photos/", b'5', b""), tar_end()].concat(),
        ),
    ] {
        let words = refused(name, bytes);
        assert!(words.contains("no files"), "{words}");
    }
    let error = read("a.zip", zip(&[ZipEntry::stored("notes.txt", b"nothing")])).unwrap_err();
    assert!(
        matches!(&error, IoError::TooFewImages { name, found: 0, .. } if name == "a.zip"),
        "{error}"
    );
}

#[test]
fn bombs() {
    // Zeros, a thousand of them in a byte.
    let zeros = vec![0; 64 << 20];
    let bomb = ZipEntry::deflated("11.png", &zeros);
    assert!(bomb.packed.len() < 1 << 17);
    let words = refused("bomb.zip", with(bomb.clone()));
    assert!(words.contains("unpack to more than"), "{words}");
    let mut files = three(16, 12);
    files.push(file("11.png", zeros));
    let words = refused("bomb.tgz", gzip(&tar_of(&files)));
    assert!(words.contains("unpack to more than"), "{words}");
    // One that says to be small unpacks to no more than it says.
    let lying = ZipEntry {
        size: 1000,
        ..bomb.clone()
    };
    let words = refused("bomb.zip", with(lying));
    assert!(words.contains("damage"), "{words}");
    // One that says to be large is not believed either: nothing is allocated for it.
    let claimed = ZipEntry {
        size: u32::MAX - 1,
        ..shot("11.png")
    };
    let words = refused("bomb.zip", with(claimed));
    assert!(words.contains("unpack to more than"), "{words}");
    // Many entries that share their bytes: each is within the limit, all together are not.
    let shared: Vec<ZipEntry> = (0..40)
        .map(|k| ZipEntry {
            packed: Vec::new(),
            size: 1 << 20,
            ..shot(&format!("{k}.png"))
        })
        .collect();
    let words = refused("bomb.zip", zip(&shared));
    assert!(words.contains("unpack to more than"), "{words}");
    // A long name in a small archive.
    let mut tar = tar_entry(b"././@LongLink", b'L', &vec![b'x'; 8 << 20]);
    tar.extend(tar_of(&three(16, 12)));
    refused("name.tar", tar.clone());
    refused("name.tgz", gzip(&tar));
}

#[test]
fn too_many_files() {
    let empty: Vec<ZipEntry> = (0..=MAX_ARCHIVE_FILES)
        .map(|k| ZipEntry::stored(&format!("{k}.txt"), b""))
        .collect();
    let words = refused("many.zip", zip(&empty));
    assert!(words.contains("10001 files"), "{words}");
    let mut tar: Vec<u8> = (0..=MAX_ARCHIVE_FILES)
        .flat_map(|k| tar_entry(format!("{k}.txt").as_bytes(), b'0', b""))
        .collect();
    tar.extend(tar_end());
    let words = refused("many.tar", tar);
    assert!(words.contains("10001 files"), "{words}");
    // The numbers of zip64, which a record of 32 bits points to: a claim, and no entries.
    let mut claim = three(16, 12)[0].bytes.clone();
    claim.splice(..4, *b"PK\x03\x04");
    let mut record = b"PK\x06\x06".to_vec();
    record.extend(44u64.to_le_bytes());
    record.extend([45, 0, 45, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    record.extend([u64::from(u32::MAX); 2].map(u64::to_le_bytes).concat());
    record.extend([u64::MAX >> 8, 0].map(u64::to_le_bytes).concat());
    claim.extend(record);
    let words = refused("many.zip", claim);
    assert!(words.contains("4294967295 files"), "{words}");
}

#[test]
fn other_formats_are_known() {
    for (name, mark, format) in [
        ("a.7z", &b"7z\xBC\xAF\x27\x1C\0\x04"[..], "7-Zip"),
        ("a.rar", b"Rar!\x1A\x07\x01\0", "RAR"),
        ("a.tar.xz", b"\xFD7zXZ\0\0\x04", "xz"),
        ("a.tar.bz2", b"BZh91AY&SY", "bzip2"),
        ("a.tar.zst", b"\x28\xB5\x2F\xFD\0\0", "Zstandard"),
        // By content alone.
        ("a.zip", b"Rar!\x1A\x07\x01\0", "RAR"),
    ] {
        let words = refused(name, mark.to_vec());
        assert!(
            words.contains(format) && words.contains("unpack it"),
            "{words}"
        );
    }
    for (bytes, found) in [
        (&b"<html>not found</html>"[..], "another kind"),
        (b"", "nothing"),
    ] {
        let words = refused("a.zip", bytes.to_vec());
        assert!(words.contains(found), "{words}");
    }
    let words = refused("lights.csv.gz", gzip(b"file,x,y,z\n"));
    assert!(words.contains("another file inside"), "{words}");
    let inner = file("photos.zip", zip_of(&three(16, 12)));
    let words = refused("a.zip", zip_of(&[inner]));
    assert!(
        words.contains("photos.zip") && words.contains("another archive"),
        "{words}"
    );
    // On the disk: the path is named.
    let place = tempfile::tempdir().unwrap();
    write_files(place.path(), &[("a.7z", b"7z\xBC\xAF\x27\x1C")]).unwrap();
    let path = place.path().join("a.7z");
    for given in [path.clone(), place.path().to_owned()] {
        let error = read_paths(&[given], &ReadOptions::default()).unwrap_err();
        assert!(
            error.to_string().starts_with(&path.display().to_string()),
            "{error}"
        );
    }
}

#[test]
fn files_with_holes_are_refused() {
    let mut tar = tar_entry(b"11.png", b'S', b"");
    tar.extend(tar_of(&three(16, 12)));
    refused("a.tar", tar);
    let holes = b"22 GNU.sparse.major=1\n";
    let mut tar = tar_entry(b"PaxHeaders/11.png", b'x', holes);
    tar.extend(tar_entry(b"GNUSparseFile.0/11.png", b'0', b"1\n0\n1\nx"));
    tar.extend(tar_of(&three(16, 12)));
    let words = refused("a.tgz", gzip(&tar));
    assert!(words.contains("holes"), "{words}");
}

/// Small enough that every byte can be changed.
fn small() -> Vec<NamedBytes> {
    let picture = |k: u8| {
        let mut bytes = b"P5 4 4 255\n".to_vec();
        bytes.extend((0..16).map(|pixel| 40 + pixel * (k + 2) + 25 * (pixel % (k + 1))));
        bytes
    };
    (1..=3)
        .map(|k| file(&format!("{k}.pgm"), picture(k)))
        .collect()
}

#[test]
fn cut_archives_are_refused() {
    for (name, whole) in all_ways(&small()) {
        // Both blocks of zeros at the end of a tar are one mark.
        let needed = whole.len() - if name == "capture.tar" { 512 } else { 0 };
        for length in 1..needed {
            let error = read(name, whole[..length].to_vec()).unwrap_err();
            assert!(
                matches!(&error, IoError::Archive { name: named, .. } if named == name),
                "{name} cut to {length}: {error}"
            );
        }
        assert_eq!(read(name, whole).unwrap(), 3, "{name}");
    }
}

#[test]
fn no_changed_byte_panics_or_passes() {
    let whole = |bytes: Vec<u8>, name: &str| {
        let input = read_stack(vec![file(name, bytes)], &ReadOptions::default());
        input.map(|input| input.stack.images().to_vec())
    };
    for (name, archive) in all_ways(&small()) {
        let expected = whole(archive.clone(), name).unwrap();
        for at in 0..archive.len() {
            for value in [
                0,
                1,
                0x7F,
                0x80,
                0xFF,
                archive[at] ^ 1,
                archive[at].wrapping_add(8),
            ] {
                let mut bytes = archive.clone();
                bytes[at] = value;
                let read = whole(bytes, name);
                // A zip has a sum of each file: changed pixels do not pass. A tar has none of its own.
                if name != "capture.tar"
                    && let Ok(images) = read
                {
                    // A changed name may change the order.
                    let samples = |images: &[StackImage]| {
                        let samples = images.iter().map(|image| format!("{:?}", image.samples));
                        samples.collect::<BTreeSet<_>>()
                    };
                    assert_eq!(samples(&images), samples(&expected), "{name}, byte {at}");
                }
            }
        }
    }
}
