//! `render` and `bench render`.
use crate::common::*;
use normalight_io::{PublishedEntry, PublishedSet};
use normalight_synth::{Framing, Preset, Renderer};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
    command.args(arguments);
    command
}

/// `render` of three small stacks, from number 98 on.
fn render(out: &Path, more: &[&str]) -> Command {
    let mut command = command(&[
        "render",
        "--count",
        "3",
        "--first",
        "98",
        "--out",
        path(out),
    ]);
    command.args(["--images", "5", "--size", "40"]).args(more);
    command
}

/// All files below a folder with their bytes.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let place = entry.unwrap().path();
        let name = path(&place).to_owned();
        if place.is_dir() {
            all.extend(tree(&place));
        } else {
            all.insert(name, std::fs::read(&place).unwrap());
        }
    }
    all
}

#[test]
fn rendered_stacks_are_those_of_the_renderer_in_the_published_layout() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("stacks");
    ended(render(&out, &["--sheet"]), 0);
    let set = PublishedSet::open(&out).unwrap();
    let names =
        |entries: &[PublishedEntry]| entries.iter().map(|e| e.to_string()).collect::<Vec<_>>();
    assert_eq!(
        names(set.train()),
        ["scene000098/rendered", "scene000100/rendered"]
    );
    assert_eq!(names(set.val()), ["scene000099/rendered"]);
    let renderer = Renderer::new(Preset::World.recipe()).unwrap();
    let object = set.read(&set.val()[0]).unwrap();
    let sample = renderer.sample(99, 5, 40, Framing::WholeObject);
    assert_eq!(object.mask.inside(), sample.mask);
    for (read, truth) in object.lights.iter().zip(&sample.lights) {
        assert!((read.direction - truth.direction).length() < 1e-4);
        assert!((read.intensity[1] - truth.intensity[1]).abs() < 1e-4);
    }
    let inside: Vec<usize> = (0..40 * 40).filter(|&pixel| sample.mask[pixel]).collect();
    for image in 0..5 {
        let mut values = vec![[0.0; 3]; inside.len()];
        object.stack.linear_pixels(image, &inside, &mut values);
        for (value, &pixel) in values.iter().zip(&inside) {
            let truth = sample.images[image * 3 * 1600 + pixel];
            assert!((value[0] - truth).abs() <= 0.5 / 255.0 + 1e-6);
        }
    }
    for (normal, &pixel) in object
        .normals
        .normals()
        .iter()
        .zip(&(0..1600).collect::<Vec<_>>())
    {
        if sample.mask[pixel] {
            assert!(normal.angle_between(sample.normals[pixel]).to_degrees() < 1.0);
        }
    }
    let sheet = image::open(out.join("sheet.png")).unwrap();
    // Two stacks beside each other, each with normals and six photographs.
    assert_eq!((sheet.width(), sheet.height()), (2 * 7 * 40, 2 * 40));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let place = tempfile::tempdir().unwrap();
    let trees = ["1", "2", "5"].map(|threads| {
        let out = place.path().join("stacks");
        let mut command = render(&out, &[]);
        command.env("RAYON_NUM_THREADS", threads);
        ended(command, 0);
        let files = tree(&out);
        std::fs::remove_dir_all(&out).unwrap();
        files
    });
    assert!(trees[0].len() > 3 * 6);
    assert!(trees[0] == trees[1] && trees[1] == trees[2]);
}

#[test]
fn statistics_stand_beside_those_of_real_objects() {
    let text = said(command(&[
        "render", "--stats", "--count", "4", "--images", "6", "--size", "48",
    ]));
    assert!(
        text.contains("mean of 4") && text.contains("saturated"),
        "{text}"
    );
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/diligent-crop");
    if !shared.exists() {
        eprintln!("skipped the real objects: {} is missing", shared.display());
        return;
    }
    let text = said(command(&[
        "render",
        "--stats",
        "--count",
        "3",
        "--images",
        "6",
        "--size",
        "48",
        "--compare",
        path(&shared),
    ]));
    for name in ["ball", "bear", "cat", "cow", "reading"] {
        let line = text.lines().find(|line| line.starts_with(name)).unwrap();
        let words: Vec<&str> = line.split_whitespace().collect();
        // All of the benchmark's lights are known to stay within 44 degrees.
        let furthest: f64 = words.last().unwrap().parse().unwrap();
        assert!((42.0..=44.5).contains(&furthest), "{line}");
        let folder = shared.join(format!("{name}PNG"));
        let black: f64 = words[4].parse().unwrap();
        assert!((black - 100.0 * zeros(&folder)).abs() < 0.06, "{line}");
    }
}

/// Share of the object's samples that are zero.
fn zeros(folder: &Path) -> f64 {
    let names = std::fs::read_to_string(folder.join("filenames.txt")).unwrap();
    let mask = image::open(folder.join("mask.png")).unwrap().to_luma8();
    let (mut zeros, mut all) = (0, 0);
    for name in names.split_whitespace() {
        let photograph = image::open(folder.join(name)).unwrap().to_rgb8();
        for (pixel, inside) in photograph.pixels().zip(mask.pixels()) {
            if inside.0[0] > 127 {
                zeros += pixel.0.iter().filter(|&&value| value == 0).count();
                all += 3;
            }
        }
    }
    zeros as f64 / all as f64
}

#[test]
fn bad_recipes_and_files_are_told_apart() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("stacks");
    let with = |text: &str| {
        let file = place.path().join("own.toml");
        std::fs::write(&file, text).unwrap();
        render(&out, &["--recipe", path(&file)])
    };
    fails(
        with("[lights]\nhue = 1\n"),
        &["own.toml", "unknown field `hue`"],
    );
    fails(
        with("[camera]\nclip_share = 1.5\n"),
        &["camera.clip_share", "1.5", "0..=1"],
    );
    fails(
        with("[materials]\nmeasured_share = 0.5\nmeasured_file = \"gone.npz\"\n"),
        &["gone.npz"],
    );
    fails(
        render(&out, &["--recipe", "moon"]),
        &["moon", "world", "classic"],
    );
    fails(render(&out, &["--merl", "gone.npz"]), &["gone.npz"]);
    fails(render(&out, &["--meshes", "gone"]), &["gone"]);
    assert!(!out.exists());
    let file = place.path().join("file");
    std::fs::write(&file, "").unwrap();
    fails(render(&file, &[]), &["file"]);
    // Wrong usage.
    ended(command(&["render"]), 2);
    ended(command(&["render", "--out", path(&out), "--count", "0"]), 2);
}

#[test]
#[cfg(unix)]
fn a_full_disk_leaves_whole_stacks_only() {
    let place = tempfile::tempdir().unwrap();
    let out = place.path().join("stacks");
    // No file may exceed 20 kB (40 blocks of 512 bytes): the photographs do.
    let mut limited = Command::new("sh");
    limited
        .args(["-c", "trap '' XFSZ; ulimit -f 40; exec \"$0\" \"$@\""])
        .arg(env!("CARGO_BIN_EXE_normalight"))
        .args(["render", "--count", "2", "--images", "3", "--size", "256"])
        .args(["--bits", "16", "--out", path(&out)]);
    fails(limited, &["stack", "Images"]);
    let left = tree(&out);
    assert!(left.is_empty(), "{:?}", left.keys());
}

#[test]
fn speed_is_printed_for_programs() {
    let text = said(command(&[
        "bench",
        "render",
        "--seconds",
        "0.2",
        "--threads",
        "2",
        "--json",
    ]));
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    let cases = report["cases"].as_array().unwrap();
    let names: Vec<&str> = cases
        .iter()
        .map(|case| case["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["32x16", "128x32"]);
    for case in cases {
        assert_eq!(case["threads"], 2);
        assert!(case["samples_per_second"].as_f64().unwrap() > 0.0);
    }
}
