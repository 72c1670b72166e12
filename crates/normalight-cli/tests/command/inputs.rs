//! The inputs beside the project through the whole command: normals as those of the plain stack; skipped where they are
//! missing.
use crate::common::*;
use std::path::{Path, PathBuf};

/// Largest mean angle between normals that are said to be the same, in degrees.
const SAME: f64 = 1.0;
/// ... where the photographs were saved with losses.
const SAME_AFTER_LOSSES: f64 = 2.5;

fn root() -> Option<PathBuf> {
    let root = std::env::var_os("NORMALIGHT_SHARED").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")),
        PathBuf::from,
    );
    let path = root.join("inputs");
    if path.is_dir() {
        return Some(path);
    }
    println!("skipped: {} is missing", path.display());
    None
}

/// Vectors of a normals.npy of any size.
fn normals(folder: &Path) -> Vec<[f64; 3]> {
    let bytes = std::fs::read(folder.join("normals.npy")).unwrap();
    let end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let numbers = bytes[end..].chunks_exact(4);
    let numbers: Vec<f64> = numbers
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()).into())
        .collect();
    numbers
        .chunks_exact(3)
        .map(|n| [n[0], n[1], n[2]])
        .collect()
}

/// Mean angle in degrees over the pixels that both have.
fn apart(one: &[[f64; 3]], two: &[[f64; 3]]) -> f64 {
    assert_eq!(one.len(), two.len());
    let dot = |a: &[f64; 3], b: &[f64; 3]| -> f64 { (0..3).map(|k| a[k] * b[k]).sum() };
    let inside = |n: &[f64; 3]| dot(n, n) > 0.5;
    let pairs = one.iter().zip(two).filter(|(a, b)| inside(a) && inside(b));
    let angles: Vec<f64> = pairs
        .map(|(a, b)| dot(a, b).clamp(-1.0, 1.0).acos().to_degrees())
        .collect();
    assert!(angles.len() > 1000, "{} pixels in common", angles.len());
    angles.iter().sum::<f64>() / angles.len() as f64
}

#[test]
fn inputs_of_all_kinds_give_the_normals_of_the_plain_stack() {
    let Some(root) = root() else { return };
    let place = tempfile::tempdir().unwrap();
    let estimated = |folder: &str, options: &[&str]| {
        let out = place.path().join("out");
        let mut arguments = vec!["--quality", "fast", "--quiet"];
        arguments.extend(options);
        said(estimate(&root.join(folder), &out, &arguments));
        normals(&out)
    };
    let file = |name: &str| root.join(name).to_str().unwrap().to_owned();
    let plain = estimated("00-reference/photos", &[]);
    let mut wrong = Vec::new();
    let mut compare = |what: &str, found: &[[f64; 3]], expected: &[[f64; 3]], most: f64| {
        let degrees = apart(found, expected);
        println!("{what}: {degrees:.2} degrees");
        if degrees > most {
            wrong.push(format!("{what}: {degrees:.2} degrees, at most {most}"));
        }
    };
    for (folder, most) in [
        ("01-icc-tiff16/a-srgb-tiff16", SAME),
        ("01-icc-tiff16/b-prophoto-tiff16", SAME),
        ("03-lp-decimal-comma/photos", SAME),
        ("08-maps-among-photos/b-other-tool-results", SAME),
        ("11-extension-lies/photos", SAME_AFTER_LOSSES),
        ("12-tiff-variants/b-jpeg-ycbcr", SAME_AFTER_LOSSES),
        ("12-tiff-variants/c-bigtiff", SAME),
        ("12-tiff-variants/i-tiled-planar-control", SAME),
        ("13-exr-variants/d-dwaa-control", SAME),
        ("16-names-unicode-case/a-nfd-files-nfc-list", SAME),
        ("19-own-names-and-lists/a-object-called-mask", SAME),
    ] {
        compare(folder, &estimated(folder, &[]), &plain, most);
    }
    for mask in [
        "09-mask-values/masks/labels-0-1-2.png",
        "09-mask-values/masks/ones.png",
        "10-mask-alpha-inverted/masks/inverted.png",
        "10-mask-alpha-inverted/masks/white-with-alpha.png",
    ] {
        let found = estimated("00-reference/photos", &["--mask", &file(mask)]);
        compare(mask, &found, &plain, SAME);
    }
    // Without the intensities that lie beside it: the other file has none.
    let alone = place.path().join("directions.txt");
    std::fs::copy(root.join("00-reference/light_directions.txt"), &alone).unwrap();
    let given = estimated("00-reference/photos", &["--lights", path(&alone)]);
    let opencv = file("07-lights-other-axes/opencv_axes.txt");
    let axes = ["--lights", &opencv, "--light-axes", "x-right,y-down,z-in"];
    let opencv = estimated("00-reference/photos", &axes);
    compare("07-lights-other-axes", &opencv, &given, 0.01);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
