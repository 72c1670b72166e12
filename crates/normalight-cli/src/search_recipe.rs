//! Recipes of a search: presets inside the program, or a file.
use crate::search::named;
use anyhow::{Result, bail};
use normalight_search::{NetworkSearchRecipe, SearchRecipe};
use normalight_train::{Network, TrainRecipe};
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

/// The same of searches of whole networks.
const NETWORK_PRESETS: [(&str, Network, &str); 2] = [
    (
        "networks",
        Network::Light,
        include_str!("../../../models/recipes/search-networks-light.toml"),
    ),
    (
        "networks",
        Network::Normal,
        include_str!("../../../models/recipes/search-networks-normal.toml"),
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
    let path = Path::new(name);
    let recipe = named(path, SearchRecipe::read(path))?;
    check_network(name, &recipe.training, network)?;
    Ok(recipe)
}

/// The recipe of that name or file, where it is one of whole networks.
pub(crate) fn read_networks(name: &str, network: Network) -> Result<Option<NetworkSearchRecipe>> {
    let preset = NETWORK_PRESETS
        .iter()
        .find(|(preset, of, _)| (*preset, *of) == (name, network));
    if let Some((_, _, text)) = preset {
        return Ok(Some(NetworkSearchRecipe::parse(name, text)?));
    }
    // What is wrong with the file is said when it is read as a recipe of cells.
    let is_one = std::fs::read_to_string(name)
        .is_ok_and(|text| NetworkSearchRecipe::is_one(name, &text).unwrap_or(false));
    if !is_one {
        return Ok(None);
    }
    let path = Path::new(name);
    let recipe = named(path, NetworkSearchRecipe::read(path))?;
    check_network(name, &recipe.training, network)?;
    Ok(Some(recipe))
}

fn check_network(name: &str, training: &TrainRecipe, network: Network) -> Result<()> {
    if training.network.kind() != network {
        bail!(
            "{name}: this recipe does not search the {} network",
            network.name()
        );
    }
    Ok(())
}
