use crate::genotype::MAX_NODES;
use crate::{ModelError, Operation};
use serde::{Deserialize, Serialize};

/// What a search chooses among.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SearchSpace {
    /// Candidates on every edge, at least one besides zero.
    pub operations: Vec<Operation>,
    /// Nodes of every cell; each reads both cell inputs and all earlier nodes until two edges are chosen.
    pub nodes: usize,
    /// While searching, one in so many channels goes through the operations, the others pass by; 1: all do.
    pub channel_divisor: usize,
}

impl Default for SearchSpace {
    /// All operations, four nodes.
    fn default() -> Self {
        Self {
            operations: Operation::ALL.to_vec(),
            nodes: 4,
            channel_divisor: 1,
        }
    }
}

impl SearchSpace {
    /// All edges of a relaxed cell as (node, input), in the order of the relaxation's weights.
    pub fn edges(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.nodes).flat_map(|node| (0..2 + node).map(move |from| (node, from)))
    }

    /// Checks ranges.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub fn validate(&self) -> Result<(), ModelError> {
        let failed = |what: &str, found: String, expected: String| ModelError::Architecture {
            what: format!("search space: {what}"),
            found,
            expected,
        };
        if !(1..=MAX_NODES).contains(&self.nodes) {
            let expected = format!("1 to {MAX_NODES}");
            return Err(failed("nodes", self.nodes.to_string(), expected));
        }
        if !(1..=16).contains(&self.channel_divisor) {
            let found = self.channel_divisor.to_string();
            return Err(failed("channel_divisor", found, "1 to 16".into()));
        }
        let names = || {
            let names: Vec<_> = self.operations.iter().map(|one| one.name()).collect();
            format!("{names:?}")
        };
        if self.operations.iter().all(|one| *one == Operation::Zero) {
            return Err(failed("operations", names(), "one besides zero".into()));
        }
        let mut unique = self.operations.clone();
        unique.sort_by_key(|one| one.name());
        unique.dedup();
        if unique.len() != self.operations.len() {
            return Err(failed("operations", names(), "each once".into()));
        }
        Ok(())
    }

    /// Checks ranges, and that networks of this width can be divided as asked.
    ///
    /// # Errors
    /// [`ModelError::Architecture`].
    pub(crate) fn validate_for(&self, width: usize) -> Result<(), ModelError> {
        self.validate()?;
        if width.is_multiple_of(self.channel_divisor) {
            return Ok(());
        }
        Err(ModelError::Architecture {
            what: "width of a searched network".into(),
            found: width.to_string(),
            expected: format!("a multiple of channel_divisor, {}", self.channel_divisor),
        })
    }
}
