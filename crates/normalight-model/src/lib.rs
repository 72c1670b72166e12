//! The networks of Normalight and the way from photographs to lights and normals.
//!
//! No backend is chosen here: every entry point takes a Burn [`Device`](burn::tensor::Device). The crate's examples go
//! from files, from photographs in memory and from given lights to an [`Estimate`]; in short:
//!
//! ```no_run
//! use burn::tensor::Device;
//! use normalight_core::{ImageStack, Mask};
//! use normalight_model::{
//!     EstimateInput, EstimateSettings, Estimator, ModelError, NoopObserver, default_weights,
//! };
//!
//! fn estimate(stack: &ImageStack, mask: &Mask) -> Result<(), ModelError> {
//!     let [light, normal] = default_weights()?;
//!     let estimator = Estimator::new(&light, &normal, Device::flex())?;
//!     let settings = EstimateSettings::default();
//!     let mut observer = NoopObserver;
//!     let input = EstimateInput { stack, mask, lights: None };
//!     let running = estimator.estimate(input, settings, &mut observer);
//!     let estimate = pollster::block_on(running)?;
//!     println!("{:?}", estimate.lights);
//!     Ok(())
//! }
//! ```
//!
//! The shipped weights are part of the crate:
//!
//! ```
//! let [light, normal] = normalight_model::default_weights()?;
//! assert_eq!(light.hash().len(), 64);
//! assert_ne!(light.hash(), normal.hash());
//! # Ok::<(), normalight_model::ModelError>(())
//! ```
#![deny(missing_docs)]
#![allow(
    clippy::large_enum_variant,
    reason = "layers are few and live as long as their network; boxes would only add noise"
)]

mod architecture;
mod auxiliary_tower;
mod cell;
mod cell_choice;
mod cell_site;
mod cost;
mod defaults;
mod error;
mod estimator;
mod genotype;
mod header;
mod helpers;
mod input;
mod layers;
mod light_network;
mod light_stage;
mod light_view;
mod loaded;
mod mixed_edge;
mod normal_network;
mod normal_stage;
mod observer;
mod operation;
mod outline;
mod relaxation;
mod search_space;
mod stage_layers;
mod staged;
mod weights;

pub use architecture::{
    Architecture, CellLight, CellNormal, LightArchitecture, LightBody, NormalArchitecture,
    NormalBody, PlainLight, PlainNormal, Upsampling,
};
pub use auxiliary_tower::AuxiliaryTower;
pub use cell_choice::CellChoice;
pub use cell_site::{CellSite, light_cell_sites, normal_cell_sites};
pub use cost::{Cost, NetworkCost, light_cost, normal_cost, operation_cost};
pub use defaults::{default_weights, expect_default_weights, paper_genotypes};
pub use error::ModelError;
pub use estimator::{EstimateInput, Estimator};
pub use genotype::{Cell, Edge, Genotypes, LightGenotype, NormalGenotype, Operation};
pub use helpers::{Helpers, NoHelpers, Parcel};
pub use input::{LightInput, NormalInput};
pub use layers::LEAK;
pub use light_network::LightNetwork;
pub use light_stage::LightOptions;
pub use light_view::LightView;
pub use loaded::{LoadedLightNetwork, LoadedNetwork, LoadedNormalNetwork};
pub use normal_network::{FusedFeatures, NormalNetwork};
pub use normal_stage::{AveragedNormals, Helped};
pub use normalight_core::{Estimate, EstimateSettings, Quality};
pub use observer::{NoopObserver, Observer, PipelineStage, Progress, StageTimes};
pub use operation::OperationLayer;
pub use outline::{Outline, OutlineLayer};
pub use relaxation::{CellWeights, Relaxation};
pub use search_space::SearchSpace;
pub use staged::{LayerKind, Meeting, PixelStage, Stage, StagedLight, StagedNormal};
pub use weights::Weights;
