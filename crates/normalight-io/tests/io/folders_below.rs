//! Folders whose photographs lie in folders further down.
use crate::common::{mask_png, shaded_png, three};
use normalight_core::MaskSource;
use normalight_io::{IoError, Notice, ReadOptions, read_paths, write_files};

#[test]
fn one_photograph_in_each_folder_is_a_stack() {
    let place = tempfile::tempdir().unwrap();
    for light in 1..=5 {
        let folder = place.path().join(format!("L{light:02}"));
        let shot = shaded_png(16, 12, light);
        write_files(
            &folder,
            &[("image.png", shot), ("note.txt", b"lamp".to_vec())],
        )
        .unwrap();
    }
    let mask = mask_png(16, 12, |x, _| x > 3);
    write_files(place.path(), &[("mask.png", mask)]).unwrap();
    let read = || read_paths(&[place.path().to_owned()], &ReadOptions::default());
    let input = read().unwrap();
    let names: Vec<String> = (1..=5).map(|k| format!("L{k:02}/image.png")).collect();
    assert_eq!(input.picked_names(), names);
    assert_eq!(input.mask_source, MaskSource::File("mask.png".to_owned()));
    assert!(input.plan.notices.contains(&Notice::OneInEachFolder));
    // A folder with more is a place of its own.
    let more = [("second.png", shaded_png(16, 12, 7))];
    write_files(&place.path().join("L03"), &more).unwrap();
    let error = read().unwrap_err();
    assert!(
        matches!(&error, IoError::PhotographsBelow { .. }),
        "{error}"
    );
}

#[test]
fn photographs_one_folder_down_are_found_and_said() {
    let place = tempfile::tempdir().unwrap();
    let exports: Vec<(String, Vec<u8>)> = three(16, 12)
        .into_iter()
        .map(|f| (f.name, f.bytes))
        .collect();
    write_files(&place.path().join("jpeg-exports"), &exports).unwrap();
    write_files(place.path(), &[("Thumbs.db", "x"), ("vase.lp", "1\n")]).unwrap();
    write_files(&place.path().join("original-captures"), &[("a.NEF", "x")]).unwrap();
    let options = ReadOptions::default();
    let error = read_paths(&[place.path().to_owned()], &options).unwrap_err();
    assert!(
        matches!(&error, IoError::PhotographsBelow { below, .. } if below == "3 in jpeg-exports"),
        "{error}"
    );
    assert!(read_paths(&[place.path().join("jpeg-exports")], &options).is_ok());
    let deeper = place.path().join("sessions/first");
    write_files(&deeper, &exports).unwrap();
    let error = read_paths(&[place.path().to_owned()], &options).unwrap_err();
    assert!(
        matches!(&error, IoError::PhotographsBelow { below, .. } if below == "3 in jpeg-exports, 3 in sessions/first"),
        "{error}"
    );
}

#[test]
fn an_empty_folder_says_what_is_in_it() {
    let place = tempfile::tempdir().unwrap();
    let said = || {
        let error = read_paths(&[place.path().to_owned()], &ReadOptions::default()).unwrap_err();
        let name = format!("{}: ", place.path().display());
        error.to_string().replace(&name, "")
    };
    assert_eq!(
        said(),
        "found no file in it, expected at least 3 photographs"
    );
    std::fs::create_dir_all(place.path().join("a/b")).unwrap();
    assert_eq!(
        said(),
        "found no file in it and no photographs in its 1 folder(s), expected at least 3 photographs"
    );
    write_files(
        place.path(),
        &[
            ("1.png", shaded_png(16, 12, 8)),
            ("normal.png", shaded_png(16, 12, 8)),
        ],
    )
    .unwrap();
    let error = said();
    assert!(
        error.starts_with("1 image(s) found, at least 3 are needed; left out: normal.png (a map"),
        "{error}"
    );
}
