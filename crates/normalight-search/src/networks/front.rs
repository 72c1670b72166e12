//! Which of several candidates are best where two numbers should be small.

/// Positions in the order of preference: those that none is better than in both numbers first, among them those that lie
/// apart from others (non-dominated sorting and crowding distance: Deb et al. 2002, NSGA-II). Equal candidates keep their
/// order, and what is no number comes last.
pub(super) fn preferred(points: &[[f64; 2]]) -> Vec<usize> {
    let (mut left, lost): (Vec<usize>, Vec<usize>) =
        (0..points.len()).partition(|&at| points[at].iter().all(|value| value.is_finite()));
    let mut order = Vec::with_capacity(points.len());
    while !left.is_empty() {
        let front: Vec<usize> = left
            .iter()
            .copied()
            .filter(|&at| {
                !left
                    .iter()
                    .any(|&other| dominates(points[other], points[at]))
            })
            .collect();
        left.retain(|at| !front.contains(at));
        let mut apart: Vec<(usize, f64)> = front
            .iter()
            .copied()
            .zip(crowding(points, &front))
            .collect();
        apart.sort_by(|a, b| b.1.total_cmp(&a.1));
        order.extend(apart.into_iter().map(|(at, _)| at));
    }
    order.extend(lost);
    order
}

/// Whether a point is in the first front: none is better in both numbers.
pub(super) fn is_on_front(points: &[[f64; 2]], at: usize) -> bool {
    points[at].iter().all(|value| value.is_finite())
        && !points.iter().any(|&other| dominates(other, points[at]))
}

fn dominates(one: [f64; 2], other: [f64; 2]) -> bool {
    let pairs = || one.into_iter().zip(other);
    pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
}

/// How far the neighbours of each lie apart along both numbers, as shares of the front's extent; endless at its ends.
fn crowding(points: &[[f64; 2]], front: &[usize]) -> Vec<f64> {
    let mut distances = vec![0.0; front.len()];
    for axis in [0, 1] {
        let mut sorted: Vec<usize> = (0..front.len()).collect();
        let value = |place: usize| points[front[place]][axis];
        sorted.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
        let (Some(&first), Some(&last)) = (sorted.first(), sorted.last()) else {
            return distances;
        };
        let extent = (value(last) - value(first)).max(f64::MIN_POSITIVE);
        distances[first] = f64::INFINITY;
        distances[last] = f64::INFINITY;
        for around in sorted.windows(3) {
            distances[around[1]] += (value(around[2]) - value(around[0])) / extent;
        }
    }
    distances
}

/// Kendall's tau-a of two series: the share of pairs that both put in the same order, less the share of those that they do
/// not (Kendall 1938). Nothing of fewer than two.
pub(super) fn kendall(one: &[f64], other: &[f64]) -> Option<f64> {
    let pairs = (0..one.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    let (mut sum, mut count) = (0.0, 0);
    for (a, b) in pairs {
        let sign = |series: &[f64]| match series[a].total_cmp(&series[b]) {
            std::cmp::Ordering::Less => -1.0,
            std::cmp::Ordering::Equal => 0.0,
            std::cmp::Ordering::Greater => 1.0,
        };
        sum += sign(one) * sign(other);
        count += 1;
    }
    (count > 0).then(|| sum / f64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fronts_come_one_after_the_other() {
        let points = [
            [3.0, 3.0],
            [1.0, 5.0],
            [2.0, 2.0],
            [5.0, 1.0],
            [f64::NAN, 0.0],
            [4.0, 4.0],
            [1.5, 3.0],
        ];
        let order = preferred(&points);
        // By hand: 1, 2, 3 and 6 are better than none of each other; the ends first, then the one with more room.
        assert_eq!(order[..2], [1, 3]);
        assert_eq!(order[2..], [2, 6, 0, 5, 4]);
        let on_front: Vec<usize> = (0..7).filter(|&at| is_on_front(&points, at)).collect();
        assert_eq!(on_front, [1, 2, 3, 6]);
    }

    #[test]
    fn ranks_agree_or_not() {
        assert_eq!(kendall(&[1.0, 2.0, 3.0], &[10.0, 20.0, 30.0]), Some(1.0));
        assert_eq!(kendall(&[1.0, 2.0, 3.0], &[3.0, 2.0, 1.0]), Some(-1.0));
        // Of six pairs one is the other way round.
        let tau = kendall(&[1.0, 2.0, 3.0, 4.0], &[1.0, 2.0, 4.0, 3.0]).unwrap();
        assert!((tau - 4.0 / 6.0).abs() < 1e-12);
        assert_eq!(kendall(&[1.0], &[1.0]), None);
    }
}
