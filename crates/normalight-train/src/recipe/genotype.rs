use crate::TrainError;
use normalight_model::Genotypes;
use normalight_run::{RunError, read_text};
use std::path::Path;
use toml::{Table, Value};

/// Networks of a recipe that may have cells.
const NETWORKS: [&str; 2] = ["light", "normal"];

pub(super) fn failed(file: &str, error: &toml::de::Error) -> TrainError {
    TrainError::Run(RunError::Recipe {
        file: file.to_owned(),
        reason: error.to_string(),
    })
}

/// Parses a recipe as a table of values that are yet to be checked.
///
/// # Errors
/// [`RunError::Recipe`] for what is no TOML.
pub fn read_table(file: &str, text: &str) -> Result<Table, TrainError> {
    toml::from_str(text).map_err(|error| failed(file, &error))
}

/// The layers of a network in a recipe.
fn body<'a>(recipe: &'a mut Table, network: &str) -> Option<&'a mut Table> {
    let settings = recipe.get_mut(network)?;
    settings
        .get_mut("architecture")?
        .get_mut("body")?
        .as_table_mut()
}

/// Replaces `genotype = "FILE"` of an architecture by the file's cells; paths start at `folder`.
///
/// Tells whether there was anything to replace.
pub(super) fn read_genotypes(recipe: &mut Table, folder: &Path) -> Result<bool, TrainError> {
    let mut found = false;
    for network in NETWORKS {
        let genotype = body(recipe, network).and_then(|body| body.get_mut("genotype"));
        let Some(genotype) = genotype else { continue };
        if let Value::String(name) = genotype {
            *genotype = read(&folder.join(&*name), network)?;
            found = true;
        }
    }
    Ok(found)
}

fn read(path: &Path, network: &str) -> Result<Value, TrainError> {
    let text = read_text(path)?;
    let genotypes = Genotypes::from_json(&path.display().to_string(), &text)?;
    let cells = match network {
        "light" => genotypes.light.map(Value::try_from),
        _ => genotypes.normal.map(Value::try_from),
    };
    let recipe_error = |reason: String| {
        TrainError::Run(RunError::Recipe {
            file: path.display().to_string(),
            reason,
        })
    };
    cells
        .ok_or_else(|| recipe_error(format!("holds no cells of a {network} network")))?
        .map_err(|error| recipe_error(error.to_string()))
}
