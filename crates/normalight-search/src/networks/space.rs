//! What networks are drawn from.
use crate::random::below;
use normalight_model::{
    LayerKind, LightBody, Meeting, NormalBody, PixelStage, Stage, StagedLight, StagedNormal,
};
use normalight_run::{RunError, check};
use normalight_train::{Network, NetworkRecipe, TrainError, TrainRecipe};
use rand_pcg::Pcg32;
use serde::{Deserialize, Serialize};

/// Ranges of everything that a network of stages has.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NetworkSpace {
    /// Channels of a stage.
    pub widths: Vec<usize>,
    /// Most layers of a stage.
    pub most_layers: usize,
    /// Most halvings of the size of a normal network.
    pub most_halvings: usize,
    /// What the layers of a stage may be.
    pub kinds: Vec<LayerKind>,
    /// Most exchanges between the images of a normal network.
    pub most_exchanges: usize,
    /// Channels of a normal network's branch of single pixels; 0 is none.
    pub pixel_widths: Vec<usize>,
    /// Units of a light network's hidden layer.
    pub hidden: Vec<usize>,
    /// Sides of training pictures: crops for a normal network (of which a batch then holds as many as make as many pixels),
    /// views for a light network. Empty: the recipe's.
    pub sizes: Vec<usize>,
}

impl Default for NetworkSpace {
    fn default() -> Self {
        Self {
            widths: vec![8, 16, 24, 32, 48, 64, 96, 128],
            most_layers: 4,
            most_halvings: 3,
            kinds: LayerKind::SEARCHED.to_vec(),
            most_exchanges: 1,
            pixel_widths: vec![0, 8, 16, 32],
            hidden: vec![32, 64, 128, 256],
            sizes: Vec::new(),
        }
    }
}

/// The layers of a candidate, of either network.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NetworkBody {
    /// Of a light network.
    Light(StagedLight),
    /// Of a normal network.
    Normal(StagedNormal),
}

/// A network of the space, and the pictures that it is trained on.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Candidate {
    /// Side of training pictures in pixels; the recipe's where missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<usize>,
    /// Its layers.
    pub body: NetworkBody,
}

impl Candidate {
    /// The recipe with this network in place of its own.
    ///
    /// # Errors
    /// [`RunError::Value`] for a recipe of the other network.
    pub fn trained_as(&self, recipe: &TrainRecipe) -> Result<TrainRecipe, TrainError> {
        let mut recipe = recipe.clone();
        let size = self.size.unwrap_or(recipe.size);
        match (&mut recipe.network, &self.body) {
            (NetworkRecipe::Light(settings), NetworkBody::Light(staged)) => {
                settings.architecture.body = LightBody::Staged(staged.clone());
                settings.architecture.input_size = size;
            }
            (NetworkRecipe::Normal(settings), NetworkBody::Normal(staged)) => {
                settings.architecture.body = NormalBody::Staged(staged.clone());
                let pixels = recipe.batch * recipe.size * recipe.size;
                recipe.batch = (pixels / (size * size)).max(1);
            }
            (network, _) => {
                return Err(TrainError::Run(RunError::Value {
                    field: "network",
                    found: network.kind().name().to_owned(),
                    expected: "the network of the candidate",
                }));
            }
        }
        recipe.size = size;
        Ok(recipe)
    }
}

impl NetworkSpace {
    pub(super) fn validate(&self) -> Result<(), TrainError> {
        for (field, values, least) in [
            ("search.widths", &self.widths, 1),
            ("search.pixel_widths", &self.pixel_widths, 0),
            ("search.hidden", &self.hidden, 1),
        ] {
            check(field, values.len(), 1..=64, "1 to 64 of them")?;
            for &value in values {
                check(field, value, least..=1024, "numbers up to 1024")?;
            }
        }
        check("search.sizes", self.sizes.len(), 0..=64, "up to 64 of them")?;
        check("search.kinds", self.kinds.len(), 1..=4, "1 to 4 of them")?;
        check("search.most_layers", self.most_layers, 1..=8, "1 to 8")?;
        check("search.most_halvings", self.most_halvings, 1..=3, "1 to 3")?;
        let exchanges = self.most_exchanges;
        Ok(check("search.most_exchanges", exchanges, 0..=2, "0 to 2")?)
    }

    /// One network, each setting drawn evenly from its range; widths do not shrink on the way down.
    pub(super) fn draw(&self, network: Network, random: &mut Pcg32) -> Candidate {
        let body = match network {
            Network::Normal => NetworkBody::Normal(self.normal(random)),
            Network::Light => NetworkBody::Light(self.light(random)),
        };
        let size = (!self.sizes.is_empty()).then(|| pick(&self.sizes, random));
        Candidate { size, body }
    }

    fn normal(&self, random: &mut Pcg32) -> StagedNormal {
        let halvings = 1 + below(self.most_halvings, random);
        let ups = below(halvings + 1, random);
        let normalised = below(2, random) == 1;
        let mut widths: Vec<usize> = (0..=halvings).map(|_| self.width(random)).collect();
        widths.sort_unstable();
        let mut down: Vec<Stage> = Vec::new();
        for width in widths {
            down.push(self.stage(width, normalised, random));
        }
        // The first layers see colours and lights at full size: the dearest of all.
        down[0].layers = 1 + below(2, random);
        let row = |count: usize, random: &mut Pcg32| -> Vec<Stage> {
            let mut widths: Vec<usize> = (0..count).map(|_| self.width(random)).collect();
            widths.sort_unstable_by(|a, b| b.cmp(a));
            let stages = widths.into_iter();
            stages
                .map(|width| self.stage(width, normalised, random))
                .collect()
        };
        let up = row(ups, random);
        let fused = row(1 + halvings - ups, random);
        let pixel_width = pick(&self.pixel_widths, random);
        StagedNormal {
            down,
            up,
            meeting: pick(&[Meeting::Max, Meeting::MaxMean], random),
            exchanges: below(self.most_exchanges + 1, random),
            fused,
            pixels: (pixel_width > 0).then(|| PixelStage {
                width: pixel_width,
                layers: 1 + below(3, random),
            }),
        }
    }

    fn light(&self, random: &mut Pcg32) -> StagedLight {
        let normalised = below(2, random) == 1;
        let mut widths: Vec<usize> = (0..2 + below(3, random))
            .map(|_| self.width(random))
            .collect();
        widths.sort_unstable();
        let row = |widths: Vec<usize>, random: &mut Pcg32| -> Vec<Stage> {
            let stages = widths.into_iter();
            stages
                .map(|width| self.stage(width, normalised, random))
                .collect()
        };
        let features = row(widths, random);
        let classifier = (0..1 + below(3, random))
            .map(|_| self.width(random))
            .collect();
        StagedLight {
            features,
            classifier: row(classifier, random),
            hidden: pick(&self.hidden, random),
        }
    }

    fn width(&self, random: &mut Pcg32) -> usize {
        pick(&self.widths, random)
    }

    fn stage(&self, width: usize, normalised: bool, random: &mut Pcg32) -> Stage {
        Stage {
            width,
            layers: 1 + below(self.most_layers, random),
            kind: pick(&self.kinds, random),
            residual: below(2, random) == 1,
            normalised,
        }
    }
}

fn pick<T: Copy>(among: &[T], random: &mut Pcg32) -> T {
    among[below(among.len(), random)]
}
