//! Which shots show the same thing.
use super::shots::Spectra;
use crate::{evenly_spaced_indices, on_all_cores};

/// How far the best fit of two shots of one thing stands out at least, in deviations of the fit over
/// all shifts. Measured pair by pair on rendered and photographed objects, under lights from any two
/// sides: 13 or more for 99 in 100 pairs of one object, at most 8.4 for 90 in 100 pairs of two
/// objects (and up to 28 where both are round).
const ALIKE: f32 = 10.0;

/// Best fits of so many pixels away are no change of the light.
const AWAY: f32 = 2.0;
/// Share of the pairs of one thing that lie apart where shots lie in several places.
const APART: f32 = 0.25;

/// What shots show, compared pair by pair.
pub(super) struct Compared {
    /// Shots that show the same thing, the largest group first.
    pub(super) groups: Vec<Vec<usize>>,
    /// Whether many of them lie apart: where most shots lie then tells nothing.
    pub(super) apart: bool,
}

/// Groups of shots that show the same thing, the largest first: at most `most` shots, evenly spaced,
/// are compared, each with each. Shots without clear edges are in no group.
///
/// Groups are joined while the mean fit of their shots is that of one thing (average linkage): one
/// chance likeness between two objects joins nothing, one pair of lights that have nothing in
/// common parts nothing.
pub(super) fn compare(spectra: &Spectra, most: usize) -> Compared {
    let chosen: Vec<usize> = evenly_spaced_indices(spectra.len(), most)
        .into_iter()
        .filter(|&shot| !spectra.is_vague(shot))
        .collect();
    let count = chosen.len();
    let pairs: Vec<[usize; 2]> = (0..count)
        .flat_map(|b| (0..b).map(move |a| [a, b]))
        .collect();
    // Two are as fast as one.
    let twos: Vec<&[[usize; 2]]> = pairs.chunks(2).collect();
    let found = on_all_cores(twos.len(), |two| {
        let shots: Vec<[usize; 2]> = twos[two]
            .iter()
            .map(|pair| pair.map(|place| chosen[place]))
            .collect();
        spectra.likenesses(&shots)
    });
    let found: Vec<(f32, f32)> = found.into_iter().flatten().collect();
    let of_one = || found.iter().filter(|(fit, _)| *fit >= ALIKE);
    let away = of_one().filter(|(_, away)| *away > AWAY).count();
    let apart = away as f32 > APART * of_one().count() as f32;
    let mut fits = vec![vec![0.0; count]; count];
    for ([a, b], (fit, _)) in pairs.into_iter().zip(found) {
        (fits[a][b], fits[b][a]) = (fit, fit);
    }
    let joined = average_linkage(&fits, ALIKE);
    let named = |group: Vec<usize>| group.into_iter().map(|place| chosen[place]).collect();
    Compared {
        groups: joined.into_iter().map(named).collect(),
        apart,
    }
}

/// Joins the two groups of the largest mean until it is below `least`; the largest group first.
fn average_linkage(fits: &[Vec<f32>], least: f32) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = (0..fits.len()).map(|place| vec![place]).collect();
    let mean = |a: &[usize], b: &[usize]| -> f32 {
        let sum: f32 = a
            .iter()
            .map(|&a| b.iter().map(|&b| fits[a][b]).sum::<f32>())
            .sum();
        sum / (a.len() * b.len()) as f32
    };
    loop {
        let pairs = (0..groups.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
        let best = pairs
            .map(|(a, b)| (mean(&groups[a], &groups[b]), a, b))
            .max_by(|one, other| one.0.total_cmp(&other.0));
        match best {
            Some((fit, a, b)) if fit >= least => {
                let joined = groups.remove(b);
                groups[a].extend(joined);
            }
            _ => break,
        }
    }
    groups.iter_mut().for_each(|group| group.sort_unstable());
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_and_chances_do_not_decide() {
        // Shots 0 to 2 and 3 to 5 are alike; 2 and 3 look alike by chance, 0 and 2 do not.
        let alike = [(0, 1, 20.0), (1, 2, 25.0), (0, 2, 6.0), (3, 4, 15.0)];
        let alike = alike
            .into_iter()
            .chain([(4, 5, 30.0), (3, 5, 12.0), (2, 3, 14.0)]);
        let mut fits = vec![vec![5.0; 6]; 6];
        for (a, b, fit) in alike {
            (fits[a][b], fits[b][a]) = (fit, fit);
        }
        let found = average_linkage(&fits, 10.0);
        assert_eq!(found, [[0, 1, 2], [3, 4, 5]]);
    }
}
