//! `estimate` on a small rendered stack: what it leaves, and what its settings do.
use crate::common::*;
use std::path::PathBuf;
use std::process::Command;

#[test]
fn all_results_are_there() {
    let (_place, photographs, out) = prepared();
    let said = said(estimate(&photographs, &out, &[]));
    for part in [
        "8 of 48x48 pixels",
        "mask.png",
        "CPU",
        "normals",
        path(&out),
    ] {
        assert!(said.contains(part), "{part:?} is missing in {said}");
    }
    let mut expected = OUTPUTS.map(str::to_owned);
    expected.sort();
    assert_eq!(files(&out), expected);

    let picture = image::open(out.join("normals.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (48, 48));
    assert_eq!(picture.color(), image::ColorType::Rgb16);
    let inside = sample().mask;
    for (normal, inside) in read_npy(&out.join("normals.npy")).iter().zip(inside) {
        let length = normal.iter().map(|v| v * v).sum::<f32>().sqrt();
        let expected = if inside { 1.0 } else { 0.0 };
        assert!((length - expected).abs() < 1e-5, "{normal:?}");
    }
    let lights = read_csv(&out.join("lights.csv"));
    assert_eq!(lights.len(), IMAGES);
    assert_eq!(lights[7].file, "008.png");
    for light in &lights {
        assert!((0.0..=1.0).contains(&light.confidence));
        assert!(light.intensity > 0.0);
        let length: f32 = light.direction.iter().map(|v| v * v).sum();
        assert!((length - 1.0).abs() < 1e-4);
    }
    let lp = std::fs::read_to_string(out.join("lights.lp")).unwrap();
    assert!(lp.starts_with("8\n001.png ") && lp.lines().count() == 9);
    let map = std::fs::read_to_string(out.join("lights.svg")).unwrap();
    assert!(map.contains("<svg") && map.contains("image 8"));
    assert_eq!(image::open(out.join("albedo.png")).unwrap().width(), 48);
}

#[test]
fn the_report_tells_how_it_came_to_be() {
    let (_place, photographs, out) = prepared();
    let said = said(estimate(&photographs, &out, &["--quiet", "--images", "4"]));
    assert_eq!(said, "");
    let report = read_json(&out.join("report.json"));
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["inputs"][1], "003.png");
    assert_eq!(
        (&report["width"], &report["height"]),
        (&48.into(), &48.into())
    );
    assert_eq!(report["mask"], "mask.png");
    assert_eq!(report["device"], "CPU (flex)");
    for network in ["light", "normal"] {
        assert_eq!(report["weights"][network].as_str().unwrap().len(), 64);
    }
    let settings = &report["settings"];
    assert_eq!(settings["images"], 4);
    assert_eq!(settings["refit"], true);
    assert_eq!(settings["decoding"], "soft-argmax");
    assert_eq!(settings["quality"], "default");
    assert_eq!(settings["normal_format"], "opengl");
    let stages = report["seconds"].as_array().unwrap();
    let names: Vec<&str> = stages
        .iter()
        .map(|s| s["stage"].as_str().unwrap())
        .collect();
    assert_eq!(
        names,
        [
            "start",
            "reading",
            "lights",
            "normals",
            "refit",
            "final normals",
            "albedo"
        ]
    );
    assert!(stages.iter().all(|s| s["seconds"].as_f64().unwrap() >= 0.0));
}

#[test]
fn the_same_photographs_give_the_same_files() {
    let (place, photographs, out) = prepared();
    let again = place.path().join("again");
    said(estimate(&photographs, &out, &[]));
    // Once as a folder, once as files in any order.
    let images: Vec<PathBuf> = (1..=IMAGES)
        .rev()
        .map(|k| photographs.join(format!("{k:03}.png")))
        .collect();
    let mask = photographs.join("mask.png");
    let mut arguments = vec!["estimate", "--out", path(&again), "--mask", path(&mask)];
    arguments.extend(images.iter().map(|image| path(image)));
    said(normalight(&arguments));
    for name in OUTPUTS.iter().filter(|&&name| name != "report.json") {
        let [one, two] = [&out, &again].map(|folder| std::fs::read(folder.join(name)).unwrap());
        assert!(one == two, "{name} differs");
    }
}

#[test]
fn some_images_are_spread_over_the_series() {
    let (_place, photographs, out) = prepared();
    said(estimate(&photographs, &out, &["--images", "4"]));
    let lights = read_csv(&out.join("lights.csv"));
    let names: Vec<&str> = lights.iter().map(|light| light.file.as_str()).collect();
    assert_eq!(names, ["001.png", "003.png", "006.png", "008.png"]);
}

#[test]
fn given_lights_are_used_as_they_are() {
    let (place, photographs, out) = prepared();
    let rows: Vec<String> = sample()
        .lights
        .iter()
        .map(|light| light.direction.to_array().map(|v| v.to_string()).join(" "))
        .collect();
    let file = place.path().join("light_directions.txt");
    std::fs::write(&file, rows.join("\n")).unwrap();
    said(estimate(&photographs, &out, &["--lights", path(&file)]));
    for (light, truth) in read_csv(&out.join("lights.csv"))
        .iter()
        .zip(sample().lights)
    {
        let dot: f32 = (0..3)
            .map(|k| light.direction[k] * truth.direction[k])
            .sum();
        assert!(dot > 0.9999 && light.confidence == 1.0);
    }
    let report = read_json(&out.join("report.json"));
    assert_eq!(report["lights_from"], path(&file));
    assert!(report["weights"]["light"].is_null());
    // What came out can be put in again; directions are made unit vectors once more, which may change
    // their last digit.
    let again = place.path().join("again");
    let csv = out.join("lights.csv");
    said(estimate(&photographs, &again, &["--lights", path(&csv)]));
    let [one, two] = [&out, &again].map(|folder| read_npy(&folder.join("normals.npy")));
    let pairs = one.iter().flatten().zip(two.iter().flatten());
    assert!(pairs.fold(0.0f32, |most, (a, b)| most.max((a - b).abs())) < 1e-4);
}

#[test]
fn truth_beside_the_photographs_is_not_used() {
    let (place, photographs, out) = prepared();
    said(estimate(&photographs, &out, &[]));
    for name in ["light_directions.txt", "lights.lp", "lights.csv"] {
        std::fs::write(photographs.join(name), "0 0 1\n".repeat(IMAGES)).unwrap();
    }
    let again = place.path().join("again");
    said(estimate(&photographs, &again, &[]));
    let [one, two] = [&out, &again].map(|folder| read_npy(&folder.join("normals.npy")));
    assert_eq!(one, two);
}

#[test]
fn directx_turns_green_around() {
    let (place, photographs, out) = prepared();
    let other = place.path().join("directx");
    said(estimate(&photographs, &out, &[]));
    said(estimate(
        &photographs,
        &other,
        &["--normal-format", "directx"],
    ));
    let [one, two] = [&out, &other].map(|folder| {
        image::open(folder.join("normals.png"))
            .unwrap()
            .into_rgb16()
    });
    for (one, two) in one.pixels().zip(two.pixels()) {
        assert_eq!((one[0], one[2]), (two[0], two[2]));
        let sum = u32::from(one[1]) + u32::from(two[1]);
        assert!(
            one.0 == [0; 3] || sum.abs_diff(65_535) <= 1,
            "{one:?} {two:?}"
        );
    }
    let [one, two] = [&out, &other].map(|folder| read_npy(&folder.join("normals.npy")));
    assert_eq!(one, two);
}

#[test]
fn masks_are_named_by_their_source() {
    let (_place, photographs, out) = prepared();
    let mask_of = |more: &[&str]| {
        said(estimate(&photographs, &out, more));
        read_json(&out.join("report.json"))["mask"].clone()
    };
    assert_eq!(mask_of(&["--mask", "none"]), "whole frame");
    assert!(
        image::open(out.join("mask.png"))
            .unwrap()
            .into_luma8()
            .iter()
            .all(|&v| v == 255)
    );
    std::fs::rename(photographs.join("mask.png"), photographs.join("../m.png")).unwrap();
    assert_eq!(mask_of(&[]), "told from the photographs");
    let file = photographs.join("../m.png");
    assert_eq!(mask_of(&["--mask", path(&file)]), "m.png");
}

#[test]
fn settings_change_the_lights() {
    let (_place, photographs, out) = prepared();
    let lights = |more: &[&str]| {
        said(estimate(&photographs, &out, more));
        std::fs::read(out.join("lights.csv")).unwrap()
    };
    let refitted = lights(&[]);
    let plain = lights(&["--no-refit"]);
    let argmax = lights(&["--no-refit", "--decoding", "argmax"]);
    let srgb = lights(&["--no-refit", "--color", "srgb"]);
    assert!(refitted != plain && plain != argmax && plain != srgb);
}

#[test]
fn the_quality_is_what_was_asked_for() {
    let (place, photographs, _) = prepared();
    let [fast, default, best] = ["fast", "default", "best"].map(|quality| {
        let out = place.path().join(quality);
        let said = said(estimate(&photographs, &out, &["--quality", quality]));
        assert!(said.contains(&format!("quality: {quality}\n")), "{said}");
        let report = read_json(&out.join("report.json"));
        assert_eq!(report["settings"]["quality"], quality);
        // A single view says nothing of its normals.
        let errors = &report["expected_errors"];
        assert!(
            errors["lights"]
                .as_f64()
                .is_some_and(|degrees| degrees > 0.0)
        );
        assert_eq!(errors["normals"].is_null(), quality == "fast");
        assert_eq!(out.join("normals-error.png").exists(), quality != "fast");
        assert!(said.contains("errors:  lights "), "{said}");
        read_npy(&out.join("normals.npy"))
    });
    assert!(fast != default && default != best);
}

/// What is taken for what is said before anything is computed, and alone when that is all that is asked for.
#[test]
fn a_dry_run_says_the_plan_and_stops() {
    let (place, photographs, out) = prepared();
    std::fs::write(photographs.join("notes.txt"), "by hand\n").unwrap();
    let dry = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
        command.args(["estimate", path(&photographs), "--dry-run"]);
        command.args(more);
        said(command)
    };
    let short = dry(&[]);
    for part in [
        "photographs: 8 (by name): 001.png to 008.png",
        "mask: mask.png",
        "colour: ",
    ] {
        assert!(short.contains(part), "{part:?} is missing in {short}");
    }
    assert!(!short.contains("002.png") && dry(&["--verbose"]).contains("002.png"));
    // Lights of a file whose y points down: given as such they are ours.
    let ours = place.path().join("ours.csv");
    let theirs = place.path().join("theirs.txt");
    let truth = sample().lights;
    let text = |sign: f32| {
        let lights = truth.iter().map(|light| light.direction);
        let lines = lights.map(|d| format!("{} {} {}\n", d.x, sign * d.y, d.z));
        lines.collect::<String>()
    };
    std::fs::write(&ours, text(1.0)).unwrap();
    std::fs::write(&theirs, text(-1.0)).unwrap();
    let given = dry(&["--lights", path(&ours)]);
    assert!(
        given.contains("lights: ") && given.contains("ours.csv"),
        "{given}"
    );
    let results = [
        (&ours, "x-right,y-up,z-out"),
        (&theirs, "x-right,y-down,z-out"),
    ]
    .map(|(lights, axes)| {
        let more = ["--lights", path(lights), "--light-axes", axes, "--quiet"];
        said(estimate(&photographs, &out, &more));
        read_npy(&out.join("normals.npy"))
    });
    assert_eq!(results[0], results[1]);
}
