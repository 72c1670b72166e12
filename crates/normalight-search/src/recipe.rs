use super::Budget;
use normalight_model::{Operation, SearchSpace};
use normalight_run::{Decay, OptimiserRecipe, RunError, Schedule, check, read_text};
use normalight_train::{TrainError, TrainRecipe, read_table};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Everything that decides a search; one TOML file: a training recipe without `genotype`, and the table `search`.
///
/// Steps, data and weights' optimiser are the training recipe's. Its scenes are divided: on one half the network's weights
/// are trained, on the other the architecture.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchRecipe {
    /// How to search.
    pub search: SearchSettings,
    /// How the relaxed network is trained meanwhile; the cells in it stand in for those that will be found.
    pub training: TrainRecipe,
}

/// How to search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SearchSettings {
    /// Candidates on every edge.
    pub operations: Vec<Operation>,
    /// Nodes of every cell.
    pub nodes: usize,
    /// One in so many channels goes through the operations (partial channels, PC-DARTS: 4); then edges are
    /// weighted, too. 1: all channels do.
    pub channel_divisor: usize,
    /// Weight of an auxiliary skip on every edge at the first step, falling to zero along a line (DARTS-); 0: none.
    pub auxiliary_skip: f32,
    /// Most skips in a derived cell; any number where missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most_skips: Option<usize>,
    /// Which gradient the architecture follows.
    pub order: Order,
    /// First steps in which only the network's weights are trained.
    pub warm_up: usize,
    /// How the architecture's parameters follow their gradients.
    pub alpha: AlphaRecipe,
    /// What the network may cost.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub budget: Option<Budget>,
}

/// Gradient of the architecture's parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// At the weights as they are (xi = 0).
    First,
    /// Through one plain gradient step of the weights, as long as their learning rate.
    Second,
}

/// Adam on the architecture's parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AlphaRecipe {
    /// Learning rate.
    pub learning_rate: f32,
    /// Adam's averaging of gradients and of their squares.
    pub betas: [f32; 2],
    /// Strength of the pull towards equal weights.
    pub weight_decay: f32,
}

impl Default for AlphaRecipe {
    /// As in DARTS and the paper.
    fn default() -> Self {
        Self {
            learning_rate: 3e-4,
            betas: [0.5, 0.999],
            weight_decay: 1e-3,
        }
    }
}

impl AlphaRecipe {
    /// As settings of our Adam.
    pub(crate) fn optimiser(&self) -> OptimiserRecipe {
        OptimiserRecipe {
            learning_rate: self.learning_rate,
            betas: self.betas,
            weight_decay: self.weight_decay,
            decay: Decay::Coupled,
            warm_up: 0,
            schedule: Schedule::Constant,
            ..OptimiserRecipe::default()
        }
    }
}

impl Default for SearchSettings {
    fn default() -> Self {
        let space = SearchSpace::default();
        Self {
            operations: space.operations,
            nodes: space.nodes,
            channel_divisor: space.channel_divisor,
            auxiliary_skip: 1.0,
            most_skips: None,
            order: Order::First,
            warm_up: 0,
            alpha: AlphaRecipe::default(),
            budget: None,
        }
    }
}

impl SearchSettings {
    /// What is chosen among.
    pub fn space(&self) -> SearchSpace {
        SearchSpace {
            operations: self.operations.clone(),
            nodes: self.nodes,
            channel_divisor: self.channel_divisor,
        }
    }

    fn validate(&self, steps: usize) -> Result<(), TrainError> {
        self.space().validate()?;
        let field = "search.auxiliary_skip";
        check(field, self.auxiliary_skip, 0.0..=10.0, "0 to 10")?;
        if self.auxiliary_skip > 0.0 && !self.operations.contains(&Operation::Skip) {
            return Err(TrainError::Run(RunError::Value {
                field,
                found: self.auxiliary_skip.to_string(),
                expected: "0 where skip is not among the operations",
            }));
        }
        let only_skips = |one: &Operation| matches!(one, Operation::Skip | Operation::Zero);
        if self.most_skips.is_some() && self.operations.iter().all(only_skips) {
            return Err(TrainError::Run(RunError::Value {
                field: "search.most_skips",
                found: "given".into(),
                expected: "operations besides skip and zero",
            }));
        }
        check("search.warm_up", self.warm_up, 0..=steps, "0 to steps")?;
        self.alpha.optimiser().validate()?;
        match &self.budget {
            Some(budget) => budget.validate(),
            None => Ok(()),
        }
    }
}

impl SearchRecipe {
    /// Reads and checks a recipe file; paths in it start at its folder and come out absolute.
    ///
    /// # Errors
    /// As of [`TrainRecipe::read`].
    pub fn read(path: &Path) -> Result<Self, TrainError> {
        let text = read_text(path)?;
        let recipe = Self::parse(&path.display().to_string(), &text)?;
        recipe.with_paths_from(path)
    }

    /// Parses and checks a recipe; relative paths in it start at the current folder.
    ///
    /// # Errors
    /// [`RunError::Recipe`] or [`RunError::Value`].
    pub fn parse(file: &str, text: &str) -> Result<Self, TrainError> {
        let mut table = read_table(file, text)?;
        let search = match table.remove("search") {
            Some(search) => search.try_into().map_err(|error| {
                TrainError::Run(RunError::Recipe {
                    file: file.to_owned(),
                    reason: format!("search: {error}"),
                })
            })?,
            None => SearchSettings::default(),
        };
        let training = TrainRecipe::from_open_table(file, table)?;
        let recipe = Self { search, training };
        recipe.validate()?;
        Ok(recipe)
    }

    fn with_paths_from(mut self, file: &Path) -> Result<Self, TrainError> {
        if let Some(times) = self
            .search
            .budget
            .as_mut()
            .and_then(|one| one.times.as_mut())
            && let Some(folder) = file.parent()
        {
            *times = std::path::absolute(folder.join(&*times)).map_err(|reason| {
                TrainError::Run(RunError::File {
                    path: times.clone(),
                    reason,
                })
            })?;
        }
        self.training = self.training.with_paths_from(file)?;
        Ok(self)
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
    /// [`RunError::Value`], or the errors of the scene and the architectures.
    pub fn validate(&self) -> Result<(), TrainError> {
        let training = &self.training;
        training.validate()?;
        self.search.validate(training.steps)?;
        let refused = |field, found: &str, expected| {
            Err(TrainError::Run(RunError::Value {
                field,
                found: found.to_owned(),
                expected,
            }))
        };
        if !training.network.has_cells() {
            let field = "kind of the architecture's body";
            return refused(field, "plain", "cells, to search them");
        }
        let width = training.network.width();
        if !width.is_multiple_of(self.search.channel_divisor) {
            let expected = "a multiple of search.channel_divisor";
            return refused("width", &width.to_string(), expected);
        }
        if training.cache.is_some() {
            let expected = "none: both halves of a search would show the same shapes";
            return refused("cache", "given", expected);
        }
        if training.init.is_some() {
            return refused("init", "given", "none: a search starts from random weights");
        }
        Ok(())
    }
}

/// A training recipe with the settings of a search as its table `search`.
///
/// # Errors
/// [`RunError::Recipe`], for a path that is not Unicode.
pub(crate) fn to_toml(
    training: &TrainRecipe,
    search: &impl Serialize,
) -> Result<String, TrainError> {
    let failed = |error: toml::ser::Error| {
        TrainError::Run(RunError::Recipe {
            file: "recipe.toml".into(),
            reason: error.to_string(),
        })
    };
    let mut table = toml::Table::try_from(training).map_err(failed)?;
    let search = toml::Value::try_from(search).map_err(failed)?;
    table.insert("search".into(), search);
    toml::to_string(&table).map_err(failed)
}
