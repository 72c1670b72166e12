//! `normalight evaluate`.
use crate::Outcome;
use crate::args::EvaluateArgs;
use crate::interrupt;
use crate::progress::{ProgressObserver, Spinner};
use crate::settings::{Estimation, describe};
use crate::table::{Failure, Table};
use crate::terminal::{note, print};
use anyhow::{Result, bail};
use normalight_evaluate::{BenchmarkObject, Figures, LightsFrom, ObjectFigures, evaluate_object};
use normalight_io::{OutputFolder, WeightHashes, list_diligent_objects, read_diligent_object};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// All figures, and what they were measured with.
#[derive(Debug, Serialize)]
struct Evaluation {
    version: String,
    /// Name of the benchmark's folder.
    data: String,
    /// Which lights the normals were estimated with, in words.
    lights_from: &'static str,
    device: String,
    weights: WeightHashes,
    /// Trainable parameters of the light and of the normal network.
    parameters: [usize; 2],
    settings: serde_json::Map<String, serde_json::Value>,
    /// One for each number of images.
    tables: Vec<Table>,
}

/// A table for each number of images, on the standard output and as JSON.
pub(crate) fn run(args: &EvaluateArgs) -> Result<Outcome> {
    let json = args.json.as_deref().map(prepare_json).transpose()?;
    let folders = list_diligent_objects(&args.folder)?;
    let estimation = Estimation::open(&args.estimation)?;
    let mut evaluation = Evaluation {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        data: folder_name(&args.folder),
        lights_from: if args.calibrated {
            "the true lights (calibrated)"
        } else {
            "estimated from the photographs"
        },
        device: estimation.device.clone(),
        weights: estimation.hashes(args.calibrated),
        parameters: estimation.estimator.parameters(),
        settings: describe(&args.estimation, &estimation.settings, args.calibrated),
        tables: Vec::new(),
    };
    print(&heading(&evaluation))?;
    let counts = match args.images[..] {
        [] => vec![None],
        _ => args.images.iter().copied().map(Some).collect(),
    };
    for images in counts {
        let Some(table) = measure(args, &estimation, &folders, images)? else {
            return Ok(Outcome::Interrupted);
        };
        let count = images.map_or("all images".to_owned(), |images| format!("{images} images"));
        print(&format!("\n{count}\n{}", table.to_text()))?;
        evaluation.tables.push(table);
    }
    if let Some((folder, name)) = json {
        let mut bytes = serde_json::to_vec_pretty(&evaluation)?;
        bytes.push(b'\n');
        folder.write(&[(name, bytes)])?;
    }
    let failed = evaluation
        .tables
        .iter()
        .any(|table| !table.failures.is_empty());
    Ok(if failed {
        Outcome::PartlyFailed
    } else {
        Outcome::Done
    })
}

/// Evaluates every object; `None` when the user stopped it.
fn measure(
    args: &EvaluateArgs,
    estimation: &Estimation,
    folders: &[PathBuf],
    images: Option<usize>,
) -> Result<Option<Table>> {
    let (mut objects, mut failures) = (Vec::new(), Vec::new());
    for folder in folders {
        let measured = measure_object(args, estimation, folder, images);
        if interrupt::asked() {
            return Ok(None);
        }
        match measured {
            Ok(figures) => objects.push(figures),
            Err(error) => {
                let name = folder_name(folder);
                let reason = format!("{error:#}");
                note(&format!("error: {name}: {reason}"));
                failures.push(Failure { name, reason });
            }
        }
    }
    Ok(Some(Table {
        images,
        mean: Figures::mean(&objects),
        objects,
        failures,
    }))
}

fn measure_object(
    args: &EvaluateArgs,
    estimation: &Estimation,
    folder: &Path,
    images: Option<usize>,
) -> Result<ObjectFigures> {
    let spinner = Spinner::new(format!("reading {}", folder_name(folder)), args.quiet);
    let read = read_diligent_object(folder, images)?;
    drop(spinner);
    let object = BenchmarkObject {
        name: read.name,
        stack: read.input.stack,
        mask: read.input.mask,
        lights: read.lights,
        normals: read.normals,
    };
    let lights = if args.calibrated {
        LightsFrom::Truth
    } else {
        LightsFrom::Photographs
    };
    let mut observer = ProgressObserver::new(format!("{}: ", object.name), args.quiet);
    let estimator = &estimation.estimator;
    let settings = estimation.settings;
    Ok(evaluate_object(
        estimator,
        &object,
        lights,
        settings,
        &mut observer,
    )?)
}

/// What the figures were measured with, for people.
fn heading(evaluation: &Evaluation) -> String {
    let hash = |hash: &Option<String>| match hash {
        Some(hash) => hash.clone(),
        None => "not used".to_owned(),
    };
    let settings: Vec<String> = evaluation
        .settings
        .iter()
        .map(|(name, value)| format!("{name} {value}").replace('"', ""))
        .collect();
    let [light, normal] = evaluation.parameters;
    format!(
        "normalight {}\ndata:           {}\nlights:         {}\ndevice:         {}\nlight weights:  {}\nnormal weights: {}\nparameters:     light network {light}, normal network {normal}\nsettings:       {}\nnormals and lights: mean error in degrees; <11.25, <22.5, <30: share of pixels under so many degrees\n",
        evaluation.version,
        evaluation.data,
        evaluation.lights_from,
        evaluation.device,
        hash(&evaluation.weights.light),
        hash(&evaluation.weights.normal),
        settings.join(", "),
    )
}

/// The last part of a path, whichever way it is written.
fn folder_name(folder: &Path) -> String {
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let name = whole.file_name().unwrap_or(whole.as_os_str());
    name.to_string_lossy().into_owned()
}

/// The folder of the JSON file, tried out before the work, and the file's name.
fn prepare_json(path: &Path) -> Result<(OutputFolder, String)> {
    let Some(name) = path.file_name() else {
        bail!("{}: the name of a file is expected", path.display());
    };
    let folder = OutputFolder::prepare(path.parent().unwrap_or(Path::new(".")))?;
    Ok((folder, name.to_string_lossy().into_owned()))
}
