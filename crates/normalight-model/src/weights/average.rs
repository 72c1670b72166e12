//! The mean of several trainings' weights.
use super::Weights;
use super::encode::{HalfTensors, file_of, half};
use crate::ModelError;
use std::collections::BTreeMap;

/// Entry of a weights file that names what it is the mean of.
const AVERAGE_OF: &str = "average_of";

impl Weights {
    /// Bytes of a weights file that holds the mean of every number. Trainings that went on from one start, or the ends of
    /// one training's restarts, lie so close together that their mean is better than each of them (Izmailov et al. 2018,
    /// "Averaging weights leads to wider optima and better generalization"); [`Self::closeness`] says whether these do.
    ///
    /// # Errors
    /// [`ModelError::OtherArchitecture`] or [`ModelError::Tensor`] for networks of different shapes,
    /// [`ModelError::Architecture`] for none at all.
    pub fn average(several: &[Self]) -> Result<Vec<u8>, ModelError> {
        let Some((first, others)) = several.split_first() else {
            return Err(ModelError::Architecture {
                what: "weights to average".into(),
                found: "none".into(),
                expected: "one file or more".into(),
            });
        };
        for other in others {
            first.check_same(other)?;
        }
        let mut tensors = HalfTensors::new();
        for (name, (shape, values)) in &first.tensors {
            let mut sums: Vec<f64> = values.iter().map(|&value| f64::from(value)).collect();
            for (_, more) in others.iter().filter_map(|other| other.tensors.get(name)) {
                for (sum, &value) in sums.iter_mut().zip(more) {
                    *sum += f64::from(value);
                }
            }
            let means = sums.iter().map(|sum| (sum / several.len() as f64) as f32);
            tensors.insert(name.clone(), (shape.clone(), half(means)));
        }
        let hashes: Vec<&str> = several.iter().map(Self::hash).collect();
        let notes = BTreeMap::from([(AVERAGE_OF.to_owned(), hashes.join(" "))]);
        file_of(&first.architecture, &tensors, &notes)
    }

    /// Cosine between the numbers of two networks, -1 to 1: near 1 after trainings from one start, near 0 for trainings from
    /// different random numbers, whose mean is no better than noise.
    ///
    /// # Errors
    /// As of [`Self::average`].
    pub fn closeness(&self, other: &Self) -> Result<f64, ModelError> {
        self.check_same(other)?;
        let (mut product, mut squares) = (0.0, [0.0; 2]);
        for (name, (_, ours)) in &self.tensors {
            let Some((_, theirs)) = other.tensors.get(name) else {
                continue;
            };
            for (&a, &b) in ours.iter().zip(theirs) {
                let (a, b) = (f64::from(a), f64::from(b));
                product += a * b;
                squares[0] += a * a;
                squares[1] += b * b;
            }
        }
        Ok(product / (squares[0] * squares[1]).sqrt().max(f64::MIN_POSITIVE))
    }

    /// Whether two networks differ in nothing but their numbers.
    fn check_same(&self, other: &Self) -> Result<(), ModelError> {
        if self.architecture != other.architecture {
            return Err(ModelError::OtherArchitecture {
                name: other.name.clone(),
                other: self.name.clone(),
            });
        }
        let names = self.tensors.keys().chain(other.tensors.keys());
        for tensor in names {
            let shape =
                |weights: &Self| weights.tensors.get(tensor).map(|(shape, _)| shape.clone());
            let (expected, found) = (shape(self), shape(other));
            if found != expected {
                let word = |shape: Option<Vec<usize>>| {
                    shape.map_or("nothing".into(), |shape| format!("{shape:?}"))
                };
                return Err(ModelError::Tensor {
                    name: other.name.clone(),
                    tensor: tensor.clone(),
                    found: word(found),
                    expected: word(expected),
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::default_weights;

    /// Of the light network's architecture, which the numbers need not fit here.
    fn weights(name: &str, values: [f32; 3]) -> Weights {
        let [light, _] = default_weights().unwrap();
        Weights {
            name: name.into(),
            architecture: light.architecture,
            tensors: BTreeMap::from([("a".into(), (vec![3], values.to_vec()))]),
            hash: format!("hash of {name}"),
        }
    }

    #[test]
    fn numbers_become_their_mean() {
        let several = [
            weights("one", [1.0, -2.0, 0.5]),
            weights("two", [3.0, 2.0, 0.5]),
            weights("three", [2.0, 3.0, 0.5]),
        ];
        let bytes = Weights::average(&several).unwrap();
        let mean = Weights::from_bytes("mean", &bytes).unwrap();
        assert_eq!(mean.tensors["a"].1, [2.0, 1.0, 0.5]);
        assert_eq!(mean.architecture, several[0].architecture);
        let (_, header) = safetensors::SafeTensors::read_metadata(&bytes).unwrap();
        let note = &header.metadata().as_ref().unwrap()[AVERAGE_OF];
        assert_eq!(note, "hash of one hash of two hash of three");
    }

    #[test]
    fn other_networks_are_refused() {
        let one = weights("one", [1.0; 3]);
        let mut wider = weights("wider", [1.0; 3]);
        wider.tensors.insert("b".into(), (vec![1], vec![0.0]));
        let message = Weights::average(&[one.clone(), wider]).unwrap_err();
        assert_eq!(
            message.to_string(),
            "wider: tensor b: found [1], expected nothing"
        );
        let mut other = weights("other", [1.0; 3]);
        other.architecture = default_weights().unwrap()[1].architecture.clone();
        let message = Weights::average(&[one, other]).unwrap_err().to_string();
        assert_eq!(message, "other: another architecture than that of one");
        assert!(Weights::average(&[]).is_err());
    }

    #[test]
    fn closeness_is_a_cosine() {
        let closeness = |a, b| weights("a", a).closeness(&weights("b", b)).unwrap();
        let one = [3.0, 0.0, 4.0];
        // By hand: (3 * 3 + 4 * 4) / (5 * 5); 12 / (5 * 5); the opposite; at a right angle; nothing at all.
        for (other, expected) in [
            ([3.0, 0.0, 4.0], 1.0),
            ([0.0, 4.0, 3.0], 0.48),
            ([-3.0, 0.0, -4.0], -1.0),
            ([0.0, 7.0, 0.0], 0.0),
            ([0.0, 0.0, 0.0], 0.0),
        ] {
            assert!((closeness(one, other) - expected).abs() < 1e-9, "{other:?}");
        }
    }
}
