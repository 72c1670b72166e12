//! The folder of a run: one process at a time, files only when complete.
use crate::difference::{Difference, differences};
use crate::summary::SUMMARY;
use crate::{RunError, RunSpec, Summary, checkpoint};
use normalight_io::{lock_file, write_files};
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

const LOCK: &str = "lock";
const LOG: &str = "log.txt";
const RECIPE: &str = "recipe.toml";

/// A run's folder, locked.
pub(crate) struct RunFolder {
    path: PathBuf,
    /// Name of the file that holds the best result.
    result: &'static str,
    /// Holds the lock while it is open.
    _lock: File,
}

/// What a folder holds for the run that is asked for.
pub(crate) enum Found {
    /// Nothing, or an earlier beginning that may be continued; and what is to be said about it.
    Begun(Option<String>),
    /// The same run at its end.
    Finished(Box<Summary>),
}

impl RunFolder {
    /// Makes the folder when it is missing and locks it.
    ///
    /// # Errors
    /// [`RunError::Locked`], or [`RunError::File`].
    pub(crate) fn open(spec: &RunSpec) -> Result<Self, RunError> {
        let path = &spec.folder;
        let failed = |reason| RunError::File {
            path: path.to_owned(),
            reason,
        };
        std::fs::create_dir_all(path).map_err(failed)?;
        let file = path.join(LOCK);
        let Some(lock) = lock_file(&file)? else {
            return Err(RunError::Locked {
                path: path.to_owned(),
            });
        };
        Ok(Self {
            path: path.to_owned(),
            result: spec.result,
            _lock: lock,
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Compares what is here with the run that is asked for.
    ///
    /// # Errors
    /// [`RunError::OtherRecipe`]; [`RunError::Unfinished`] unless the run is to be continued.
    pub(crate) fn find(&self, spec: &RunSpec) -> Result<Found, RunError> {
        let file = self.path.join(RECIPE);
        let unfinished = || RunError::Unfinished {
            path: self.path.clone(),
        };
        let text = match std::fs::read_to_string(&file) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                if checkpoint::exists(&self.path) && !spec.resume {
                    return Err(unfinished());
                }
                return Ok(Found::Begun(None));
            }
            Err(reason) => return Err(RunError::File { path: file, reason }),
        };
        let found = differences(&text, &spec.recipe).map_err(|error| RunError::Recipe {
            file: file.display().to_string(),
            reason: error.to_string(),
        })?;
        let other: Vec<String> = found
            .iter()
            .filter(|difference| !spec.free.contains(&difference.key.as_str()))
            .map(Difference::to_string)
            .collect();
        if !other.is_empty() {
            return Err(RunError::OtherRecipe {
                path: self.path.clone(),
                differences: other.join("; "),
            });
        }
        if let Some(summary) = Summary::read(&self.path)
            && summary.is_end_of(spec.schedule.steps)
        {
            return Ok(Found::Finished(Box::new(summary)));
        }
        if !spec.resume {
            return Err(unfinished());
        }
        let found: Vec<String> = found.iter().map(Difference::to_string).collect();
        let note = format!("the run goes on with another recipe: {}", found.join("; "));
        Ok(Found::Begun((!found.is_empty()).then_some(note)))
    }

    /// Takes away what a killed run left half written.
    pub(crate) fn clean(&self) {
        normalight_io::sweep_leftovers(&self.path);
    }

    /// Whether a run has begun here.
    pub(crate) fn has_run(&self) -> bool {
        self.path.join(RECIPE).exists()
    }

    /// Takes a folder away in which nothing began.
    pub(crate) fn abandon(self) {
        let _ = std::fs::remove_file(self.path.join(LOCK));
        // Fails where there is anything else in it.
        let _ = std::fs::remove_dir(&self.path);
    }

    /// Keeps the recipe beside the results.
    pub(crate) fn write_recipe(&self, recipe: &str) -> Result<(), RunError> {
        self.write(RECIPE, recipe.as_bytes())
    }

    /// Keeps the best result.
    pub(crate) fn write_result(&self, bytes: &[u8]) -> Result<(), RunError> {
        self.write(self.result, bytes)
    }

    /// The best result so far.
    pub(crate) fn result(&self) -> Option<Vec<u8>> {
        std::fs::read(self.path.join(self.result)).ok()
    }

    pub(crate) fn write_summary(&self, summary: &Summary) -> Result<(), RunError> {
        self.write(SUMMARY, summary.to_json().as_bytes())
    }

    /// Writes a file, which appears when it is complete.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), RunError> {
        Ok(write_files(&self.path, &[(name, bytes)])?)
    }

    /// Adds a line to the log. Hours of work do not end because of it: a full disk is found out at
    /// the next checkpoint.
    pub(crate) fn log(&self, line: &str) {
        let time = humantime::format_rfc3339_seconds(SystemTime::now());
        let file = self.path.join(LOG);
        if let Ok(mut log) = OpenOptions::new().create(true).append(true).open(file) {
            let _ = log.write_all(format!("{time} {line}\n").as_bytes());
        }
    }
}
