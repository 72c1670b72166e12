//! Folders and files on a disk.
use crate::common::{file, mask_png, shaded_png, three};
use normalight_core::MaskSource;
use normalight_io::{IoError, OutputFolder, ReadOptions, read_paths, write_files};

#[test]
fn folders_and_files() {
    let place = tempfile::tempdir().unwrap();
    let object = place.path().join("maskPNG");
    let mut files = three(16, 12);
    files.push(file("mask.png", mask_png(16, 12, |x, _| x > 3)));
    files.push(file("notes.md", b"not an image".to_vec()));
    let named: Vec<_> = files.iter().map(|file| (&file.name, &file.bytes)).collect();
    write_files(&object, &named).unwrap();
    let input = read_paths(std::slice::from_ref(&object), &ReadOptions::default()).unwrap();
    assert_eq!((input.file_names.len(), input.mask.count()), (3, 144));

    let paths = ["10.png", "1.png", "2.png"].map(|name| object.join(name));
    let input = read_paths(&paths, &ReadOptions::default()).unwrap();
    assert_eq!(input.stack.images()[2].name, "10.png");
    assert_eq!(input.mask_source, MaskSource::Guessed);

    let mut with_notes = paths.to_vec();
    with_notes.push(object.join("notes.md"));
    let error = read_paths(&with_notes, &ReadOptions::default()).unwrap_err();
    assert!(matches!(&error, IoError::NotAnImage { name, .. } if name.ends_with("notes.md")));
    with_notes[3] = place.path().to_owned();
    let error = read_paths(&with_notes, &ReadOptions::default()).unwrap_err();
    assert!(matches!(&error, IoError::NotAnImage { found, .. } if found.contains("folder")));
    let gone = place.path().join("gone");
    let error = read_paths(&[gone], &ReadOptions::default()).unwrap_err();
    assert!(matches!(&error, IoError::Read { name, .. } if name.ends_with("gone")));
}

#[test]
fn outputs_appear_whole_or_not_at_all() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("a/b");
    write_files(&target, &[("x.txt", b"one")]).unwrap();
    // The second name is refused: the first file must keep its old content, and nothing stay.
    let files = [("x.txt", "two"), ("../y.txt", "")];
    assert!(matches!(
        write_files(&target, &files),
        Err(IoError::Write { .. })
    ));
    assert_eq!(std::fs::read(target.join("x.txt")).unwrap(), b"one");
    assert_eq!(std::fs::read_dir(&target).unwrap().count(), 1);
    write_files(&target, &files[..1]).unwrap();
    assert_eq!(std::fs::read(target.join("x.txt")).unwrap(), b"two");
    // A folder below a regular file can be made by nobody.
    let below = target.join("x.txt/out");
    let error = write_files(&below, &files[..1]).unwrap_err();
    assert!(matches!(&error, IoError::Write { name, .. } if name.ends_with("x.txt/out")));
}

#[test]
fn a_prepared_folder_without_results_goes_again() {
    let place = tempfile::tempdir().unwrap();
    let target = place.path().join("a/b");
    drop(OutputFolder::prepare(&target).unwrap());
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 0);
    let folder = OutputFolder::prepare(&target).unwrap();
    folder.write(&[("x.txt", "one")]).unwrap();
    // A folder that was there before stays, as does what lies in it.
    drop(OutputFolder::prepare(&target).unwrap());
    assert!(target.join("x.txt").is_file());
    // A result that cannot take its place must not let the others take theirs.
    std::fs::create_dir(target.join("y.txt")).unwrap();
    let error = write_files(&target, &[("x.txt", "two"), ("y.txt", "two")]).unwrap_err();
    assert!(matches!(&error, IoError::Write { name, .. } if name.ends_with("y.txt")));
    assert_eq!(std::fs::read(target.join("x.txt")).unwrap(), b"one");
}

#[test]
fn only_picked_images_are_read() {
    let place = tempfile::tempdir().unwrap();
    let files: Vec<(String, Vec<u8>)> = (0..10)
        .map(|index| {
            let bytes = if [0, 2, 5].contains(&index) {
                shaded_png(16, 12, index / 2)
            } else {
                vec![]
            };
            (format!("{index}.png"), bytes)
        })
        .collect();
    write_files(place.path(), &files).unwrap();
    let options = ReadOptions {
        images: Some(3),
        ..ReadOptions::default()
    };
    let folder = [place.path().to_owned()];
    let input = read_paths(&folder, &options).unwrap();
    assert_eq!((input.picked, input.file_names.len()), (vec![0, 2, 5], 10));
    let error = read_paths(&folder, &ReadOptions::default()).unwrap_err();
    assert!(matches!(&error, IoError::NotAnImage { name, .. } if name == "1.png"));
}

#[test]
fn lights_beside_images() {
    let place = tempfile::tempdir().unwrap();
    let images: Vec<_> = (0..8)
        .map(|k| (format!("{k}.png"), shaded_png(16, 12, k)))
        .collect();
    write_files(place.path(), &images).unwrap();
    let options = ReadOptions {
        images: Some(4),
        ..ReadOptions::default()
    };
    let input = read_paths(&[place.path().to_owned()], &options).unwrap();
    let rows = |count: usize| (0..count).map(|k| format!("{k} 0 9\n")).collect::<String>();
    let path = place.path().join("light_directions.txt");
    let read = |directions: String| {
        write_files(place.path(), &[("light_directions.txt", directions)]).unwrap();
        input.read_lights_path(&path)
    };
    // A line for each image found, or for each image read: here four of eight.
    assert_eq!(input.picked, [0, 2, 5, 7]);
    let all = read(rows(8)).unwrap();
    assert!((all[1].direction.x / all[1].direction.z - 2.0 / 9.0).abs() < 1e-6);
    let few = read(rows(4)).unwrap();
    assert!((few[1].direction.x / few[1].direction.z - 1.0 / 9.0).abs() < 1e-6);
    assert!(matches!(
        read(rows(5)),
        Err(IoError::LightCount {
            found: 5,
            expected: 8,
            ..
        })
    ));
    let sibling = "1 2 3\n".repeat(8);
    write_files(place.path(), &[("light_intensities.txt", &sibling)]).unwrap();
    assert_eq!(read(rows(8)).unwrap()[3].intensity, [1.0, 2.0, 3.0]);
    let error = normalight_io::read_lights_path(&path, &input.file_names[..7]).unwrap_err();
    assert!(matches!(
        error,
        IoError::LightCount {
            found: 8,
            expected: 7,
            ..
        }
    ));
    let error = read(rows(4)).unwrap_err();
    assert!(
        matches!(&error, IoError::LightCount { name, found: 8, expected: 4 }
        if name.ends_with("light_intensities.txt")),
        "{error}"
    );
    for bad in ["0 1 1", "-1", "nan", "1 2", "1 2 3 4"] {
        let sibling = "1\n".repeat(7) + bad;
        write_files(place.path(), &[("light_intensities.txt", &sibling)]).unwrap();
        let error = read(rows(8)).unwrap_err();
        assert!(
            matches!(&error, IoError::LightFormat { name, line: 8, .. }
                if name.ends_with("light_intensities.txt")),
            "{error}"
        );
    }
    // Names beside lights decide, whatever else the file covers.
    let csv = "file,x,y,z,intensity,confidence\n".to_owned()
        + &[7, 5, 2, 0, 6]
            .map(|k| format!("{k}.png,{k},0,9,1,1\n"))
            .concat();
    let named = input.read_lights("lights.csv", csv.as_bytes()).unwrap();
    assert_eq!(named.len(), 4);
    assert!((named[3].direction.x / named[3].direction.z - 7.0 / 9.0).abs() < 1e-6);
}
