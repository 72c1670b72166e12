//! The bilateral weights: Cao, Santo, Shi, Okura & Matsushita, "Bilateral Normal Integration", ECCV 2022.
//!
//! A pixel's normal fits the surface to its left and to its right; where there is a step on one side, it
//! fits the other side only. So both sides share a weight of 1 by how well they fit, which is found in
//! turns with the heights.
use super::equations::Field;
use super::grid::Grid;
use super::map::Breaks;

/// How sharply the better side is preferred, per squared pixel of misfit; 2 as in the paper.
const SHARPNESS: f32 = 2.0;

/// A link between two pixels of which both give it less than this half of their weight, counted
/// together, is torn.
const TORN: f32 = 0.1;

/// How much of a pixel's horizontal (0) or vertical (1) weight goes to its later neighbour (right,
/// below); the earlier one has the rest. And what its equation misses there, and at the earlier one.
///
/// The paper compares the jumps on both sides, here it is the misfits: on a slope the jumps differ by the first power
/// of noise and curvature, the misfits by the second.
fn shares(field: &Field, heights: &[f32], place: usize, axis: usize) -> (f32, [f32; 2]) {
    let step = [1, field.stride][axis];
    let own = field.equations[place];
    let misfit = |from: usize, to: usize| match field.inside[from] && field.inside[to] {
        true => own.facing * (heights[to] - heights[from]) - own.slopes[axis],
        // A neighbour that is not there fits, so a part that is a pixel wide can leave the other side.
        false => 0.0,
    };
    let [later, earlier] = [misfit(place, place + step), misfit(place - step, place)];
    let advantage = SHARPNESS * (later * later - earlier * earlier);
    (1.0 / (1.0 + libm::expf(advantage)), [later, earlier])
}

/// Writes the normal equations of the least squares that belong to these heights (`None`: both sides of
/// each pixel weigh the same) into grid and right-hand side; gives the energy.
pub(super) fn assemble(
    field: &Field,
    heights: Option<&[f32]>,
    grid: &mut Grid,
    rhs: &mut [f32],
) -> f64 {
    grid.right.fill(0.0);
    grid.below.fill(0.0);
    rhs.fill(0.0);
    let mut energy = 0.0f64;
    for place in field.inner() {
        let own = field.equations[place];
        for axis in 0..2 {
            let step = [1, field.stride][axis];
            let (share, misfits) = match heights {
                Some(heights) => shares(field, heights, place, axis),
                None => (0.5, [own.slopes[axis]; 2]),
            };
            let weights = match axis {
                0 => &mut grid.right,
                _ => &mut grid.below,
            };
            let sides = [
                (place, share, misfits[0]),
                (place - step, 1.0 - share, misfits[1]),
            ];
            for (link, share, misfit) in sides {
                if field.inside[link] && field.inside[link + step] {
                    let other = field.equations[if link == place { place + step } else { link }];
                    let weight = share * own.weight_beside(other);
                    let slope = own.slopes[axis] / own.facing;
                    weights[link] += weight;
                    rhs[link] -= weight * slope;
                    rhs[link + step] += weight * slope;
                    let misfit = misfit / own.facing;
                    energy += f64::from(weight * misfit * misfit);
                }
            }
        }
    }
    grid.update();
    energy
}

/// Where neither pixel of a link holds on to it.
pub(super) fn breaks(field: &Field, heights: &[f32]) -> Vec<Breaks> {
    let torn = |place: usize, axis: usize| {
        let next = place + [1, field.stride][axis];
        field.inside[next] && {
            let (own, _) = shares(field, heights, place, axis);
            let (other, _) = shares(field, heights, next, axis);
            own + 1.0 - other < TORN
        }
    };
    let mut breaks = vec![Breaks::default(); field.inside.len()];
    for place in field.inner() {
        breaks[place] = Breaks {
            right: torn(place, 0),
            below: torn(place, 1),
        };
    }
    breaks
}
