//! Architecture search: a relaxed network, its bi-level optimisation, and what is derived from it.
#![deny(missing_docs)]

mod bilevel;
mod budget;
mod card;
mod compare;
mod derive;
mod drawing;
mod folder;
mod history;
mod learner;
mod networks;
mod random;
mod recipe;
mod run;
mod samples;
#[cfg(feature = "bench")]
mod speed;
mod task;

pub use budget::{Budget, Measure, OperationTime, OperationTimes};
pub use compare::{
    CompareEvent, CompareRun, Comparison, EntryKind, EntryResult, Equal, Group, SeedResult, compare,
};
pub use drawing::network_drawings;
pub use networks::{
    Candidate, CandidateResult, Goal, NetworkBody, NetworkSearchEvent, NetworkSearchRecipe,
    NetworkSearchResult, NetworkSearchRun, NetworkSearchSettings, NetworkSpace, RoundPart, Rung,
    search_networks, search_part,
};
pub use random::random_genotypes;
pub use recipe::{AlphaRecipe, Order, SearchRecipe, SearchSettings};
pub use run::{SearchRun, derive_again, search};
#[cfg(feature = "bench")]
pub use speed::SearchStep;
use task::SearchTask;
