//! `estimate` on every device that this machine has, against each other.
use crate::common::*;
use std::path::Path;
use std::process::Command;

#[test]
fn both_implementations_agree() {
    let (place, photographs, out) = prepared();
    let reference = place.path().join("reference");
    said(estimate(
        &photographs,
        &out,
        &["--images", "3", "--no-refit"],
    ));
    said(on_device("reference", &photographs, &reference));
    assert!(furthest(&out, &reference) < 2e-3);
}

/// A GPU imitated by the processor; `cargo xtask test` installs one where it can, and says so.
#[test]
fn the_gpu_agrees() {
    let (place, photographs, out) = prepared();
    let gpu = place.path().join("gpu");
    let command = &mut on_device("software-gpu", &photographs, &gpu);
    let output = command.output().unwrap();
    let said_wrong = String::from_utf8(output.stderr).unwrap();
    let promised = std::env::var_os("NORMALIGHT_SOFTWARE_GPU").is_some();
    if said_wrong.starts_with("error: no GPU can be used") && !promised {
        eprintln!("skipped: no software GPU on this machine");
        return;
    }
    assert!(output.status.success(), "{said_wrong}");
    let report = read_json(&gpu.join("report.json"));
    assert!(
        report["device"]
            .as_str()
            .unwrap()
            .starts_with("software GPU")
    );
    said(estimate(
        &photographs,
        &out,
        &["--images", "3", "--no-refit"],
    ));
    assert!(furthest(&out, &gpu) < 2e-3);
}

/// Where drivers are there and no display is, the search for a GPU has nothing to say.
#[test]
fn a_machine_without_a_display_is_no_error() {
    let (_place, photographs, out) = prepared();
    let mut command = on_device("auto", &photographs, &out);
    command.arg("--quiet");
    command
        .env_remove("XDG_RUNTIME_DIR")
        .env_remove("WAYLAND_DISPLAY");
    let output = ended(command, 0);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
fn software_is_not_taken_for_a_gpu() {
    let (_place, photographs, out) = prepared();
    // Two words for one device.
    for word in ["wgpu", "gpu"] {
        let output = on_device(word, &photographs, &out).output().unwrap();
        let said_wrong = String::from_utf8(output.stderr).unwrap();
        if output.status.success() {
            let device = read_json(&out.join("report.json"))["device"].clone();
            assert!(device.as_str().unwrap().starts_with("GPU"));
        } else {
            assert!(
                said_wrong.contains("--device cpu") && !out.exists(),
                "{said_wrong}"
            );
        }
    }
}

#[test]
#[cfg(not(feature = "cuda"))]
fn without_cuda_the_word_says_how_to_get_it() {
    let (_place, photographs, out) = prepared();
    let output = on_device("cuda", &photographs, &out).output().unwrap();
    let said_wrong = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success() && !out.exists(), "{said_wrong}");
    assert!(said_wrong.contains("--features cuda"), "{said_wrong}");
}

fn on_device(device: &str, photographs: &Path, out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_normalight"));
    command.args(["estimate", path(photographs), "--out", path(out)]);
    command.args(["--device", device, "--images", "3", "--no-refit"]);
    command
}

/// The largest difference between the normals in two folders.
fn furthest(one: &Path, two: &Path) -> f32 {
    let [one, two] = [one, two].map(|folder| read_npy(&folder.join("normals.npy")));
    let far = one
        .iter()
        .zip(&two)
        .flat_map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()));
    far.fold(0.0, f32::max)
}
