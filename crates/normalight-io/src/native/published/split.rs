//! Which objects train and which validate.
use super::{PublishedEntry, PublishedSet, TRAIN_LIST};
use crate::IoError;
use crate::native::files::display;
use sha2::{Digest, Sha256};

/// Two lists without a common entry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PublishedSplit {
    /// Entries to train on.
    pub train: Vec<PublishedEntry>,
    /// Entries to validate on.
    pub validation: Vec<PublishedEntry>,
}

impl PublishedSet {
    /// A small part of the training list for a search over architectures; `share` 0.1, at 64x64
    /// pixels ([`resized`](super::PublishedObject::resized)), is the published choice.
    ///
    /// A fifth of the shapes validates, at least one, and the others train: no shape is in both.
    /// Of the entries of either part `share` is taken (from 0 to 1), at least one. Which ones, and
    /// in what order, depends on the seed and on the names alone, not on the order of the list.
    ///
    /// # Errors
    /// [`IoError::SetFormat`] for a set of fewer than two shapes.
    pub fn search_split(&self, seed: u64, share: f64) -> Result<PublishedSplit, IoError> {
        let mut shapes: Vec<&str> = self.train.iter().map(PublishedEntry::shape).collect();
        shapes.sort_unstable();
        shapes.dedup();
        if shapes.len() < 2 {
            return Err(self.too_small("one shape", "two shapes or more to part"));
        }
        shapes.sort_by_cached_key(|shape| lot(seed, shape));
        let validating = (shapes.len() as f64 / 5.0).round().max(1.0) as usize;
        let part = |shapes: &[&str]| {
            let mut entries = drawn(seed, &self.train);
            entries.retain(|entry| shapes.contains(&entry.shape()));
            let kept = (entries.len() as f64 * share.clamp(0.0, 1.0)).ceil();
            entries.truncate((kept as usize).max(1));
            entries
        };
        let (validation, train) = shapes.split_at(validating);
        Ok(PublishedSplit {
            train: part(train),
            validation: part(validation),
        })
    }

    /// The whole set for training: the lists as they are when there are entries in `val_mtrl.txt`.
    ///
    /// Otherwise one of a hundred entries of `train_mtrl.txt` validates, at least one; which ones,
    /// and the order, depend on the seed and on the names alone. A shape may then be in both parts,
    /// in different materials.
    ///
    /// # Errors
    /// [`IoError::SetFormat`] for a set of one entry and none to validate on.
    pub fn train_split(&self, seed: u64) -> Result<PublishedSplit, IoError> {
        if !self.val.is_empty() {
            return Ok(PublishedSplit {
                train: self.train.clone(),
                validation: self.val.clone(),
            });
        }
        let mut validation = drawn(seed, &self.train);
        if validation.len() < 2 {
            return Err(self.too_small("one entry", "two entries or more to part"));
        }
        let validating = (validation.len() as f64 / 100.0).round().max(1.0) as usize;
        let train = validation.split_off(validating);
        Ok(PublishedSplit { train, validation })
    }

    fn too_small(&self, found: &str, expected: &str) -> IoError {
        IoError::SetFormat {
            name: display(&self.root.join(TRAIN_LIST)),
            found: found.to_owned(),
            expected: expected.to_owned(),
        }
    }
}

/// The entries, each once, in an order that the seed decides.
fn drawn(seed: u64, entries: &[PublishedEntry]) -> Vec<PublishedEntry> {
    let mut entries = entries.to_vec();
    entries.sort_unstable();
    entries.dedup();
    entries.sort_by_cached_key(|entry| lot(seed, &entry.to_string()));
    entries
}

/// A number drawn for a name.
fn lot(seed: u64, name: &str) -> [u8; 32] {
    let hash = Sha256::new().chain_update(seed.to_le_bytes());
    hash.chain_update(name).finalize().into()
}
