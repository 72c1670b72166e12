use crate::Disturbance;
use normalight_core::spread_indices;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

/// Which photographs of an object are used, and how good they are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Photographs {
    /// How many; `None` or more than there are: all.
    pub images: Option<usize>,
    /// `None`: spread over all of them; otherwise the number of a random choice.
    pub subset: Option<u64>,
    /// What is done to them.
    pub disturbance: Option<Disturbance>,
}

impl Photographs {
    /// All of them.
    pub const ALL: Self = Self {
        images: None,
        subset: None,
        disturbance: None,
    };

    /// Which they are, in words.
    pub fn words(self) -> String {
        let mut words = self
            .images
            .map_or("all images".to_owned(), |images| format!("{images} images"));
        if let Some(subset) = self.subset {
            words += &format!(", random choice {}", subset + 1);
        }
        if let Some(disturbance) = self.disturbance {
            words += &format!(", {}", disturbance.words());
        }
        words
    }

    /// Their indices among `total`, in order.
    ///
    /// A random choice is the same for all objects with as many photographs.
    pub fn indices(self, total: usize) -> Vec<usize> {
        let count = self.images.map_or(total, |images| images.min(total));
        let Some(subset) = self.subset.filter(|_| count < total) else {
            return spread_indices(total, count);
        };
        let mut random = Pcg64::seed_from_u64(subset);
        let mut indices: Vec<usize> = (0..total).collect();
        for place in 0..count {
            let left = (total - place) as u64;
            // The remainder of 64 random bits favours no index by more than one in 2^50.
            let drawn = place + (random.next_u64() % left) as usize;
            indices.swap(place, drawn);
        }
        indices.truncate(count);
        indices.sort_unstable();
        indices
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_differ_repeat_and_favour_nobody() {
        let choose = |subset| {
            let choice = Photographs {
                images: Some(3),
                subset: Some(subset),
                disturbance: None,
            };
            choice.indices(8)
        };
        assert_eq!(choose(5), choose(5));
        let mut counts = [0; 8];
        for subset in 0..4000 {
            let indices = choose(subset);
            assert!(indices.len() == 3 && indices.is_sorted_by(|a, b| a < b));
            for index in indices {
                counts[index] += 1;
            }
        }
        // 1500 expected; the standard deviation is 31.
        assert!(counts.iter().all(|count| (1350..1650).contains(count)));
    }

    #[test]
    fn all_and_spread() {
        assert_eq!(Photographs::ALL.indices(4), [0, 1, 2, 3]);
        let more = Photographs {
            images: Some(9),
            subset: Some(1),
            disturbance: None,
        };
        assert_eq!(more.indices(4), [0, 1, 2, 3]);
        let two = Photographs {
            images: Some(2),
            subset: None,
            disturbance: None,
        };
        assert_eq!(two.indices(4), spread_indices(4, 2));
    }
}
