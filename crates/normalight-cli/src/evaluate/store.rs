//! The folder of a report: what was measured stays there, so that a second call goes on where the first one was.
use crate::terminal::note;
use anyhow::{Context, Result, bail};
use normalight_evaluate::{
    BenchmarkObject, Measured, Method, MethodPictures, ObjectPictures, Photographs, Report, Trial,
    errors_picture, normals_picture,
};
use normalight_io::{lights_compared_svg, lock_file, normals_mat, pack_files, write_files};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

const TRIALS: &str = "trials";
const PICTURES: &str = "pictures";
const ESTIMATES: &str = "estimates";
/// All estimates of a method.
const ARCHIVE: &str = "normals.zip";
/// What is written out in names of files.
const WRITTEN_OUT: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'_');

/// The folder of a report, locked.
pub(super) struct Store {
    folder: PathBuf,
    /// Holds the lock while it is open.
    _lock: File,
}

/// A trial and everything that it depends on.
#[derive(Serialize, Deserialize)]
struct Stored {
    made_from: serde_json::Value,
    trial: Trial,
}

impl Store {
    /// Makes the folder when it is missing; an error when another evaluation is at work in it.
    pub(super) fn open(folder: &Path) -> Result<Self> {
        let made = [folder.join(TRIALS), folder.join(PICTURES)];
        for folder in made {
            fs::create_dir_all(&folder)
                .with_context(|| format!("{} cannot be made", folder.display()))?;
        }
        let Some(lock) = lock_file(&folder.join(".lock"))? else {
            bail!("{}: another evaluation is at work here", folder.display());
        };
        Ok(Self {
            folder: folder.to_owned(),
            _lock: lock,
        })
    }

    /// What was measured before of the same data with the same settings; `None` for nothing of it, or something else.
    pub(super) fn find(&self, trial: &Trial, made_from: &serde_json::Value) -> Option<Trial> {
        let path = self.folder.join(TRIALS).join(trial_name(trial));
        let stored: Stored = serde_json::from_slice(&fs::read(path).ok()?).ok()?;
        let same = &stored.made_from == made_from
            && (&stored.trial.object, stored.trial.method) == (&trial.object, trial.method)
            && stored.trial.photographs == trial.photographs;
        same.then_some(stored.trial)
    }

    /// Keeps a trial.
    pub(super) fn keep(&self, trial: &Trial, made_from: &serde_json::Value) -> Result<()> {
        let name = trial_name(trial);
        let bytes = serde_json::to_vec_pretty(&Stored {
            made_from: made_from.clone(),
            trial: trial.clone(),
        })?;
        Ok(write_files(&self.folder.join(TRIALS), &[(name, bytes)])?)
    }

    /// Whether the pictures of what was measured are there, and the estimate where it is wanted.
    pub(super) fn has_results(&self, trial: &Trial, estimate: bool) -> bool {
        let pictures = self.pictures(&trial.object, trial.method).is_some();
        pictures
            && (!estimate
                || self
                    .estimates(trial.method)
                    .join(estimate_name(&trial.object))
                    .is_file())
    }

    /// Keeps the normals that were found in a trial that is kept next, after its pictures: in the form that the servers of
    /// DiLiGenT10^2 and DiLiGenT-Pi take.
    pub(super) fn keep_estimate(&self, trial: &Trial, measured: &Measured) -> Result<()> {
        let file = normals_mat("Normal_est", &measured.normals)?;
        let files = [(estimate_name(&trial.object), file)];
        Ok(write_files(&self.estimates(trial.method), &files)?)
    }

    /// Packs the estimates of each method into one archive, and says where they are.
    pub(super) fn pack_estimates(&self, trials: &[Trial], methods: &[Method]) -> Result<()> {
        for &method in methods {
            let of_it = trials
                .iter()
                .filter(|trial| trial.method == method && trial.result.is_ok());
            let mut names: Vec<String> = of_it.map(|trial| estimate_name(&trial.object)).collect();
            names.dedup();
            if !names.is_empty() {
                let folder = self.estimates(method);
                pack_files(&folder, ARCHIVE, &names)?;
                note(&format!(
                    "{} objects in {}",
                    names.len(),
                    folder.join(ARCHIVE).display()
                ));
            }
        }
        Ok(())
    }

    fn estimates(&self, method: Method) -> PathBuf {
        self.folder.join(ESTIMATES).join(method.name())
    }

    /// Keeps the pictures of what was measured in a trial that is kept next.
    pub(super) fn keep_results(
        &self,
        trial: &Trial,
        object: &BenchmarkObject,
        measured: &Measured,
    ) -> Result<()> {
        // Pictures and figures of different settings never stand side by side, whenever this ends.
        match fs::remove_file(self.folder.join(TRIALS).join(trial_name(trial))) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(error.into()),
            _ => {}
        }
        let lights = measured.lights.as_ref();
        let true_lights = object.lights.as_deref().unwrap_or_default();
        let truth = object.normals.as_ref();
        let errors = |truth| errors_picture(&measured.normals, truth, &object.mask);
        let name = |what: &str| picture_name(&trial.object, trial.method, what);
        let files = [
            (
                truth_name(&trial.object),
                truth.map(normals_picture).transpose()?.unwrap_or_default(),
            ),
            (
                name("errors.png"),
                truth.map(errors).transpose()?.unwrap_or_default(),
            ),
            (
                name("lights.svg"),
                lights.map_or(Vec::new(), |lights| {
                    lights_compared_svg(lights, true_lights)
                }),
            ),
            // The last one says that all are there.
            (name("normals.png"), normals_picture(&measured.normals)?),
        ];
        Ok(write_files(&self.folder.join(PICTURES), &files)?)
    }

    fn pictures(&self, object: &str, method: Method) -> Option<MethodPictures> {
        let read = |what: &str| fs::read(self.picture(&picture_name(object, method, what))).ok();
        Some(MethodPictures {
            method,
            normals: read("normals.png")?,
            errors: read("errors.png")?,
            lights: read("lights.svg")?,
        })
    }

    fn picture(&self, name: &str) -> PathBuf {
        self.folder.join(PICTURES).join(name)
    }

    /// The pictures of all objects that could be measured.
    pub(super) fn all_pictures(&self, trials: &[Trial]) -> Vec<ObjectPictures> {
        let mut all: Vec<ObjectPictures> = Vec::new();
        for trial in trials.iter().filter(|trial| trial.result.is_ok()) {
            let Some(pictures) = self.pictures(&trial.object, trial.method) else {
                continue;
            };
            let object = match all.iter_mut().find(|one| one.object == trial.object) {
                Some(object) => object,
                None => {
                    let truth = fs::read(self.picture(&truth_name(&trial.object)));
                    all.push(ObjectPictures {
                        object: trial.object.clone(),
                        truth: truth.unwrap_or_default(),
                        methods: Vec::new(),
                    });
                    let last = all.len() - 1;
                    &mut all[last]
                }
            };
            if object.methods.iter().all(|one| one.method != trial.method) {
                object.methods.push(pictures);
            }
        }
        all
    }

    /// Writes the report's files.
    pub(super) fn write(&self, report: &Report, json: Vec<u8>) -> Result<()> {
        let mut files = vec![("report.json".to_owned(), json)];
        files.extend(report.files()?);
        Ok(write_files(&self.folder, &files)?)
    }
}

/// An object's name as a part of a file's name.
fn written_out(object: &str) -> String {
    utf8_percent_encode(object, WRITTEN_OUT).to_string()
}

fn trial_name(trial: &Trial) -> String {
    let Photographs {
        images,
        subset,
        disturbance,
    } = trial.photographs;
    let mut name = format!("{}--{}", written_out(&trial.object), trial.method.name());
    name += &images.map_or("--all".to_owned(), |images| format!("--{images}"));
    name += &subset.map_or(String::new(), |subset| format!("--{subset}"));
    let disturbance = disturbance.map(|one| written_out(&one.to_string()));
    name += &disturbance.map_or(String::new(), |one| format!("--{one}"));
    name + ".json"
}

fn estimate_name(object: &str) -> String {
    written_out(object) + ".mat"
}

fn truth_name(object: &str) -> String {
    format!("{}--truth.png", written_out(object))
}

fn picture_name(object: &str, method: Method, what: &str) -> String {
    format!("{}--{}--{what}", written_out(object), method.name())
}
