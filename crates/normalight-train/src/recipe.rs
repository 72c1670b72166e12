//! Everything that decides a training run.
mod check;
mod genotype;
mod network;
mod networks;
mod sources;
mod stored;

pub(crate) use check::MOST_GIGABYTES;
pub use genotype::read_table;
pub use network::{Network, NetworkRecipe};
pub use networks::{LightMix, LightSettings, NormalSettings};
pub use sources::{CacheRecipe, PublishedChoice, PublishedRecipe};

use crate::TrainError;
use normalight_model::Genotypes;
use normalight_run::{OptimiserRecipe, RunError, read_text};
use normalight_synth::SceneRecipe;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use stored::Stored;

/// Everything that decides a training run; one TOML file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct TrainRecipe {
    /// Which network, and what concerns it alone.
    pub network: NetworkRecipe,
    /// Number of optimiser steps.
    pub steps: usize,
    /// Samples per step.
    pub batch: usize,
    /// Fewest and most images of a sample; all samples of a step have the same number.
    pub images: [usize; 2],
    /// Side of the training pictures in pixels: crops for normals, whole objects for lights.
    pub size: usize,
    /// Seed of weights and samples.
    pub seed: u64,
    /// Weights to start from instead of random ones: of the same network, without normalisation layers.
    pub init: Option<PathBuf>,
    /// Steps between validations on unseen objects.
    pub validate_every: usize,
    /// Number of unseen objects.
    pub validation_objects: usize,
    /// Steps between checkpoints.
    pub checkpoint_every: usize,
    /// Threads that make samples; by default one fewer than there are cores. The samples do not depend
    /// on it.
    pub loader_threads: Option<usize>,
    /// How weights follow gradients.
    pub optimiser: OptimiserRecipe,
    /// What the samples show.
    pub scene: SceneRecipe,
    /// Keep rendered scenes in a folder and use them again.
    pub cache: Option<CacheRecipe>,
    /// Train on a published set instead of rendered scenes; brightness and camera still come from `scene`.
    pub published: Option<PublishedRecipe>,
}

impl TrainRecipe {
    /// Reads and checks a recipe file; paths in it start at its folder and come out absolute.
    ///
    /// # Errors
    /// [`RunError::File`], [`RunError::Recipe`] or [`RunError::Value`].
    pub fn read(path: &Path) -> Result<Self, TrainError> {
        let text = read_text(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse_in(folder, &path.display().to_string(), &text)?.with_paths_from(path)
    }

    /// Parses and checks a recipe; a genotype file in it is looked for in the current folder.
    ///
    /// # Errors
    /// [`RunError::Recipe`] or [`RunError::Value`]; those of a genotype file.
    pub fn parse(file: &str, text: &str) -> Result<Self, TrainError> {
        Self::parse_in(Path::new(""), file, text)
    }

    /// [`Self::read`] for a recipe of a network whose cells are yet to be chosen; those it has are left out.
    ///
    /// # Errors
    /// As of [`Self::read`].
    pub fn read_without_cells(path: &Path) -> Result<Self, TrainError> {
        let (file, text) = (path.display().to_string(), read_text(path)?);
        let table = genotype::read_table(&file, &text)?;
        Self::from_open_table(&file, table)?.with_paths_from(path)
    }

    fn parse_in(folder: &Path, file: &str, text: &str) -> Result<Self, TrainError> {
        let mut table = genotype::read_table(file, text)?;
        if genotype::read_genotypes(&mut table, folder)? {
            return Self::from_table(file, table);
        }
        // From the text, for errors that show the line.
        let recipe: Self = toml::from_str(text).map_err(|error| genotype::failed(file, &error))?;
        recipe.validate()?;
        if recipe.network.has_open_cells() {
            let reason = "the body of the architecture lacks `genotype`, expected its cells or a file of them";
            return Err(TrainError::Run(RunError::Recipe {
                file: file.to_owned(),
                reason: reason.to_owned(),
            }));
        }
        Ok(recipe)
    }

    /// A checked recipe whose cells are open, see [`Self::read_without_cells`].
    ///
    /// # Errors
    /// [`RunError::Recipe`] or [`RunError::Value`].
    pub fn from_open_table(file: &str, table: toml::Table) -> Result<Self, TrainError> {
        let mut recipe = Self::from_table(file, table)?;
        recipe.network.open_cells();
        Ok(recipe)
    }

    fn from_table(file: &str, table: toml::Table) -> Result<Self, TrainError> {
        let recipe: Self = table
            .try_into()
            .map_err(|error| genotype::failed(file, &error))?;
        recipe.validate()?;
        Ok(recipe)
    }

    /// Relative paths start at the folder of the recipe's file and become absolute: a run may be continued from another
    /// folder than it was begun in.
    pub fn with_paths_from(mut self, file: &Path) -> Result<Self, TrainError> {
        let file = std::path::absolute(file).map_err(|reason| {
            TrainError::Run(RunError::File {
                path: file.to_owned(),
                reason,
            })
        })?;
        let folder = file.parent().unwrap_or(Path::new(""));
        self.scene.resolve_paths(folder);
        let mut paths: Vec<&mut PathBuf> = Vec::new();
        paths.extend(self.published.as_mut().map(|set| &mut set.folder));
        paths.extend(self.cache.as_mut().map(|cache| &mut cache.folder));
        paths.extend(self.network.light_weights_mut());
        paths.extend(self.init.as_mut());
        for path in paths {
            *path = folder.join(&*path);
        }
        Ok(self)
    }

    /// The same with these cells.
    ///
    /// # Errors
    /// [`RunError::Value`] when the network is a plain one, or the genotypes have none of its cells.
    pub fn with_cells(mut self, genotypes: &Genotypes) -> Result<Self, TrainError> {
        let done = self.network.choose_cells(genotypes);
        if done {
            return Ok(self);
        }
        Err(TrainError::Run(RunError::Value {
            field: "genotype",
            found: format!("not for this {} network", self.network.kind().name()),
            expected: "cells of the recipe's network, which must be one of cells",
        }))
    }

    /// The recipe as TOML.
    ///
    /// # Errors
    /// [`RunError::Recipe`], for a path that is not Unicode.
    pub fn to_toml(&self) -> Result<String, TrainError> {
        toml::to_string(self).map_err(|error| {
            TrainError::Run(RunError::Recipe {
                file: "recipe.toml".into(),
                reason: error.to_string(),
            })
        })
    }

    /// Number of trainable parameters of the network that is trained, the auxiliary tower left out.
    pub fn parameters(&self) -> usize {
        self.network.parameters()
    }

    /// Learning rate of a step, from 0.
    pub fn rate(&self, step: usize) -> f32 {
        self.optimiser.rate(step, self.steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_run::differences;

    const GOOD: &str = "network = \"normal\"\nsteps = 10\nsize = 32\n";

    #[test]
    fn bad_recipes_are_refused_with_the_reason() {
        assert!(TrainRecipe::parse("r.toml", GOOD).is_ok());
        for (text, part) in [
            ("stepz = 3\n", "unknown field `stepz`"),
            ("batch = 0\n", "batch is 0, expected 1 to 1024"),
            ("images = [9, 5]\n", "images, fewest is 9"),
            ("loader_threads = 0\n", "loader_threads is 0"),
            ("[optimiser]\nlearning_rate = nan\n", "learning_rate is NaN"),
            ("[normal.lights]\npredicted = 0.5\n", "normal.lights is 1.5"),
            ("[scene.lights]\nrectangle = -1.0\n", "lights"),
            ("[cache]\nfolder = \"c\"\nscenes = 0\n", "cache.scenes is 0"),
            (
                "[cache]\nfolder = \"c\"\nscenes = 9\n[published]\nfolder = \"p\"\n",
                "cache is given beside published",
            ),
        ] {
            let error = TrainRecipe::parse("r.toml", &format!("{GOOD}{text}")).unwrap_err();
            assert!(error.to_string().contains(part), "{error}");
        }
        let cells = "[normal.architecture]\nmask_channel = false\n[normal.architecture.body]\nkind = \"cells\"\n\
                     width = 8\nstem_strides = [1, 2]\nupsampling = \"nearest\"\nfused_convolutions = 1\n";
        let text = format!("{GOOD}{cells}");
        let error = TrainRecipe::parse("r.toml", &text).unwrap_err();
        assert!(error.to_string().contains("lacks `genotype`"), "{error}");
        let open = TrainRecipe::from_open_table("r.toml", read_table("r.toml", &text).unwrap());
        assert!(open.unwrap().network.has_open_cells());
        let light = GOOD.replace("normal", "light");
        let error = TrainRecipe::parse("r.toml", &light).unwrap_err();
        assert!(error.to_string().contains("size is 32"), "{error}");
    }

    #[test]
    fn recipes_are_written_as_they_are_read() {
        let text = format!(
            "{GOOD}init = \"w\"\n[cache]\nfolder = \"c\"\nscenes = 9\n[normal.lights]\n\
             true = 0.2\nperturbed = 0.5\npredicted = 0.3\n"
        );
        let recipe = TrainRecipe::parse("r.toml", &text).unwrap();
        let again = TrainRecipe::parse("r.toml", &recipe.to_toml().unwrap()).unwrap();
        assert_eq!(recipe, again);
        let texts = [recipe, again].map(|recipe| recipe.to_toml().unwrap());
        assert_eq!(differences(&texts[0], &texts[1]).unwrap(), []);
    }

    #[test]
    fn differences_name_key_and_values() {
        let before = TrainRecipe::parse("r.toml", GOOD).unwrap();
        let mut now = before.clone();
        now.optimiser.learning_rate = 0.5;
        now.steps = 20;
        let [before, now] = [before, now].map(|recipe| recipe.to_toml().unwrap());
        let found = differences(&before, &now).unwrap();
        let keys: Vec<_> = found.iter().map(|one| one.key.as_str()).collect();
        assert_eq!(keys, ["optimiser.learning_rate", "steps"]);
        assert!(!crate::FREE.contains(&keys[0]) && crate::FREE.contains(&keys[1]));
        assert_eq!(found[1].to_string(), "steps was 10, is 20");
    }
}
