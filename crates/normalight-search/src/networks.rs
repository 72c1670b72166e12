//! The search of whole networks: widths, depths, kinds of layers and where images meet, by successive halving of random ones.
mod front;
mod halving;
mod recipe;
mod result;
mod space;

pub use halving::{NetworkSearchEvent, NetworkSearchRun, search_networks};
pub use recipe::{Goal, NetworkSearchRecipe, NetworkSearchSettings};
pub use result::{CandidateResult, NetworkSearchResult, Rung};
pub use space::{Candidate, NetworkBody, NetworkSpace};
