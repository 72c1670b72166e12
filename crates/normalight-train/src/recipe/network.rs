//! What differs between recipes of the two networks.
use super::{LightSettings, NormalSettings};
use crate::TrainError;
use normalight_model::{
    CellChoice, CellSite, Genotypes, LightBody, NormalBody, light_cell_sites, light_cost,
    normal_cell_sites, normal_cost,
};
use normalight_run::RunError;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Side in pixels of the whole objects that normals are validated on.
const VALIDATION_PIXELS: usize = 96;

/// The two networks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Network {
    /// The light calibration network.
    Light,
    /// The normal estimation network.
    Normal,
}

impl Network {
    /// The word for it: `light` or `normal`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Normal => "normal",
        }
    }
}

/// Which network a recipe trains, with its settings.
#[derive(Debug, Clone, PartialEq)]
pub enum NetworkRecipe {
    /// The light calibration network.
    Light(LightSettings),
    /// The normal estimation network.
    Normal(NormalSettings),
}

impl NetworkRecipe {
    /// Which one.
    pub fn kind(&self) -> Network {
        match self {
            Self::Light(_) => Network::Light,
            Self::Normal(_) => Network::Normal,
        }
    }

    /// Number of trainable parameters, the auxiliary tower left out.
    pub fn parameters(&self) -> usize {
        match self {
            Self::Light(settings) => light_cost(&settings.architecture).parameters,
            Self::Normal(settings) => normal_cost(&settings.architecture, 0).parameters,
        }
    }

    /// Multiply-adds for a stack of `images` images of `size` times `size` pixels.
    pub fn multiply_adds(&self, images: usize, size: usize) -> u64 {
        let cost = match self {
            Self::Light(settings) => light_cost(&settings.architecture),
            Self::Normal(settings) => normal_cost(&settings.architecture, size * size),
        };
        cost.multiply_adds(images)
    }

    /// Base width: channels of the first layer of a plain network or one of stages, of the nodes of the
    /// first cells.
    pub fn width(&self) -> usize {
        match self {
            Self::Light(settings) => match &settings.architecture.body {
                LightBody::Plain(plain) => plain.widths[0],
                LightBody::Cells(cells) => cells.width,
                LightBody::Staged(staged) => staged.features[0].width,
            },
            Self::Normal(settings) => match &settings.architecture.body {
                NormalBody::Plain(plain) => plain.widths[0],
                NormalBody::Cells(cells) => cells.width,
                NormalBody::Staged(staged) => staged.down[0].width,
            },
        }
    }

    /// Width of the cells, where the network is made of cells.
    pub fn cell_width_mut(&mut self) -> Option<&mut usize> {
        match self {
            Self::Light(settings) => match &mut settings.architecture.body {
                LightBody::Plain(_) | LightBody::Staged(_) => None,
                LightBody::Cells(cells) => Some(&mut cells.width),
            },
            Self::Normal(settings) => match &mut settings.architecture.body {
                NormalBody::Plain(_) | NormalBody::Staged(_) => None,
                NormalBody::Cells(cells) => Some(&mut cells.width),
            },
        }
    }

    /// Whether the network is made of cells.
    pub fn has_cells(&self) -> bool {
        match self {
            Self::Light(settings) => matches!(settings.architecture.body, LightBody::Cells(_)),
            Self::Normal(settings) => matches!(settings.architecture.body, NormalBody::Cells(_)),
        }
    }

    /// Where its cells stand, for pictures of `size` times `size` pixels.
    pub fn cell_sites(&self, size: usize) -> Vec<CellSite> {
        let area = size * size;
        match self {
            Self::Light(settings) => match &settings.architecture.body {
                LightBody::Cells(cells) => light_cell_sites(cells, area).concat(),
                LightBody::Plain(_) | LightBody::Staged(_) => Vec::new(),
            },
            Self::Normal(settings) => match &settings.architecture.body {
                NormalBody::Cells(cells) => normal_cell_sites(cells, area).concat(),
                NormalBody::Plain(_) | NormalBody::Staged(_) => Vec::new(),
            },
        }
    }

    /// Gives a network of cells its own of these; tells whether there are such, and a place for them.
    pub(super) fn choose_cells(&mut self, genotypes: &Genotypes) -> bool {
        match self {
            Self::Light(settings) => match (&mut settings.architecture.body, &genotypes.light) {
                (LightBody::Cells(cells), Some(genotype)) => {
                    cells.genotype = genotype.clone().into();
                    true
                }
                _ => false,
            },
            Self::Normal(settings) => match (&mut settings.architecture.body, &genotypes.normal) {
                (NormalBody::Cells(cells), Some(genotype)) => {
                    cells.genotype = genotype.clone().into();
                    true
                }
                _ => false,
            },
        }
    }

    /// Forgets the cells of a network of cells: a search finds them, or a comparison brings its own.
    pub fn open_cells(&mut self) {
        match self {
            Self::Light(settings) => {
                if let LightBody::Cells(cells) = &mut settings.architecture.body {
                    cells.genotype = CellChoice::Open;
                }
            }
            Self::Normal(settings) => {
                if let NormalBody::Cells(cells) = &mut settings.architecture.body {
                    cells.genotype = CellChoice::Open;
                }
            }
        }
    }

    /// Whether it is a network of cells that are yet to be chosen.
    pub fn has_open_cells(&self) -> bool {
        match self {
            Self::Light(settings) => match &settings.architecture.body {
                LightBody::Cells(cells) => cells.genotype.is_open(),
                LightBody::Plain(_) | LightBody::Staged(_) => false,
            },
            Self::Normal(settings) => match &settings.architecture.body {
                NormalBody::Cells(cells) => cells.genotype.is_open(),
                NormalBody::Plain(_) | NormalBody::Staged(_) => false,
            },
        }
    }

    /// The file of the light network that predicts lights, where the recipe names one.
    pub(super) fn light_weights_mut(&mut self) -> Option<&mut PathBuf> {
        match self {
            Self::Light(_) => None,
            Self::Normal(settings) => settings.lights.light_weights.as_mut(),
        }
    }

    /// Side in pixels of the objects to validate on, where training pictures have `size`: normals on whole objects,
    /// whatever the crops to train on are.
    pub fn validation_pixels(&self, size: usize) -> usize {
        match self {
            Self::Light(_) => size,
            Self::Normal(_) => VALIDATION_PIXELS,
        }
    }

    /// Checks every number. `size`: side of the training pictures.
    pub(super) fn validate(&self, size: usize) -> Result<(), TrainError> {
        let expected = match self {
            Self::Light(settings) => {
                settings.validate()?;
                (size != settings.architecture.input_size)
                    .then_some("the light network's input_size")
            }
            Self::Normal(settings) => {
                settings.validate()?;
                (!size.is_multiple_of(8)).then_some("a multiple of 8")
            }
        };
        match expected {
            None => Ok(()),
            Some(expected) => Err(TrainError::Run(RunError::Value {
                field: "size",
                found: size.to_string(),
                expected,
            })),
        }
    }
}
