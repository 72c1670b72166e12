//! From small to large: steps in depth show at a small size already, where they take few turns to find.
use super::Integration;
use super::bilateral::assemble;
use super::equations::Field;
use super::grid::Grid;
use super::solver::{Goal, Solver};

/// Fields of at most this side are solved from nothing.
const SMALL: usize = 96;

/// Turns of weights and heights from nothing, and from the result of half the size.
const TURNS_FROM_NOTHING: usize = 100;
const TURNS_FROM_HALF: usize = 12;

/// The turns end when one lowers the energy by less than this share.
const SETTLED: f64 = 1e-3;

/// Turns after which the preconditioner is built anew: the weights change most at the beginning.
const PREPARED_BEFORE: [usize; 5] = [0, 2, 5, 12, 30];

const EACH_TURN: Goal = Goal {
    share: 0.1,
    of_whole: 1e-5,
    most: 6,
};

const AT_THE_END: Goal = Goal {
    share: 1e-5,
    of_whole: 1e-5,
    most: 30,
};

/// Heights of the places of a field.
pub(super) fn heights(field: &Field, integration: Integration) -> Vec<f32> {
    let count = field.inside.len();
    let small = field.stride.max(field.rows()) <= SMALL;
    let start = (!small).then(|| {
        let half = field.halved();
        let heights = heights(&half, integration);
        field.heights_from_half(&half, &heights)
    });
    let mut grid = Grid::new(field.stride, count);
    let mut rhs = vec![0.0; count];
    let mut solver = Solver::new(count);
    let (turns, mut known) = match (integration, small) {
        (Integration::Poisson, _) => (0, false),
        (Integration::Bilateral, true) => (TURNS_FROM_NOTHING, false),
        (Integration::Bilateral, false) => (TURNS_FROM_HALF, true),
    };
    let mut x = start.unwrap_or_else(|| vec![0.0; count]);
    let mut before = f64::INFINITY;
    for turn in 0..turns {
        let energy = assemble(field, known.then_some(&x[..]), &mut grid, &mut rhs);
        if turn > 1 && before - energy < SETTLED * before {
            break;
        }
        before = energy;
        known = true;
        if PREPARED_BEFORE.contains(&turn) {
            solver.prepare(&grid);
        }
        solver.solve(&grid, &rhs, &mut x, EACH_TURN);
    }
    if turns == 0 {
        assemble(field, None, &mut grid, &mut rhs);
    }
    solver.prepare(&grid);
    solver.solve(&grid, &rhs, &mut x, AT_THE_END);
    x
}
