//! Tiny runs.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
#![allow(dead_code)]
use burn::tensor::Device;
use normalight_run::{Caller, ExitCodes, RunEvent, Summary};
use normalight_train::{TrainError, TrainRecipe, TrainRun, train};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The normal network on little crops, and the light network on its smallest views.
pub const NORMAL: &str = "network = \"normal\"\nsize = 16\nbatch = 2\nimages = [3, 4]\n\
                          validation_objects = 1\ncheckpoint_every = 2\n";
pub const LIGHT: &str = "network = \"light\"\nsize = 64\nbatch = 2\nimages = [3, 4]\n\
                         validation_objects = 1\ncheckpoint_every = 2\n";

/// Random weights come from a generator that all tests of a process share.
static GENERATOR: Mutex<()> = Mutex::new(());

/// Keeps other tests of this process from drawing random weights meanwhile.
pub fn alone() -> MutexGuard<'static, ()> {
    GENERATOR.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What a run did.
#[derive(Debug)]
pub struct Ran {
    pub summary: Summary,
    pub losses: Vec<f32>,
    pub notes: Vec<String>,
}

/// Codes that no program has by default.
pub const EXIT: ExitCodes = ExitCodes {
    finished: 10,
    failed: 11,
    diverged: 13,
    interrupted: 140,
};

pub fn recipe(text: &str) -> TrainRecipe {
    TrainRecipe::parse("recipe.toml", text).unwrap()
}

/// Trains until the end, or until `stop_at` steps are taken.
pub fn run(
    folder: &Path,
    recipe: &TrainRecipe,
    resume: bool,
    stop_at: Option<usize>,
) -> Result<Ran, TrainError> {
    let _alone = alone();
    let run = TrainRun {
        recipe: recipe.clone(),
        folder: folder.to_owned(),
        resume,
        caller: Caller {
            command: "normalight train | tee log".to_owned(),
            exit_codes: Some(EXIT),
        },
    };
    let (mut losses, mut notes) = (Vec::new(), Vec::new());
    let summary = train(&run, &Device::flex(), |event| {
        match event {
            RunEvent::Note(note) => notes.push(note),
            RunEvent::Step(report) => {
                losses.push(report.loss);
                if stop_at == Some(report.step) {
                    return ControlFlow::Break(());
                }
            }
        }
        ControlFlow::Continue(())
    })?;
    Ok(Ran {
        summary,
        losses,
        notes,
    })
}

/// A run from start to end.
pub fn whole(folder: &Path, recipe: &TrainRecipe) -> Ran {
    run(folder, recipe, false, None).unwrap()
}

/// Everything in a folder.
pub fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap());
    entries
        .map(|entry| {
            let name = entry.file_name().into_string().unwrap();
            (name, std::fs::read(entry.path()).unwrap())
        })
        .collect()
}

pub fn text(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}
