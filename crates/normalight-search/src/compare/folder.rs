//! The folder of a comparison.
use super::{Comparison, Equal};
use normalight_io::write_files;
use normalight_run::RunError;
use normalight_run::differences;
use normalight_train::{TrainError, TrainRecipe};
use serde::{Serialize, de::DeserializeOwned};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

const RECIPE: &str = "recipe.toml";
const RESULT: &str = "compare.json";

/// The common schedule as TOML: what a folder must agree on. The table `compare` says what is equal.
///
/// # Errors
/// [`RunError::Recipe`], for a path that is not Unicode.
pub(super) fn common_text(
    recipe: &TrainRecipe,
    equal: Equal,
    multiply_adds: u64,
) -> Result<String, TrainError> {
    let failed = |error: toml::ser::Error| {
        TrainError::Run(RunError::Recipe {
            file: RECIPE.into(),
            reason: error.to_string(),
        })
    };
    #[derive(Serialize)]
    struct Table {
        equal: Equal,
        multiply_adds: u64,
    }
    // These change no result, or are chosen for each training.
    let mut common = TrainRecipe {
        loader_threads: None,
        seed: 0,
        ..recipe.clone()
    };
    common.network.open_cells();
    let mut table = toml::Table::try_from(common).map_err(failed)?;
    let compare = toml::Value::try_from(Table {
        equal,
        multiply_adds,
    });
    table.insert("compare".into(), compare.map_err(failed)?);
    toml::to_string(&table).map_err(failed)
}

/// A folder that holds this comparison and no other.
pub(super) struct Folder(PathBuf);

impl Folder {
    /// Makes the folder when it is missing.
    ///
    /// # Errors
    /// [`RunError::OtherRecipe`]; what cannot be read or written.
    pub(super) fn claim(path: &Path, common: &str) -> Result<Self, TrainError> {
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

    pub(super) fn path(&self) -> &Path {
        &self.0
    }

    pub(super) fn holds_another(&self, differences: String) -> TrainError {
        TrainError::Run(RunError::OtherRecipe {
            path: self.0.clone(),
            differences,
        })
    }

    /// Keeps the result so far.
    pub(super) fn write(&self, comparison: &Comparison) -> Result<(), TrainError> {
        self.write_json(RESULT, comparison)
    }

    pub(super) fn write_json(&self, name: &str, value: &impl Serialize) -> Result<(), TrainError> {
        // Numbers and text always become JSON.
        let json = serde_json::to_string_pretty(value).unwrap_or_default() + "\n";
        Ok(write_files(&self.0, &[(name, json)])?)
    }

    /// Content of a file, if it is there.
    pub(super) fn read_json<V: DeserializeOwned>(
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
