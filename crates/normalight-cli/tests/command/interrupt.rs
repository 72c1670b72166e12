//! Ctrl-C and SIGTERM end the work in good order; a killed training can be continued.
use crate::common::*;
use normalight_synth::{Framing, Renderer, SceneRecipe};
use std::path::{Path, PathBuf};
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
fn interrupt_when(child: Child, begun: impl Fn() -> bool) -> Output {
    signal_when(child, "-INT", begun)
}

/// Sends a signal once the work has begun.
fn signal_when(mut child: Child, signal: &str, begun: impl Fn() -> bool) -> Output {
    wait_for(&mut child, begun);
    let sent = Command::new("kill")
        .args([signal, &child.id().to_string()])
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

/// A tiny run of many steps; its recipe and where it goes.
fn tiny_run(place: &Path, name: &str, steps: usize) -> (PathBuf, Vec<String>) {
    let (recipe, run) = (place.join("recipe.toml"), place.join(name));
    let text = format!(
        "network = \"normal\"\nsteps = {steps}\nsize = 16\nbatch = 2\nimages = [3, 4]\n\
         validation_objects = 1\nvalidate_every = 40\ncheckpoint_every = 5\n\
         [optimiser]\naverage = 0.9\n"
    );
    std::fs::write(&recipe, text).unwrap();
    let arguments = [
        "train",
        "normal",
        "--recipe",
        path(&recipe),
        "--run",
        path(&run),
    ];
    let more = ["--resume", "--device", "cpu"];
    let arguments = arguments.into_iter().chain(more).map(str::to_owned);
    let arguments = arguments.collect();
    (run, arguments)
}

fn start_run(arguments: &[String]) -> Child {
    start(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Waits until the run has something.
fn wait_for(child: &mut Child, begun: impl Fn() -> bool) {
    while !begun() {
        assert!(child.try_wait().unwrap().is_none(), "ended by itself");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn an_interrupted_training_can_be_continued() {
    let place = tempfile::tempdir().unwrap();
    let (run, arguments) = tiny_run(place.path(), "run", 100_000);
    let checkpoint = run.join("checkpoint.safetensors");
    let mut steps = 0;
    for signal in ["-INT", "-TERM"] {
        let before = std::fs::read(&checkpoint).ok();
        let child = start_run(&arguments);
        let output = signal_when(child, signal, || std::fs::read(&checkpoint).ok() != before);
        assert_eq!(output.status.code(), Some(130), "{signal}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("--resume"));
        let summary = read_json(&run.join("summary.json"));
        assert_eq!(summary["state"], "interrupted");
        assert_eq!(summary["exit_code"], 130);
        let taken = summary["steps"].as_u64().unwrap();
        assert!(taken > steps, "{taken} steps");
        steps = taken;
    }
}

/// Killed twice without any warning, a run still ends with the weights of one that was left alone.
#[test]
fn a_killed_training_loses_nothing_but_time() {
    let place = tempfile::tempdir().unwrap();
    let (alone, arguments) = tiny_run(place.path(), "alone", 200);
    assert!(start_run(&arguments).wait().unwrap().success());
    let (killed, arguments) = tiny_run(place.path(), "killed", 200);
    let checkpoint = killed.join("checkpoint.safetensors");
    for _ in 0..2 {
        let before = std::fs::read(&checkpoint).ok();
        let mut child = start_run(&arguments);
        wait_for(&mut child, || std::fs::read(&checkpoint).ok() != before);
        // SIGKILL on Unix.
        child.kill().unwrap();
        assert!(!child.wait().unwrap().success());
        assert_eq!(read_json(&killed.join("summary.json"))["state"], "running");
    }
    assert!(start_run(&arguments).wait().unwrap().success());
    let log = std::fs::read_to_string(killed.join("log.txt")).unwrap();
    assert_eq!(log.matches("continued after step").count(), 2, "{log}");
    let weights = |run: &Path| std::fs::read(run.join("weights.safetensors")).unwrap();
    assert!(weights(&alone) == weights(&killed));
    let best = |run: &Path| read_json(&run.join("summary.json"))["best"].clone();
    assert_eq!(best(&alone), best(&killed));
    let curves = |run: &Path| -> Vec<String> {
        let text = std::fs::read_to_string(run.join("curves.csv")).unwrap();
        let lines = text.lines();
        // But for the seconds.
        let fields = lines.map(|line| line.split(',').take(4).collect::<Vec<_>>().join(","));
        fields.collect()
    };
    assert_eq!(curves(&alone), curves(&killed));
}
