use crate::TrainError;
use normalight_model::Genotypes;
use std::path::Path;
use toml::{Table, Value};

/// Replaces `genotype = "FILE"` of an architecture by the file's cells; paths start at `folder`.
///
/// Tells whether there was anything to replace.
pub(super) fn read_genotypes(recipe: &mut Table, folder: &Path) -> Result<bool, TrainError> {
    let mut found = false;
    for network in ["light", "normal"] {
        let genotype = recipe
            .get_mut(network)
            .and_then(|settings| settings.get_mut("architecture"))
            .and_then(|architecture| architecture.get_mut("body"))
            .and_then(|body| body.get_mut("genotype"));
        let Some(genotype) = genotype else { continue };
        if let Value::String(name) = genotype {
            *genotype = read(&folder.join(&*name), network)?;
            found = true;
        }
    }
    Ok(found)
}

fn read(path: &Path, network: &str) -> Result<Value, TrainError> {
    let text = std::fs::read_to_string(path).map_err(|source| TrainError::File {
        path: path.to_owned(),
        source,
    })?;
    let genotypes = Genotypes::from_json(&path.display().to_string(), &text)?;
    let cells = match network {
        "light" => genotypes.light.map(Value::try_from),
        _ => genotypes.normal.map(Value::try_from),
    };
    let recipe_error = |reason: String| TrainError::Recipe {
        file: path.display().to_string(),
        reason,
    };
    cells
        .ok_or_else(|| recipe_error(format!("holds no cells of a {network} network")))?
        .map_err(|error| recipe_error(error.to_string()))
}
