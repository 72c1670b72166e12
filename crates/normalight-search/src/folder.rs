//! Folders that hold several trainings and what they have in common.
use normalight_io::write_files;
use normalight_run::{RunError, differences};
use normalight_train::TrainError;
use serde::{Serialize, de::DeserializeOwned};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// What they have in common.
pub(crate) const RECIPE: &str = "recipe.toml";

/// A folder of several trainings that belong together, and no others.
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// Makes the folder when it is missing.
    ///
    /// # Errors
    /// [`RunError::OtherRecipe`]; what cannot be read or written.
    pub(crate) fn claim(path: &Path, common: &str) -> Result<Self, TrainError> {
        let folder = Self(path.to_owned());
        let Some(before) = folder.read_text(RECIPE)? else {
            write_files(path, &[(RECIPE, common)])?;
            return Ok(folder);
        };
        let found = differences(&before, common).map_err(|error| {
            TrainError::Run(RunError::Recipe {
                file: path.join(RECIPE).display().to_string(),
                reason: error.to_string(),
            })
        })?;
        if found.is_empty() {
            return Ok(folder);
        }
        let found: Vec<String> = found.iter().map(ToString::to_string).collect();
        Err(folder.holds_another(found.join("; ")))
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    pub(crate) fn holds_another(&self, differences: String) -> TrainError {
        TrainError::Run(RunError::OtherRecipe {
            path: self.0.clone(),
            differences,
        })
    }

    pub(crate) fn write_json(&self, name: &str, value: &impl Serialize) -> Result<(), TrainError> {
        // Numbers and text always become JSON.
        let json = serde_json::to_string_pretty(value).unwrap_or_default() + "\n";
        Ok(write_files(&self.0, &[(name, json)])?)
    }

    /// Content of a file, if it is there.
    pub(crate) fn read_json<V: DeserializeOwned>(
        &self,
        name: &str,
    ) -> Result<Option<V>, TrainError> {
        let Some(text) = self.read_text(name)? else {
            return Ok(None);
        };
        serde_json::from_str(&text).map(Some).map_err(|error| {
            TrainError::Run(RunError::Recipe {
                file: self.0.join(name).display().to_string(),
                reason: error.to_string(),
            })
        })
    }

    fn read_text(&self, name: &str) -> Result<Option<String>, TrainError> {
        let path = self.0.join(name);
        match std::fs::read_to_string(&path) {
            Ok(text) => Ok(Some(text)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(reason) => Err(TrainError::Run(RunError::File { path, reason })),
        }
    }
}
