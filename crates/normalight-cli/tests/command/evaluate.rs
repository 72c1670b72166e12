//! `evaluate` on a benchmark made here: its figures against others computed from the files that
//! `estimate` leaves.
use crate::common::benchmark::write_object;
use crate::common::*;

/// Angle in degrees, by the arc cosine and in double precision: not as the library does it.
fn degrees(a: [f32; 3], b: [f32; 3]) -> f64 {
    let dot = |a: [f32; 3], b: [f32; 3]| -> f64 {
        (0..3).map(|k| f64::from(a[k]) * f64::from(b[k])).sum()
    };
    let cosine = dot(a, b) / (dot(a, a) * dot(b, b)).sqrt();
    cosine.clamp(-1.0, 1.0).acos().to_degrees()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn close(found: &serde_json::Value, expected: f64, tolerance: f64) {
    let found = found.as_f64().unwrap();
    assert!(
        (found - expected).abs() < tolerance,
        "{found}, {expected} expected"
    );
}

#[test]
fn figures_are_those_of_the_files() {
    let place = tempfile::tempdir().unwrap();
    let benchmark = place.path().join("benchmark");
    let object = benchmark.join("eggPNG");
    write_object(&object);
    let json = place.path().join("figures.json");
    let text = said(normalight(&[
        "evaluate",
        path(&benchmark),
        "--json",
        path(&json),
    ]));
    let report = read_json(&json);
    let table = &report["tables"][0];
    assert!(table["images"].is_null());
    let egg = &table["objects"][0];
    assert_eq!(
        (&egg["name"], &egg["images"]),
        (&"egg".into(), &IMAGES.into())
    );

    let out = place.path().join("out");
    said(estimate(&object, &out, &[]));
    let truth = sample();
    let angles: Vec<f64> = read_npy(&out.join("normals.npy"))
        .into_iter()
        .zip(&truth.normals)
        .zip(&truth.mask)
        .filter(|&(_, &inside)| inside)
        .map(|((normal, truth), _)| degrees(normal, truth.to_array()))
        .collect();
    assert_eq!(egg["pixels"], angles.len());
    close(&egg["normal_degrees"], mean(&angles), 1e-3);
    for (key, limit) in [
        ("under_11_25", 11.25),
        ("under_22_5", 22.5),
        ("under_30", 30.0),
    ] {
        let under = angles.iter().filter(|&&angle| angle < limit).count();
        close(&egg[key], under as f64 / angles.len() as f64, 2e-3);
    }
    let lights = read_csv(&out.join("lights.csv"));
    let pairs = || lights.iter().zip(&truth.lights);
    let angles: Vec<f64> = pairs()
        .map(|(light, truth)| degrees(light.direction, truth.direction.to_array()))
        .collect();
    close(&egg["light_degrees"], mean(&angles), 1e-3);
    // The estimate is grey, the truth has colours: all channels count.
    let values: Vec<(f64, f64)> = pairs()
        .flat_map(|(light, truth_of)| {
            let first = truth.lights[0].intensity;
            (0..3).map(move |channel| {
                let relative = f64::from(truth_of.intensity[channel]) / f64::from(first[channel]);
                (light.intensity.into(), relative)
            })
        })
        .collect();
    let scale = values.iter().map(|(p, g)| p * g).sum::<f64>()
        / values.iter().map(|(p, _)| p * p).sum::<f64>();
    let errors: Vec<f64> = values
        .iter()
        .map(|(p, g)| (scale * p - g).abs() / g)
        .collect();
    close(&egg["intensity_error"], mean(&errors), 1e-4);
    close(
        &table["mean"]["normal_degrees"],
        egg["normal_degrees"].as_f64().unwrap(),
        1e-9,
    );

    // Both say what was measured with what.
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["data"], "benchmark");
    let hashes = ["light", "normal"].map(|network| report["weights"][network].as_str().unwrap());
    let normals = format!("{:.2}", egg["normal_degrees"].as_f64().unwrap());
    for part in [
        "benchmark",
        "all images",
        "egg",
        "mean",
        &normals,
        hashes[0],
        hashes[1],
    ] {
        assert!(text.contains(part), "{part:?} is missing in {text}");
    }
}

#[test]
fn a_table_for_each_number_of_images() {
    let place = tempfile::tempdir().unwrap();
    let object = place.path().join("eggPNG");
    write_object(&object);
    let json = place.path().join("figures.json");
    let arguments = [
        "evaluate",
        path(&object),
        "--images",
        "6,3",
        "--images",
        "100",
    ];
    let mut command = normalight(&arguments);
    command.args(["--json", path(&json), "--quiet"]);
    let text = said(command);
    assert!(text.contains("\n6 images\n") && text.contains("\n3 images\n"));
    let report = read_json(&json);
    let used: Vec<&serde_json::Value> = (0..3)
        .map(|k| &report["tables"][k]["objects"][0]["images"])
        .collect();
    assert_eq!(used, [6, 3, IMAGES]);
}

#[test]
fn true_lights_have_no_error() {
    let place = tempfile::tempdir().unwrap();
    let object = place.path().join("eggPNG");
    write_object(&object);
    let json = place.path().join("figures.json");
    let arguments = [
        "evaluate",
        path(&object),
        "--calibrated",
        "--json",
        path(&json),
    ];
    let text = said(normalight(&arguments));
    assert!(text.contains("calibrated"), "{text}");
    let report = read_json(&json);
    assert!(
        report["lights_from"]
            .as_str()
            .unwrap()
            .contains("calibrated")
    );
    assert!(report["weights"]["light"].is_null());
    assert!(report["tables"][0]["objects"][0]["light_degrees"].is_null());
}

#[test]
fn one_bad_object_does_not_stop_the_others() {
    let place = tempfile::tempdir().unwrap();
    let benchmark = place.path();
    for name in ["aPNG", "bPNG"] {
        write_object(&benchmark.join(name));
    }
    std::fs::write(benchmark.join("objects.txt"), "aPNG\ngonePNG\nbPNG\n").unwrap();
    std::fs::write(benchmark.join("aPNG/Normal_gt.mat"), "none").unwrap();
    let json = benchmark.join("figures.json");
    let arguments = ["evaluate", path(benchmark), "--json", path(&json)];
    let output = ended(normalight(&arguments), 1);
    let said = String::from_utf8(output.stderr).unwrap();
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        lines[0].contains("aPNG") && lines[0].contains("Normal_gt.mat"),
        "{said}"
    );
    assert!(lines[1].contains("gonePNG") && lines.len() == 2, "{said}");
    let table = &read_json(&json)["tables"][0];
    assert_eq!(table["objects"][0]["name"], "b");
    assert_eq!(table["failures"][1]["name"], "gonePNG");
}

#[test]
fn folders_that_hold_no_benchmark() {
    let place = tempfile::tempdir().unwrap();
    fails(
        normalight(&["evaluate", path(place.path())]),
        &["objects.txt"],
    );
    fails(
        normalight(&["evaluate", "gone"]),
        &["gone", "cannot be read"],
    );
    let object = place.path().join("eggPNG");
    write_object(&object);
    let json = object.join("mask.png/figures.json");
    let arguments = ["evaluate", path(&object), "--json", path(&json)];
    fails(normalight(&arguments), &["mask.png", "cannot be written"]);
}
