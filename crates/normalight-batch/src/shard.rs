//! Which captures, or whatever else is in a fixed order, are one machine's.
use std::fmt;
use std::num::NonZeroUsize;
use std::str::FromStr;

/// One part of several of all captures: every so-manieth in the order of their paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Which part, from 1.
    index: usize,
    of: NonZeroUsize,
}

/// A text that names no shard.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("found {found:?}, expected I/N with I from 1 to N, as in 2/5")]
pub struct ShardError {
    /// The text.
    pub found: String,
}

impl Shard {
    /// All captures.
    pub const WHOLE: Self = Self {
        index: 1,
        of: NonZeroUsize::MIN,
    };

    /// Part `index` (from 1) of `of`; `None` where there is no such part.
    pub fn new(index: usize, of: usize) -> Option<Self> {
        let of = NonZeroUsize::new(of)?;
        (1..=of.get())
            .contains(&index)
            .then_some(Self { index, of })
    }

    /// Which part, from 1.
    pub fn index(self) -> usize {
        self.index
    }

    /// Number of parts.
    pub fn of(self) -> usize {
        self.of.get()
    }

    /// Whether these are all captures.
    pub fn is_whole(self) -> bool {
        self.of() == 1
    }

    /// Whether the capture at this position of the order, from 0, is one of them.
    pub fn takes(self, position: usize) -> bool {
        position % self.of == self.index - 1
    }

    /// As it stands in names of files: `2-of-5`.
    pub(crate) fn name(self) -> String {
        format!("{}-of-{}", self.index, self.of)
    }

    /// The opposite of [`Shard::name`].
    pub(crate) fn of_name(name: &str) -> Option<Self> {
        let (index, of) = name.split_once("-of-")?;
        Self::new(index.parse().ok()?, of.parse().ok()?)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Shard {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        let parts = text
            .split_once('/')
            .and_then(|(index, of)| Self::new(index.trim().parse().ok()?, of.trim().parse().ok()?));
        parts.ok_or_else(|| ShardError {
            found: text.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_capture_is_in_one_shard() {
        let shards: Vec<Shard> = (1..=3).map(|k| Shard::new(k, 3).unwrap()).collect();
        for position in 0..10 {
            let takers = shards.iter().filter(|shard| shard.takes(position));
            assert_eq!(takers.count(), 1);
        }
        assert!((0..10).all(|position| Shard::WHOLE.takes(position)));
    }

    #[test]
    fn texts_and_names() {
        let shard: Shard = "2/5".parse().unwrap();
        assert_eq!(shard.to_string(), "2/5");
        assert_eq!(Shard::of_name(&shard.name()), Some(shard));
        for wrong in ["0/5", "6/5", "1/0", "1", "", "a/b", "-1/2", "1/2/3"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
        assert_eq!(Shard::of_name("6-of-5"), None);
    }
}
