//! Ctrl-C ends the work in good order.
#![cfg(unix)]
mod common;

use common::*;
use normalight_synth::{Framing, Renderer, SceneRecipe};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, UNIX_EPOCH};

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_normalight"))
        .args(arguments)
        .stderr(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Presses Ctrl-C once the work has begun.
fn interrupt_when(mut child: Child, begun: impl Fn() -> bool) -> Output {
    while !begun() {
        assert!(child.try_wait().unwrap().is_none(), "ended by itself");
        std::thread::sleep(Duration::from_millis(20));
    }
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success());
    child.wait_with_output().unwrap()
}

#[test]
fn an_interrupted_estimate_leaves_all_as_it_was() {
    let place = tempfile::tempdir().unwrap();
    let (photographs, out) = (place.path().join("vase"), place.path().join("out"));
    let renderer = Renderer::new(SceneRecipe::default()).unwrap();
    let sample = renderer.sample(7, 24, 160, Framing::WholeObject);
    write_stack(&photographs, &sample);
    let arguments = [
        "estimate",
        path(&photographs),
        "--out",
        path(&out),
        "--device",
        "reference",
    ];
    // The output folder is made, or at least tried out, before the work begins.
    let output = interrupt_when(start(&arguments), || out.exists());
    assert_eq!(output.status.code(), Some(130));
    assert!(output.stdout.is_empty());
    assert!(!out.exists());

    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("normals.png"), "earlier").unwrap();
    let folder = std::fs::File::open(&out).unwrap();
    folder.set_modified(UNIX_EPOCH).unwrap();
    let tried_out = || folder.metadata().unwrap().modified().unwrap() != UNIX_EPOCH;
    let output = interrupt_when(start(&arguments), tried_out);
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(files(&out), ["normals.png"]);
    let earlier = std::fs::read_to_string(out.join("normals.png")).unwrap();
    assert_eq!(earlier, "earlier");
}

#[test]
fn an_interrupted_training_can_be_continued() {
    let place = tempfile::tempdir().unwrap();
    let (recipe, out) = (place.path().join("recipe.toml"), place.path().join("run"));
    let text = "network = \"normal\"\nsteps = 100000\nsize = 16\nbatch = 2\nimages = [3, 4]\n\
                validation_objects = 1\n";
    std::fs::write(&recipe, text).unwrap();
    let arguments = [
        "train",
        "normal",
        "--recipe",
        path(&recipe),
        "--out",
        path(&out),
    ];
    // A run keeps its recipe before the first step.
    let kept = out.join("recipe.toml");
    let run = || start(&[&arguments[..], &["--resume", "--device", "cpu"]].concat());
    let output = interrupt_when(run(), || kept.exists());
    assert_eq!(output.status.code(), Some(130));
    let checkpoint = out.join("checkpoint.safetensors");
    assert!(String::from_utf8_lossy(&output.stderr).contains("--resume"));
    let before = std::fs::read(&checkpoint).unwrap();
    std::fs::remove_file(&kept).unwrap();
    let output = interrupt_when(run(), || kept.exists());
    assert_eq!(output.status.code(), Some(130));
    assert_ne!(before, std::fs::read(&checkpoint).unwrap());
}
