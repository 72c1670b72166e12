//! The search of whole networks: widths, depths, kinds of layers and where images meet, by successive halving of random ones.
mod candidates;
mod front;
mod halving;
mod part;
mod recipe;
mod result;
mod space;
mod times;

pub use halving::{NetworkSearchEvent, NetworkSearchRun, search_networks};
pub use part::{RoundPart, search_part};
pub use recipe::{Goal, NetworkSearchRecipe, NetworkSearchSettings};
pub use result::{CandidateResult, NetworkSearchResult, Rung};
pub use space::{Candidate, NetworkBody, NetworkSpace};
