//! Sets that are written, and read again.
use crate::common::published::{codes, entry, half_ball, tree};
use normalight_core::{Samples, Transfer, Vec3};
use normalight_io::{IoError, ObjectToPublish, PublishedPart, PublishedSet, PublishedWriter};
use std::fs;
use std::path::Path;

const SIDE: usize = 24;

fn write_set(root: &Path) {
    let object = half_ball(SIDE);
    let mut writer = PublishedWriter::create(root).unwrap();
    for (shape, material, part) in [
        ("ball", "gold", PublishedPart::Train),
        ("ball", "clay", PublishedPart::Validation),
        ("bowl", "gold", PublishedPart::Train),
    ] {
        writer
            .write(&object.as_entry(&entry(shape, material)), part)
            .unwrap();
        assert!(!root.join("train_mtrl.txt").exists());
    }
    writer.finish().unwrap();
}

#[test]
fn everything_comes_back() {
    let place = tempfile::tempdir().unwrap();
    write_set(place.path());
    let set = PublishedSet::open(place.path()).unwrap();
    assert_eq!(set.train(), [entry("ball", "gold"), entry("bowl", "gold")]);
    assert_eq!(set.val(), [entry("ball", "clay")]);
    let object = half_ball(SIDE);
    for each in set.train().iter().chain(set.val()) {
        let read = set.read(each).unwrap();
        assert_eq!(&read.entry, each);
        assert_eq!(read.stack.images(), object.images);
        assert_eq!(read.mask, object.mask);
        for (found, expected) in read.lights.iter().zip(&object.lights) {
            assert!((found.direction - expected.direction).length() < 1e-6);
            assert_eq!(found.intensity, expected.intensity);
        }
        for (found, expected) in read.normals.normals().iter().zip(object.normals.normals()) {
            assert!(
                (found - expected).abs().max_element() <= 2.0 / 255.0,
                "{found} {expected}"
            );
        }
    }
}

#[test]
fn the_layout_is_the_published_one() {
    let place = tempfile::tempdir().unwrap();
    write_set(place.path());
    let mut expected = vec!["Images".to_owned()];
    expected.extend(["train_mtrl.txt", "val_mtrl.txt"].map(str::to_owned));
    for (shape, materials) in [("ball", &["clay", "gold"][..]), ("bowl", &["gold"])] {
        let folder = format!("Images/{shape}");
        for end in ["depth.npy", "mask.png", "normal.npy", "normal.png"] {
            expected.push(format!("{folder}/{shape}_{end}"));
        }
        for material in materials {
            expected.push(format!("{folder}/{material}"));
            expected.push(format!("{folder}/{material}/{shape}_{material}.txt"));
            expected.extend((0..4).map(|k| format!("{folder}/{material}/light_{k:02}.png")));
        }
        expected.push(folder);
    }
    expected.sort();
    assert_eq!(tree(place.path()), expected);

    let read = |name: &str| fs::read_to_string(place.path().join(name)).unwrap();
    assert_eq!(read("train_mtrl.txt"), "ball/gold\nbowl/gold\n");
    assert_eq!(read("val_mtrl.txt"), "ball/clay\n");
    let lights = read("Images/ball/gold/ball_gold.txt");
    let lines: Vec<Vec<&str>> = lights
        .lines()
        .map(|line| line.split(' ').collect())
        .collect();
    assert!(lines.len() == 4 && lines.iter().all(|line| line.len() == 7));
    assert_eq!(lines[3], ["light_03.png", "0", "0", "1", "1", "1", "1"]);

    let object = half_ball(SIDE);
    let Samples::U8(codes) = codes(&place.path().join("Images/ball/ball_normal.png")) else {
        panic!("8 bits are published");
    };
    assert_eq!(codes[..3], [127; 3]);
    let middle = SIDE / 2 * SIDE + SIDE / 2;
    assert!(codes[3 * middle + 2] > 250);
    let depths = fs::read(place.path().join("Images/ball/ball_depth.npy")).unwrap();
    let depth = |pixel: usize| {
        let values = &depths[depths.len() - 4 * SIDE * SIDE..];
        f32::from_le_bytes(values[4 * pixel..4 * pixel + 4].try_into().unwrap())
    };
    assert_eq!(depth(middle), object.depth[middle]);
    assert!(depth(0).is_nan());
}

#[test]
fn nothing_is_overwritten() {
    let place = tempfile::tempdir().unwrap();
    write_set(place.path());
    let before = tree(place.path());
    let object = half_ball(SIDE);
    let mut writer = PublishedWriter::create(place.path()).unwrap();
    let error = writer.write(
        &object.as_entry(&entry("ball", "gold")),
        PublishedPart::Train,
    );
    assert!(
        matches!(&error, Err(IoError::Exists { name }) if name.contains("gold")),
        "{error:?}"
    );
    // Another shape under a known name would spoil the materials that are there.
    let mut other = half_ball(SIDE);
    other.normals = normalight_core::NormalMap::new(SIDE, SIDE, vec![Vec3::Z; SIDE * SIDE]);
    let error = writer.write(&other.as_entry(&entry("ball", "wax")), PublishedPart::Train);
    assert!(
        matches!(&error, Err(IoError::SetFormat { name, .. }) if name.contains("ball_normal.png"))
    );
    assert_eq!(tree(place.path()), before);
    // A set can be gone on with.
    writer
        .write(
            &object.as_entry(&entry("ball", "wax")),
            PublishedPart::Train,
        )
        .unwrap();
    writer.finish().unwrap();
    let set = PublishedSet::open(place.path()).unwrap();
    assert_eq!((set.train().len(), set.val().len()), (3, 1));
    set.read(&entry("ball", "wax")).unwrap();
}

#[test]
fn content_that_does_not_fit_is_refused() {
    let place = tempfile::tempdir().unwrap();
    let mut writer = PublishedWriter::create(place.path()).unwrap();
    let good = half_ball(SIDE);
    let name = entry("ball", "gold");
    let mut refused = |object: ObjectToPublish<'_>| {
        let error = writer.write(&object, PublishedPart::Train).unwrap_err();
        assert_eq!(tree(place.path()), ["Images"], "{error}");
        error
    };
    let change = |change: &dyn Fn(&mut crate::common::published::Object)| {
        let mut object = half_ball(SIDE);
        change(&mut object);
        object
    };
    for object in [
        change(&|object| object.images[1].name = "light_00.PNG".into()),
        change(&|object| object.images[1].name = "a b.png".into()),
        change(&|object| object.images[1].name = "../b.png".into()),
        change(&|object| object.images[1].name = "b.tif".into()),
        change(&|object| object.images[1].transfer = Transfer::Srgb),
        change(&|object| object.images.truncate(2)),
        change(&|object| object.images[1].width -= 1),
        change(&|object| object.depth.truncate(7)),
        change(&|object| object.lights[2].intensity[1] = 0.0),
        change(&|object| object.lights[2].direction.x = f32::NAN),
        change(&|object| object.mask = normalight_core::Mask::whole(SIDE, SIDE)),
        change(&|object| object.normals = half_ball(SIDE + 1).normals),
    ] {
        let error = refused(object.as_entry(&name));
        assert!(matches!(error, IoError::SetFormat { .. }), "{error}");
    }
    let few = ObjectToPublish {
        lights: &good.lights[..3],
        ..good.as_entry(&name)
    };
    assert!(matches!(refused(few), IoError::LightCount { found: 3, .. }));
    let spaced = entry("a ball", "gold");
    assert!(matches!(
        refused(good.as_entry(&spaced)),
        IoError::SetFormat { .. }
    ));
    let float = change(&|object| object.images[3].samples = Samples::F32(vec![0.5; SIDE * SIDE]));
    assert!(matches!(
        refused(float.as_entry(&name)),
        IoError::Encode { .. }
    ));
}

#[test]
fn blocked_places_are_named() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("file"), "").unwrap();
    let error = PublishedWriter::create(&place.path().join("file")).unwrap_err();
    assert!(
        matches!(&error, IoError::Write { name, .. } if name.contains("Images")),
        "{error}"
    );
    let root = place.path().join("set");
    let writer = PublishedWriter::create(&root).unwrap();
    fs::create_dir(root.join("train_mtrl.txt")).unwrap();
    let error = writer.finish().unwrap_err();
    assert!(
        matches!(&error, IoError::Write { name, .. } if name.contains("train_mtrl")),
        "{error}"
    );
    assert!(!root.join("val_mtrl.txt").exists());
}

/// A set whose writer was killed has objects that no list names.
#[test]
fn a_killed_set_is_written_again() {
    let place = tempfile::tempdir().unwrap();
    let (name, object) = (entry("ball", "gold"), half_ball(SIDE));
    let mut killed = PublishedWriter::create(place.path()).unwrap();
    killed
        .write(&object.as_entry(&name), PublishedPart::Train)
        .unwrap();
    drop(killed);
    let mut again = PublishedWriter::create(place.path()).unwrap();
    let mut other = half_ball(SIDE);
    other.lights[1].intensity[0] *= 0.5;
    let refused = again.write(&other.as_entry(&name), PublishedPart::Train);
    assert!(matches!(refused, Err(IoError::Exists { .. })));
    again
        .write(&object.as_entry(&name), PublishedPart::Train)
        .unwrap();
    // Once listed it is no leftover.
    let twice = again.write(&object.as_entry(&name), PublishedPart::Train);
    assert!(matches!(twice, Err(IoError::Exists { .. })));
    again.finish().unwrap();
    let list = fs::read_to_string(place.path().join("train_mtrl.txt")).unwrap();
    assert_eq!(list, "ball/gold\n");
}

/// Tells the process that may only write small files where to write.
#[cfg(unix)]
const FULL_AT: &str = "NORMALIGHT_TEST_FULL_AT";

/// Stands for a full disk: this test again, in a process that may only write small files.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_nothing_half_written() {
    use std::process::Command;
    if let Some(root) = std::env::var_os(FULL_AT) {
        return write_until_full(Path::new(&root));
    }
    let place = tempfile::tempdir().unwrap();
    write_set(place.path());
    let before = tree(place.path());
    let program = std::env::current_exe().unwrap();
    let done = Command::new("sh")
        .args([
            "-c",
            "trap '' XFSZ; ulimit -f 64; exec \"$0\" --exact \"$1\"",
        ])
        .arg(program)
        .arg("published_write::a_full_disk_leaves_nothing_half_written")
        .env(FULL_AT, place.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&done.stdout);
    assert!(done.status.success() && said.contains("1 passed"), "{said}");
    assert_eq!(tree(place.path()), before);
}

#[cfg(unix)]
fn write_until_full(root: &Path) {
    let mut object = half_ball(SIDE);
    let side = 512;
    let mut large = half_ball(side);
    // Noise, so that it cannot be packed.
    let noise = |k: usize| (k.wrapping_mul(0x9E37_79B9) >> 13) as u16;
    large.images[2].samples = Samples::U16((0..3 * side * side).map(noise).collect());
    let mut writer = PublishedWriter::create(root).unwrap();
    let error = writer.write(&large.as_entry(&entry("cup", "gold")), PublishedPart::Train);
    let error = error.unwrap_err();
    assert!(
        matches!(&error, IoError::Write { name, .. } if name.contains("Images/cup")),
        "{error}"
    );
    // The next material of a known shape.
    object.images[2].name = "x".repeat(300) + ".png";
    let error = writer.write(
        &object.as_entry(&entry("ball", "wax")),
        PublishedPart::Train,
    );
    let error = error.unwrap_err();
    assert!(
        matches!(&error, IoError::Write { name, .. } if name.contains("ball/wax/xxx")),
        "{error}"
    );
    assert_eq!(fs::read_dir(root.join("Images")).unwrap().count(), 2);
}
