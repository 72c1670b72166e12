//! What a comparison's folder must agree on.
use super::Equal;
use crate::folder::RECIPE;
use normalight_run::RunError;
use normalight_train::{TrainError, TrainRecipe};
use serde::Serialize;

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
