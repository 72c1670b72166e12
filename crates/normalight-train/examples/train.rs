//! Trains a tiny normal network on scenes that are rendered meanwhile:
//!
//!     cargo run --release --package normalight-train --example train FOLDER
//!
//! The folder then holds the weights, curves, a log and a model card. Started again, it does nothing; with more steps in
//! the recipe it goes on.
use burn::tensor::Device;
use normalight_run::{Caller, RunEvent};
use normalight_train::{TrainRecipe, TrainRun, train};
use std::ops::ControlFlow;

/// What `normalight train` reads from a file; what is not said has its default.
const RECIPE: &str = r#"
network = "normal"
steps = 40
batch = 4
images = [6, 8]
size = 16
validate_every = 20
validation_objects = 2

[normal.architecture]
mask_channel = false
body = { kind = "plain", widths = [8, 16, 32], head = 16 }

[optimiser]
kind = "muon"
warm_up = 5
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("expected a folder")?;
    let run = TrainRun {
        recipe: TrainRecipe::parse("tiny.toml", RECIPE)?,
        folder: folder.into(),
        resume: true,
        caller: Caller {
            command: "the example `train`".to_owned(),
            exit_codes: None,
        },
    };
    let summary = train(&run, &Device::flex(), |event| {
        match event {
            RunEvent::Note(note) => println!("{note}"),
            RunEvent::Step(report) => {
                if let Some(degrees) = report.validation {
                    println!(
                        "step {}: {degrees:.1} degrees on unseen objects",
                        report.step
                    );
                }
            }
        }
        // `Break` stops the run in good order; it can be continued.
        ControlFlow::Continue(())
    })?;
    println!(
        "{} weights in {:.2} hours",
        summary.parameters, summary.hours
    );
    Ok(())
}
