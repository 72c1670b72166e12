//! The recipe of a search of whole networks.
use super::space::{Candidate, NetworkSpace};
use crate::recipe::to_toml;
use normalight_run::{RunError, check, read_text};
use normalight_synth::scrambled;
use normalight_train::{Network, TrainError, TrainRecipe, read_table};
use rand_pcg::Pcg32;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The word of `search.space` for whole networks.
const SPACE: &str = "network";
/// Draws until one is within the bounds, at most.
const MOST_DRAWS: usize = 100_000;
/// Images that multiply-adds and times are counted for.
pub(super) const IMAGES: usize = 10;

/// What should be small besides the error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Goal {
    /// Multiply-adds for ten images.
    #[default]
    MultiplyAdds,
    /// Milliseconds for ten images on the device of the search, measured before it begins.
    Time,
    /// Trainable parameters.
    Parameters,
}

/// Everything that decides a search of whole networks; one TOML file: a training recipe, whose own network stands in for
/// the candidates, and the table `search` with `space = "network"`.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkSearchRecipe {
    /// How to search.
    pub search: NetworkSearchSettings,
    /// How candidates are trained in the first round.
    pub training: TrainRecipe,
}

/// How to search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkSearchSettings {
    /// Always `network`.
    space: String,
    /// What should be small besides the error.
    #[serde(default)]
    pub goal: Goal,
    /// Random networks that the search begins with.
    #[serde(default = "candidates")]
    pub candidates: usize,
    /// How many are kept after each round but the last.
    #[serde(default = "keep")]
    pub keep: Vec<usize>,
    /// How many times as many steps a round has as the one before.
    #[serde(default = "growth")]
    pub growth: usize,
    /// Fewest and most multiply-adds for ten images.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub multiply_adds: Option<[u64; 2]>,
    /// Fewest and most trainable parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameters: Option<[usize; 2]>,
    /// Ranges of the networks.
    #[serde(default)]
    pub networks: NetworkSpace,
}

fn candidates() -> usize {
    24
}

fn keep() -> Vec<usize> {
    vec![8, 3]
}

fn growth() -> usize {
    3
}

impl NetworkSearchRecipe {
    /// Whether a recipe asks for whole networks: `search.space = "network"`.
    ///
    /// # Errors
    /// [`RunError::Recipe`] for what is no TOML.
    pub fn is_one(file: &str, text: &str) -> Result<bool, TrainError> {
        let table = read_table(file, text)?;
        let space = table.get("search").and_then(|search| search.get("space"));
        Ok(space.and_then(toml::Value::as_str) == Some(SPACE))
    }

    /// Reads and checks a recipe file; paths in it start at its folder and come out absolute.
    ///
    /// # Errors
    /// As of [`TrainRecipe::read`].
    pub fn read(path: &Path) -> Result<Self, TrainError> {
        let file = path.display().to_string();
        let mut recipe = Self::parse(&file, &read_text(path)?)?;
        recipe.training = recipe.training.with_paths_from(path)?;
        Ok(recipe)
    }

    /// Parses and checks a recipe; relative paths in it start at the current folder.
    ///
    /// # Errors
    /// [`RunError::Recipe`] or [`RunError::Value`].
    pub fn parse(file: &str, text: &str) -> Result<Self, TrainError> {
        let mut table = read_table(file, text)?;
        let search = table
            .remove("search")
            .unwrap_or(toml::Value::Table(toml::Table::new()));
        let search = search.try_into().map_err(|error| {
            TrainError::Run(RunError::Recipe {
                file: file.to_owned(),
                reason: format!("search: {error}"),
            })
        })?;
        let training = TrainRecipe::from_open_table(file, table)?;
        let recipe = Self { search, training };
        recipe.validate()?;
        Ok(recipe)
    }

    /// The recipe as TOML.
    ///
    /// # Errors
    /// [`RunError::Recipe`], for a path that is not Unicode.
    pub fn to_toml(&self) -> Result<String, TrainError> {
        to_toml(&self.training, &self.search)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`RunError::Value`], or those of the training recipe.
    pub fn validate(&self) -> Result<(), TrainError> {
        self.training.validate()?;
        let search = &self.search;
        let value = |field, found: String, expected| {
            Err(TrainError::Run(RunError::Value {
                field,
                found,
                expected,
            }))
        };
        if search.space != SPACE {
            return value("search.space", search.space.clone(), "network");
        }
        check(
            "search.candidates",
            search.candidates,
            1..=10_000,
            "1 to 10000",
        )?;
        check("search.growth", search.growth, 1..=100, "1 to 100")?;
        check("search.keep", search.keep.len(), 0..=8, "up to 8 numbers")?;
        let falls = |pair: &[usize]| pair[0] > pair[1];
        let rounds: Vec<usize> = [&[search.candidates], &search.keep[..]].concat();
        if !rounds.windows(2).all(falls) || rounds.contains(&0) {
            let expected = "numbers from below the candidates falling to 1 or more";
            return value("search.keep", format!("{:?}", search.keep), expected);
        }
        if self.training.init.is_some() {
            let expected = "none: candidates start from random weights";
            return value("init", "given".into(), expected);
        }
        search.networks.validate()
    }

    /// How many steps a round has, the first being round 0.
    pub(super) fn steps(&self, round: usize) -> usize {
        let growth = self.search.growth.saturating_pow(round as u32);
        self.training.steps.saturating_mul(growth)
    }

    /// The candidates: number `k` depends on recipe, seed and `k` alone, and no two are the same.
    ///
    /// # Errors
    /// [`RunError::Value`] when the bounds admit nearly none.
    pub fn candidates(&self) -> Result<Vec<Candidate>, TrainError> {
        let mut found: Vec<Candidate> = Vec::new();
        for number in 0..self.search.candidates as u64 {
            let seed = scrambled((self.training.seed << 32) + number);
            let mut random = Pcg32::new(seed, 1);
            let mut draws = (0..MOST_DRAWS).map(|_| {
                let network = self.training.network.kind();
                self.search.networks.draw(network, &mut random)
            });
            let fits = |one: &Candidate| !found.contains(one) && self.admits(one);
            let Some(candidate) = draws.find(fits) else {
                return Err(TrainError::Run(RunError::Value {
                    field: "search.multiply_adds and search.parameters",
                    found: format!("fewer than one in {MOST_DRAWS} random networks within them"),
                    expected: "bounds that more networks meet",
                }));
            };
            found.push(candidate);
        }
        Ok(found)
    }

    /// Multiply-adds for ten images: of a normal network with pictures of the recipe's size, whatever it is trained on.
    pub(super) fn multiply_adds(&self, recipe: &TrainRecipe) -> u64 {
        let size = match recipe.network.kind() {
            Network::Normal => self.training.size,
            Network::Light => recipe.size,
        };
        recipe.network.multiply_adds(IMAGES, size)
    }

    /// Whether a candidate can be trained and keeps within the bounds.
    fn admits(&self, candidate: &Candidate) -> bool {
        let Ok(recipe) = candidate.trained_as(&self.training) else {
            return false;
        };
        let search = &self.search;
        let multiply_adds = self.multiply_adds(&recipe);
        let parameters = recipe.parameters();
        recipe.validate().is_ok()
            && search
                .multiply_adds
                .is_none_or(|[low, high]| (low..=high).contains(&multiply_adds))
            && search
                .parameters
                .is_none_or(|[low, high]| (low..=high).contains(&parameters))
    }
}
