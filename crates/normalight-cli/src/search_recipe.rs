//! Recipes of a search: presets inside the program, or a file.
use anyhow::{Context, Result, bail};
use normalight_run::RunError;
use normalight_search::SearchRecipe;
use normalight_train::{Network, TrainError};
use std::path::Path;

/// Name, network and text of every preset.
const PRESETS: [(&str, Network, &str); 4] = [
    (
        "laptop",
        Network::Light,
        include_str!("../../../models/recipes/search-laptop-light.toml"),
    ),
    (
        "laptop",
        Network::Normal,
        include_str!("../../../models/recipes/search-laptop-normal.toml"),
    ),
    (
        "paper",
        Network::Light,
        include_str!("../../../models/recipes/search-paper-light.toml"),
    ),
    (
        "paper",
        Network::Normal,
        include_str!("../../../models/recipes/search-paper-normal.toml"),
    ),
];

/// The recipe of that name for a network, or of that file. Relative paths in a preset start at the current folder.
pub(crate) fn read(name: &str, network: Network) -> Result<SearchRecipe> {
    let preset = PRESETS
        .iter()
        .find(|(preset, of, _)| (*preset, *of) == (name, network));
    if let Some((_, _, text)) = preset {
        return Ok(SearchRecipe::parse(name, text)?);
    }
    let recipe = match SearchRecipe::read(Path::new(name)) {
        // These name the file themselves.
        Err(error @ TrainError::Run(RunError::File { .. } | RunError::Recipe { .. })) => {
            return Err(error.into());
        }
        recipe => recipe.with_context(|| name.to_owned())?,
    };
    if recipe.training.network.kind() != network {
        bail!(
            "{name}: this recipe does not search the {} network",
            network.name()
        );
    }
    Ok(recipe)
}
