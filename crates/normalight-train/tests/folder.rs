//! What a run leaves in its folder, and what it refuses to touch.
mod common;

use common::*;
use normalight_run::{RunError, RunState, Summary};
use normalight_train::TrainError;
use std::fs::File;

#[test]
fn a_folder_tells_all_about_its_run() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("run");
    for (text_of_recipe, figure, words) in [
        (NORMAL, "under_11_25", "pixels under 11.25 degrees"),
        (
            LIGHT,
            "intensity_error",
            "relative error of the intensities",
        ),
    ] {
        let recipe = recipe(&format!(
            "{text_of_recipe}steps = 4\nvalidate_every = 2\nseed = 7\n"
        ));
        let ran = whole(&folder, &recipe);
        let found = contents(&folder);
        let names: Vec<&str> = found.keys().map(String::as_str).collect();
        assert_eq!(
            names,
            [
                "checkpoint-before.safetensors",
                "checkpoint.safetensors",
                "curves.csv",
                "curves.png",
                "lock",
                "log.txt",
                "model-card.md",
                "recipe.toml",
                "summary.json",
                "weights.safetensors",
            ]
        );
        let summary: Summary = serde_json::from_slice(&found["summary.json"]).unwrap();
        assert_eq!(summary, ran.summary);
        assert_eq!(summary.state, RunState::Finished);
        assert_eq!(
            (summary.exit_code, summary.steps, summary.seed),
            (Some(EXIT.finished), 4, 7)
        );
        assert_eq!(summary.parameters, recipe.parameters());
        assert!(summary.hours > 0.0 && summary.hours_waited <= summary.hours);
        assert_eq!(summary.loss, ran.losses.last().copied());
        let best = summary.best.as_ref().unwrap();
        assert!(best.degrees > 0.0 && best.figures.contains_key(figure));
        let hash = summary.weights_sha256.unwrap();
        let card = text(&folder, "model-card.md");
        let degrees = format!("{:.2} degrees", best.degrees);
        for part in [
            words,
            &hash,
            &degrees,
            "`normalight train \\| tee log`",
            "| seed | 7 |",
            "steps = 4",
        ] {
            assert!(card.contains(part), "{part:?} is missing in {card}");
        }
        let log = text(&folder, "log.txt");
        for part in [
            "Z step 4 of 4: loss ",
            "validation ",
            "learning rate ",
            "samples/s",
            "waiting",
        ] {
            assert!(log.contains(part), "{part:?} is missing in {log}");
        }
        let curves = text(&folder, "curves.csv");
        let header = curves.lines().next().unwrap();
        assert!(header.starts_with("step,loss,validation_degrees,learning_rate,seconds,"));
        assert!(
            header.contains(figure) && curves.lines().count() == 3,
            "{curves}"
        );
        // The recipe as kept is the recipe.
        let kept = normalight_train::TrainRecipe::parse("kept", &text(&folder, "recipe.toml"));
        assert_eq!(kept.unwrap(), recipe);

        // The same again: nothing happens, with or without --resume.
        for resume in [false, true] {
            let again = run(&folder, &recipe, resume, None).unwrap();
            assert_eq!((again.losses.len(), &again.summary), (0, &ran.summary));
            assert_eq!(contents(&folder), found);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}

#[test]
fn one_process_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let recipe = recipe(&format!("{NORMAL}steps = 2\n"));
    let lock = File::create(folder.path().join("lock")).unwrap();
    lock.lock().unwrap();
    let error = run(folder.path(), &recipe, false, None).unwrap_err();
    assert!(
        matches!(error, TrainError::Run(RunError::Locked { .. })),
        "{error}"
    );
    assert_eq!(contents(folder.path()).len(), 1);
    drop(lock);
    whole(folder.path(), &recipe);
}

#[test]
fn an_interrupted_run_waits_for_resume() {
    let folder = tempfile::tempdir().unwrap();
    let recipe = recipe(&format!("{NORMAL}steps = 4\n"));
    // What a killed run may have left half written goes.
    std::fs::write(folder.path().join(".normalight-abc"), "half").unwrap();
    let ran = run(folder.path(), &recipe, false, Some(1)).unwrap();
    assert!(!folder.path().join(".normalight-abc").exists());
    assert_eq!(ran.summary.state, RunState::Interrupted);
    assert_eq!(
        (ran.summary.exit_code, ran.summary.steps),
        (Some(EXIT.interrupted), 1)
    );
    let error = run(folder.path(), &recipe, false, None).unwrap_err();
    assert!(error.to_string().contains("continue it"), "{error}");
    // A run that was killed before its first checkpoint starts afresh.
    for name in ["checkpoint.safetensors", "summary.json"] {
        std::fs::remove_file(folder.path().join(name)).unwrap();
    }
    assert!(run(folder.path(), &recipe, false, None).is_err());
    let ran = run(folder.path(), &recipe, true, None).unwrap();
    assert_eq!(ran.losses.len(), 4);
}

/// A rate so high that the weights explode.
#[test]
fn training_that_diverges_keeps_what_was_good() {
    let folder = tempfile::tempdir().unwrap();
    let high = "steps = 60\nvalidate_every = 1\n[optimiser]\nlearning_rate = 1.0\nwarm_up = 1\n\
                clip = 1e6\nbetas = [0.0, 0.0]\n";
    let recipe = recipe(&format!("{LIGHT}{high}"));
    let error = run(folder.path(), &recipe, false, None).unwrap_err();
    let TrainError::Run(RunError::Diverged {
        step, batch_seed, ..
    }) = error
    else {
        panic!("{error}");
    };
    assert!(step > 1);
    // Every step has two scenes of its own.
    assert_eq!(batch_seed, 2 * (step as u64 - 1));
    let message = error.to_string();
    assert!(
        message.contains(&format!("at step {step} (batch seed {batch_seed}")),
        "{message}"
    );
    let found = contents(folder.path());
    let summary: Summary = serde_json::from_slice(&found["summary.json"]).unwrap();
    assert_eq!(
        (summary.state, summary.exit_code),
        (RunState::Failed, Some(EXIT.diverged))
    );
    assert_eq!(summary.steps, step - 1);
    assert_eq!(summary.reason.as_deref(), Some(message.as_str()));
    assert_eq!(summary.network, "light");
    assert!(text(folder.path(), "log.txt").contains(&message));
    // The best weights are still there, and finite.
    normalight_model::Weights::from_bytes("best", &found["weights.safetensors"]).unwrap();
}

#[test]
fn what_cannot_begin_leaves_nothing() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("run");
    for more in [
        "init = \"gone.safetensors\"\n",
        "[normal.lights]\ntrue = 0.5\nperturbed = 0.0\npredicted = 0.5\nlight_weights = \"gone.safetensors\"\n",
        "[published]\nfolder = \"gone\"\n",
    ] {
        let recipe = recipe(&format!("{NORMAL}steps = 2\n{more}"));
        let error = run(&folder, &recipe, false, None).unwrap_err().to_string();
        assert!(error.contains("gone"), "{error}");
        assert!(!folder.exists());
    }
}

/// A folder stands where the weights should go: as on a full disk, the file cannot be written.
#[test]
fn what_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let recipe = recipe(&format!("{NORMAL}steps = 2\nvalidate_every = 1\n"));
    std::fs::create_dir(folder.path().join("weights.safetensors")).unwrap();
    let error = run(folder.path(), &recipe, false, None)
        .unwrap_err()
        .to_string();
    assert!(error.contains("weights.safetensors"), "{error}");
    let summary = text(folder.path(), "summary.json");
    assert!(
        summary.contains("failed") && summary.contains("weights.safetensors"),
        "{summary}"
    );
}
