use normalight_core::{Mask, NormalMap, angle_to_truth};
use serde::{Deserialize, Serialize};

/// Where one class of expected errors ends and the next begins, in degrees: those of single normals reach from 1.5 to 18.
const EDGES: [f64; 8] = [3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 13.0, 17.0];

/// Pixels whose normals are expected to be about as wrong, and how wrong they are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reliability {
    /// Mean error that was expected, in degrees.
    pub expected_degrees: f64,
    /// Mean error that was found, in degrees.
    pub found_degrees: f64,
    /// Share of the compared pixels, 0..1.
    pub share: f64,
}

impl Reliability {
    /// By expected errors, the smallest first; classes without pixels are left out. Pixels without a true normal do not count.
    ///
    /// `expected` has the error in degrees of each pixel of the maps.
    pub(crate) fn classes(
        expected: &[f32],
        normals: &NormalMap,
        truth: &NormalMap,
        mask: &Mask,
    ) -> Vec<Self> {
        let mut sums = [(0.0, 0.0, 0usize); EDGES.len() + 1];
        let pairs = normals.normals().iter().zip(truth.normals());
        for ((&expected, (&normal, &truth)), _) in expected
            .iter()
            .zip(pairs)
            .zip(mask.inside())
            .filter(|(_, inside)| **inside)
        {
            let Some(found) = angle_to_truth(normal, truth) else {
                continue;
            };
            let expected = f64::from(expected);
            let class = EDGES.iter().filter(|&&edge| expected >= edge).count();
            let (sum, errors, count) = &mut sums[class];
            *sum += expected;
            *errors += f64::from(found).to_degrees();
            *count += 1;
        }
        let all: usize = sums.iter().map(|(_, _, count)| count).sum();
        let class = |&(expected, found, count): &(f64, f64, usize)| Self {
            expected_degrees: expected / count as f64,
            found_degrees: found / count as f64,
            share: count as f64 / all as f64,
        };
        let filled = sums.iter().filter(|(_, _, count)| *count > 0);
        filled.map(class).collect()
    }

    /// The same over several objects or choices of photographs, each counting the same; nothing where one has none.
    pub(crate) fn mean<'a>(several: impl IntoIterator<Item = &'a [Self]>) -> Vec<Self> {
        let several: Vec<&[Self]> = several.into_iter().collect();
        if several.iter().any(|one| one.is_empty()) {
            return Vec::new();
        }
        let mut sums = [(0.0, 0.0, 0.0); EDGES.len() + 1];
        for one in several.iter().copied().flatten() {
            let class = EDGES
                .iter()
                .filter(|&&edge| one.expected_degrees >= edge)
                .count();
            let (expected, found, share) = &mut sums[class];
            *expected += one.share * one.expected_degrees;
            *found += one.share * one.found_degrees;
            *share += one.share;
        }
        let filled = sums.iter().filter(|(_, _, share)| *share > 0.0);
        let class = |&(expected, found, share): &(f64, f64, f64)| Self {
            expected_degrees: expected / share,
            found_degrees: found / share,
            share: share / several.len() as f64,
        };
        filled.map(class).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_core::Vec3;

    fn tilted(degrees: f32) -> Vec3 {
        let angle = degrees.to_radians();
        Vec3::new(angle.sin(), 0.0, angle.cos())
    }

    #[test]
    fn pixels_meet_those_that_are_expected_to_be_as_wrong() {
        // Outside the mask, and without truth, no pixel counts.
        let expected = [2.0, 2.5, 20.0, 9.0, 3.0];
        let found = [1.0, 3.0, 25.0, 90.0, 90.0].map(tilted);
        let truth = [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::Z, Vec3::ZERO];
        let map = |normals: [Vec3; 5]| NormalMap::new(5, 1, normals.to_vec());
        let mask = Mask::new(5, 1, vec![true, true, true, false, true]);
        let classes = Reliability::classes(&expected, &map(found), &map(truth), &mask);
        assert_eq!(classes.len(), 2);
        let near = |found: f64, wanted: f64| (found - wanted).abs() < 1e-3;
        assert!(near(classes[0].expected_degrees, 2.25) && near(classes[0].found_degrees, 2.0));
        assert!(near(classes[0].share, 2.0 / 3.0));
        assert!(near(classes[1].expected_degrees, 20.0) && near(classes[1].found_degrees, 25.0));
    }

    #[test]
    fn objects_count_the_same() {
        let class = |expected_degrees, found_degrees, share| Reliability {
            expected_degrees,
            found_degrees,
            share,
        };
        let one = [class(2.0, 1.0, 0.5), class(9.0, 8.0, 0.5)];
        let other = [class(2.5, 4.0, 1.0)];
        let mean = Reliability::mean([&one[..], &other[..]]);
        assert_eq!(mean.len(), 2);
        assert!((mean[0].found_degrees - (0.5 + 4.0) / 1.5).abs() < 1e-9);
        assert_eq!((mean[0].share, mean[1].share), (0.75, 0.25));
        assert!(Reliability::mean([&one[..], &[]]).is_empty());
        assert!(Reliability::mean([]).is_empty());
    }
}
