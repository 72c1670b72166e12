//! `evaluate --report`: every method, and a folder that keeps what was measured.
use crate::common::benchmark::write_object;
use crate::common::*;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A benchmark of two objects that are the same but for their name, one of which HTML could mistake.
fn benchmark() -> (TempDir, PathBuf, PathBuf) {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("two");
    for name in ["eggPNG", "<b>&ampPNG"] {
        write_object(&folder.join(name));
    }
    let report = place.path().join("report");
    (place, folder, report)
}

fn report(folder: &Path, out: &Path, more: &[&str]) -> std::process::Command {
    let mut command = normalight(&["evaluate", path(folder), "--report", path(out), "--quiet"]);
    command.args(more);
    command
}

/// A file of the report, and when it was written.
fn written(out: &Path, name: &str) -> std::time::SystemTime {
    out.join(name).metadata().unwrap().modified().unwrap()
}

#[test]
fn every_method_in_one_report() {
    let (_place, folder, out) = benchmark();
    let more = [
        "--methods",
        "all",
        "--images",
        "8,5",
        "--size",
        "32",
        "--jobs",
        "2",
    ];
    let text = said(report(&folder, &out, &more));
    let json = read_json(&out.join("report.json"));
    let tables = json["tables"].as_array().unwrap();
    assert_eq!(tables.len(), 12);
    assert_eq!(json["size"], 32);
    for table in tables {
        assert_eq!(table["objects"].as_array().unwrap().len(), 2, "{table}");
        // The two are the same but for their name.
        let [one, other] = [0, 1].map(|k| table["objects"][k]["normal_degrees"].as_f64().unwrap());
        assert!((one - other).abs() < 1e-9);
        let told =
            ["calibrated", "least-squares", "robust"].contains(&table["method"].as_str().unwrap());
        assert_eq!(table["mean"]["light_degrees"].is_null(), told, "{table}");
        let shown = format!("{:.2}", table["mean"]["normal_degrees"].as_f64().unwrap());
        assert!(text.contains(&shown));
        let markdown = std::fs::read_to_string(out.join("report.md")).unwrap();
        assert!(markdown.contains(&shown));
    }
    // Being told the lights helps.
    let degrees = |method: &str| {
        let table = tables
            .iter()
            .find(|table| table["method"] == method)
            .unwrap();
        table["mean"]["normal_degrees"].as_f64().unwrap()
    };
    assert!(degrees("calibrated") < degrees("uncalibrated"));

    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert!(!page.contains("<b>&amp</b>") && !page.contains("<b>&ampPNG"));
    assert!(page.contains("&lt;b&gt;&amp;amp"));
    // Needs nothing but itself.
    assert!(
        !page.contains("http:") && !page.contains("https:") && !page.contains("src=\"pictures")
    );
    // Of each object the truth, and of six methods normals and errors.
    assert_eq!(page.matches("data:image/png").count(), 2 * (1 + 6 * 2));
    // The light maps of the three methods that find lights; errors against photographs and what was expected; both networks.
    assert_eq!(page.matches("data:image/svg").count(), 2 * 3 + 3 + 2);
    assert!(page.contains("<h2>Errors to expect</h2>"));
    for table in tables {
        let networks = ["uncalibrated", "calibrated"].contains(&table["method"].as_str().unwrap());
        let figures = &table["objects"][0];
        let expected = figures["reliability"].as_array().map_or(0, Vec::len);
        assert_eq!(expected > 0, networks, "{table}");
        let counted = networks || table["method"] == "estimated-least-squares";
        assert_eq!(figures["multiply_adds"].is_null(), !counted, "{table}");
        // Others worked beside.
        assert!(figures["peak_memory"].is_null());
    }
    let rows = std::fs::read_to_string(out.join("trials.csv")).unwrap();
    assert_eq!(rows.lines().count(), 1 + 2 * 12);
}

#[test]
fn courses_of_trainings_stand_in_the_report() {
    let (place, folder, out) = benchmark();
    let run = place.path().join("run");
    std::fs::create_dir(&run).unwrap();
    let curves = |folder: &Path| format!("paper <b>={}", path(folder));
    let asked = |run: &Path| {
        let curves = curves(run);
        let more = ["--methods", "least-squares", "--curves", &curves];
        report(&folder, &out, &more)
    };
    // Before anything is measured.
    fails(asked(&run), &["curves.csv"]);
    assert!(!out.exists());
    let csv = "step,loss,validation_degrees,learning_rate,seconds\n\
               500,0.5,12.5,0.001,1800\n1000,0.4,11.25,0.0005,3600\n";
    std::fs::write(run.join("curves.csv"), csv).unwrap();
    said(asked(&run));
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    let markdown = std::fs::read_to_string(out.join("report.md")).unwrap();
    assert!(page.contains("<h2>Trainings</h2>") && page.contains("paper &lt;b&gt;"));
    assert!(
        markdown.contains("| 1000 | 1.00 | 11.25 | 11.25 |"),
        "{markdown}"
    );
    std::fs::write(run.join("curves.csv"), "step,loss\n").unwrap();
    fails(asked(&run), &["line 1", "validation_degrees"]);
}

#[test]
fn only_what_is_missing_is_measured_again() {
    let (_place, folder, out) = benchmark();
    let more = ["--methods", "robust,least-squares"];
    said(report(&folder, &out, &more));
    let trials = files(&out.join("trials"));
    assert_eq!(trials.len(), 4);
    let before: Vec<_> = trials
        .iter()
        .map(|name| written(&out.join("trials"), name))
        .collect();
    if cfg!(target_os = "linux") {
        let trial = read_json(&out.join("trials").join(&trials[0]));
        let peak = trial["trial"]["result"]["Ok"]["peak_memory"].as_f64();
        assert!(peak.is_some_and(|bytes| bytes > 1e6), "{trial}");
    }
    let first = std::fs::read(out.join("trials.csv")).unwrap();
    // A method more, one trial missing, one object changed.
    std::fs::remove_file(out.join("trials").join(&trials[0])).unwrap();
    let egg = folder.join("eggPNG/light_directions.txt");
    let text = std::fs::read_to_string(&egg).unwrap();
    std::fs::write(&egg, text + "\n").unwrap();
    said(report(
        &folder,
        &out,
        &["--methods", "robust,least-squares,factorisation"],
    ));
    let again = |name: &String| {
        let at = trials.iter().position(|one| one == name).unwrap();
        written(&out.join("trials"), name) != before[at]
    };
    for name in &trials {
        let changed = name.starts_with("egg") || *name == trials[0];
        assert_eq!(again(name), changed, "{name}");
    }
    assert_eq!(files(&out.join("trials")).len(), 6);
    // Nothing changed: nothing is measured, and the table is the same, seconds included.
    let rows = std::fs::read(out.join("trials.csv")).unwrap();
    assert_ne!(rows, first);
    said(report(
        &folder,
        &out,
        &["--methods", "robust,least-squares,factorisation"],
    ));
    assert_eq!(std::fs::read(out.join("trials.csv")).unwrap(), rows);
}

/// Benchmarks that keep their normals back take them as an archive of MATLAB files.
#[test]
fn estimates_for_a_server() {
    let (place, folder, out) = benchmark();
    let (withheld, near) = (folder.join("BALL_POM"), folder.join("Bell"));
    write_object(&withheld);
    write_object(&near);
    std::fs::remove_dir_all(folder.join("<b>&ampPNG")).unwrap();
    std::fs::remove_file(withheld.join("Normal_gt.mat")).unwrap();
    for name in [
        "light_directions.txt",
        "light_intensities.txt",
        "Normal_gt.mat",
    ] {
        std::fs::remove_file(near.join(name)).unwrap();
    }
    // Only a list makes an object of photographs alone.
    std::fs::write(folder.join("objects.txt"), "BALL_POM\nBell\neggPNG\n").unwrap();
    let more = ["--methods", "factorisation,least-squares", "--estimates"];
    // Least squares cannot do without lights.
    let output = ended(report(&folder, &out, &more), 1);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(
        errors.contains("Bell, least-squares") && errors.contains("light_directions.txt"),
        "{errors}"
    );
    let json = read_json(&out.join("report.json"));
    let [classical, told] = [0, 1].map(|k| json["tables"][k].clone());
    let names = |table: &serde_json::Value, list: &str| -> Vec<String> {
        let list = table[list].as_array().unwrap();
        list.iter()
            .map(|one| one["name"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(names(&classical, "objects"), ["BALL_POM", "Bell", "egg"]);
    assert_eq!(names(&told, "failures"), ["Bell"]);
    let known = |object: usize, key: &str| classical["objects"][object][key].as_f64().is_some();
    let of = |object| {
        [
            known(object, "normal_degrees"),
            known(object, "light_degrees"),
        ]
    };
    assert_eq!(
        [of(0), of(1), of(2)],
        [[false, true], [false, false], [true, true]]
    );
    // A mean over the others would be another benchmark's.
    assert!(classical["mean"]["normal_degrees"].is_null());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("BALL_POM: its true normals are not known"),
        "{text}"
    );
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert_eq!(page.matches("alt=\"True normals of").count(), 1);

    let folder_of = |method: &str| out.join("estimates").join(method);
    assert_eq!(
        files(&folder_of("least-squares")),
        ["BALL_POM.mat", "egg.mat", "normals.zip"]
    );
    let archive = folder_of("factorisation").join("normals.zip");
    let again = place.path().join("again");
    // Read back as an archive of truth would be: the server's side.
    let mut unpacked = zip::ZipArchive::new(std::fs::File::open(&archive).unwrap()).unwrap();
    unpacked.extract(&again).unwrap();
    assert_eq!(files(&again), ["BALL_POM.mat", "Bell.mat", "egg.mat"]);
    // An estimate that is gone is made again, the others are not.
    let ball = folder_of("factorisation").join("BALL_POM.mat");
    let egg = written(&folder_of("factorisation"), "egg.mat");
    std::fs::remove_file(&ball).unwrap();
    ended(report(&folder, &out, &more), 1);
    assert!(ball.is_file() && written(&folder_of("factorisation"), "egg.mat") == egg);

    // Nothing to compare with, and nobody who wants the estimate.
    std::fs::remove_dir_all(&withheld).unwrap();
    std::fs::write(folder.join("objects.txt"), "Bell\n").unwrap();
    let other = place.path().join("other");
    let output = ended(report(&folder, &other, &["--methods", "factorisation"]), 1);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(errors.contains("Bell: neither true normals"), "{errors}");
    ended(report(&folder, &out, &["--estimates", "--size", "32"]), 2);
}

#[test]
fn random_choices_and_photographs_that_are_left_out() {
    let (_place, folder, out) = benchmark();
    let object = folder.join("eggPNG");
    let more = [
        "--methods",
        "robust",
        "--images",
        "5",
        "--subsets",
        "3",
        "--leave-out",
        "egg:1-2",
    ];
    let text = said(report(&object, &out, &more));
    assert!(
        text.contains("5 images, mean of 3 random choices"),
        "{text}"
    );
    assert!(
        text.contains("standard deviation over the choices: normals"),
        "{text}"
    );
    let json = read_json(&out.join("report.json"));
    assert_eq!(json["left_out"][0], "egg:1-2");
    assert!(
        json["tables"][0]["spread"]["normal_degrees"]
            .as_f64()
            .unwrap()
            > 0.0
    );
    let rows = std::fs::read_to_string(out.join("trials.csv")).unwrap();
    let degrees: Vec<f64> = rows
        .lines()
        .skip(1)
        .map(|row| row.split(',').nth(8).unwrap().parse().unwrap())
        .collect();
    let mean = degrees.iter().sum::<f64>() / 3.0;
    let said = json["tables"][0]["mean"]["normal_degrees"]
        .as_f64()
        .unwrap();
    assert!(degrees.len() == 3 && (mean - said).abs() < 1e-5);
    // Six of eight are left: as many as that are all of them.
    let more = [
        "--methods",
        "robust",
        "--images",
        "8",
        "--leave-out",
        "egg:1-2",
    ];
    assert!(crate::common::said(report(&object, &out, &more)).contains("     6 "));
}

#[test]
fn what_render_writes_is_a_benchmark() {
    let place = tempfile::tempdir().unwrap();
    let set = place.path().join("set");
    let render = [
        "render",
        "--count",
        "2",
        "--images",
        "5",
        "--size",
        "32",
        "--out",
        path(&set),
        "--quiet",
    ];
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_normalight"));
    command.args(render);
    crate::common::said(command);
    let out = place.path().join("report");
    let more = [
        "--methods",
        "least-squares",
        "--disturb",
        "encoded,shrunk:1",
    ];
    let text = crate::common::said(report(&set, &out, &more));
    assert!(
        text.contains("all images, encoded for viewing, taken as linear"),
        "{text}"
    );
    let json = read_json(&out.join("report.json"));
    let tables = json["tables"].as_array().unwrap();
    assert_eq!(tables.len(), 3);
    assert!(
        tables
            .iter()
            .all(|table| table["objects"].as_array().unwrap().len() == 2)
    );
    let [whole, encoded, shrunk] = [0, 1, 2].map(|k| &tables[k]["objects"][0]);
    assert!(encoded["normal_degrees"] != whole["normal_degrees"]);
    assert!(shrunk["pixels"].as_u64() < whole["pixels"].as_u64());
    assert_eq!(tables[1]["disturbance"], "encoded");
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert!(page.contains("Disturbed photographs") && page.contains("mask 1 pixels too small"));
}

#[test]
fn too_few_photographs_for_a_method_and_a_folder_in_use() {
    let (_place, folder, out) = benchmark();
    let more = ["--methods", "factorisation,least-squares", "--images", "3"];
    let output = ended(report(&folder, &out, &more), 1);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("egg") && said.lines().count() == 2, "{said}");
    let page = std::fs::read_to_string(out.join("index.html")).unwrap();
    assert!(page.contains("What could not be measured"));
    let json = read_json(&out.join("report.json"));
    assert_eq!(json["tables"][0]["failures"].as_array().unwrap().len(), 2);
    assert_eq!(json["tables"][1]["objects"].as_array().unwrap().len(), 2);

    let held = std::fs::File::create(out.join(".lock")).unwrap();
    held.lock().unwrap();
    fails(
        report(&folder, &out, &[]),
        &["report", "another evaluation"],
    );
    let file = folder.join("eggPNG/mask.png");
    drop(held);
    fails(report(&folder, &file, &[]), &["mask.png"]);
    fails(
        report(&folder, &out, &["--leave-out", "cup:1"]),
        &["--leave-out cup:1-1", "no such object"],
    );
    for wrong in ["egg", "egg:0-3", "egg:5-2", ":1"] {
        let output = ended(report(&folder, &out, &["--leave-out", wrong]), 2);
        assert!(
            String::from_utf8(output.stderr)
                .unwrap()
                .contains("bear:1-20")
        );
    }
}
