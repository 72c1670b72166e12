//! The layout of a recipe's file: both networks' tables stand beside `network`, which says whose counts.
use super::{
    CacheRecipe, LightSettings, Network, NetworkRecipe, NormalSettings, PublishedRecipe,
    TrainRecipe,
};
use normalight_run::OptimiserRecipe;
use normalight_synth::SceneRecipe;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// [`TrainRecipe`] as TOML has it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stored {
    network: Network,
    steps: usize,
    #[serde(default = "defaults::batch")]
    batch: usize,
    #[serde(default = "defaults::images")]
    images: [usize; 2],
    size: usize,
    #[serde(default)]
    seed: u64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    init: Option<PathBuf>,
    #[serde(default = "defaults::validate_every")]
    validate_every: usize,
    #[serde(default = "defaults::validation_objects")]
    validation_objects: usize,
    #[serde(default = "defaults::checkpoint_every")]
    checkpoint_every: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    loader_threads: Option<usize>,
    #[serde(default)]
    optimiser: OptimiserRecipe,
    #[serde(default)]
    scene: SceneRecipe,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    cache: Option<CacheRecipe>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    published: Option<PublishedRecipe>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    light: Option<LightSettings>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    normal: Option<NormalSettings>,
}

mod defaults {
    pub(super) fn batch() -> usize {
        16
    }
    pub(super) fn images() -> [usize; 2] {
        [6, 16]
    }
    pub(super) fn validate_every() -> usize {
        250
    }
    pub(super) fn validation_objects() -> usize {
        24
    }
    pub(super) fn checkpoint_every() -> usize {
        100
    }
}

impl TryFrom<Stored> for TrainRecipe {
    type Error = String;

    /// # Errors
    /// Settings of the network that is not trained: whoever wrote them expects something of them.
    fn try_from(stored: Stored) -> Result<Self, String> {
        let other = |name: &str| {
            Err(format!(
                "settings of the {name} network are given, expected none where network is \"{}\"",
                stored.network.name()
            ))
        };
        let network = match stored.network {
            // Earlier versions wrote the other network's defaults along.
            Network::Light
                if stored
                    .normal
                    .as_ref()
                    .is_none_or(|one| *one == NormalSettings::default()) =>
            {
                NetworkRecipe::Light(stored.light.unwrap_or_default())
            }
            Network::Normal
                if stored
                    .light
                    .as_ref()
                    .is_none_or(|one| *one == LightSettings::default()) =>
            {
                NetworkRecipe::Normal(stored.normal.unwrap_or_default())
            }
            Network::Light => return other("normal"),
            Network::Normal => return other("light"),
        };
        Ok(Self {
            network,
            steps: stored.steps,
            batch: stored.batch,
            images: stored.images,
            size: stored.size,
            seed: stored.seed,
            init: stored.init,
            validate_every: stored.validate_every,
            validation_objects: stored.validation_objects,
            checkpoint_every: stored.checkpoint_every,
            loader_threads: stored.loader_threads,
            optimiser: stored.optimiser,
            scene: stored.scene,
            cache: stored.cache,
            published: stored.published,
        })
    }
}

impl From<TrainRecipe> for Stored {
    fn from(recipe: TrainRecipe) -> Self {
        let network = recipe.network.kind();
        let (light, normal) = match recipe.network {
            NetworkRecipe::Light(settings) => (Some(settings), None),
            NetworkRecipe::Normal(settings) => (None, Some(settings)),
        };
        Self {
            network,
            steps: recipe.steps,
            batch: recipe.batch,
            images: recipe.images,
            size: recipe.size,
            seed: recipe.seed,
            init: recipe.init,
            validate_every: recipe.validate_every,
            validation_objects: recipe.validation_objects,
            checkpoint_every: recipe.checkpoint_every,
            loader_threads: recipe.loader_threads,
            optimiser: recipe.optimiser,
            scene: recipe.scene,
            cache: recipe.cache,
            published: recipe.published,
            light,
            normal,
        }
    }
}
