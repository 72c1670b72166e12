use super::cycle::{Hierarchy, add, dot};
use super::grid::Grid;

/// Conjugate gradients with one multigrid cycle as preconditioner, and their working space.
#[derive(Debug)]
pub(super) struct Solver {
    hierarchy: Hierarchy,
    residual: Vec<f32>,
    direction: Vec<f32>,
    product: Vec<f32>,
    conditioned: Vec<f32>,
    cycle_residual: Vec<f32>,
}

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Goal {
    /// Error left, as a share of that at the beginning, or ...
    pub(super) share: f64,
    /// ... as a share of the whole solution, whichever is more.
    pub(super) of_whole: f64,
    /// Most iterations.
    pub(super) most: usize,
}

impl Solver {
    pub(super) fn new(count: usize) -> Self {
        let zeros = || vec![0.0; count];
        Self {
            hierarchy: Hierarchy::default(),
            residual: zeros(),
            direction: zeros(),
            product: zeros(),
            conditioned: zeros(),
            cycle_residual: zeros(),
        }
    }

    /// Builds the preconditioner anew. One of another grid works as well as the two grids are alike.
    pub(super) fn prepare(&mut self, grid: &Grid) {
        // The old one goes first: both together would need much memory.
        self.hierarchy = Hierarchy::default();
        self.hierarchy = Hierarchy::new(grid);
    }

    /// Improves `x` towards `A x = b`, flexibly (Polak & Ribière), as the preconditioner is not linear.
    /// Gives the number of iterations.
    ///
    /// Errors are those of the energy norm, as the preconditioner estimates them. The mean of `x` over
    /// each part of the grid stays what it is.
    pub(super) fn solve(&mut self, grid: &Grid, b: &[f32], x: &mut [f32], goal: Goal) -> usize {
        grid.multiply(x, &mut self.residual);
        for (residual, b) in self.residual.iter_mut().zip(b) {
            *residual = b - *residual;
        }
        // What x^T A x would be for the solution, and so the square of its size.
        let whole = goal.of_whole * goal.of_whole * dot(b, x).abs();
        let mut allowed = whole;
        let mut energy = 0.0;
        for iteration in 0..goal.most {
            self.hierarchy.cycle(
                grid,
                &self.residual,
                &mut self.conditioned,
                &mut self.cycle_residual,
            );
            let error = dot(&self.residual, &self.conditioned);
            if iteration == 0 {
                allowed = f64::max(whole, goal.share * goal.share * error);
                self.direction.copy_from_slice(&self.conditioned);
            } else {
                // The new direction shall be conjugate to the last one.
                let turn = -dot(&self.conditioned, &self.product) / energy;
                for (direction, new) in self.direction.iter_mut().zip(&self.conditioned) {
                    *direction = new + turn as f32 * *direction;
                }
            }
            if error <= allowed {
                return iteration;
            }
            grid.multiply(&self.direction, &mut self.product);
            energy = dot(&self.direction, &self.product);
            if energy <= 0.0 {
                return iteration;
            }
            let step = dot(&self.direction, &self.residual) / energy;
            add(x, step, &self.direction);
            add(&mut self.residual, -step, &self.product);
        }
        goal.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Links of 1, but some of 1000 and some of a thousandth; every seventh column is torn but for one link.
    fn grid(side: usize) -> Grid {
        let mut grid = Grid::new(side + 2, (side + 2) * (side + 2));
        for y in 1..=side {
            for x in 1..=side {
                let node = y * (side + 2) + x;
                let weight = match (x * x + 3 * y * x + 7 * y) % 11 {
                    0 => 1000.0,
                    1 | 2 => 0.001,
                    _ => 1.0,
                };
                if x < side {
                    let torn = x % 7 == 0 && y != x;
                    grid.right[node] = if torn { 1e-8 } else { weight };
                }
                if y < side {
                    grid.below[node] = weight;
                }
            }
        }
        grid.update();
        grid
    }

    /// The solution is known, and the effort does not grow with the size.
    #[test]
    fn few_iterations_at_any_size() {
        for side in [1, 2, 20, 100, 400] {
            let grid = grid(side);
            let count = grid.right.len();
            let truth: Vec<f32> = (0..count)
                .map(|node| {
                    ((node % (side + 2)) as f32 * 0.05).sin() * 10.0 + (node * node % 17) as f32
                })
                .collect();
            let mut rhs = vec![0.0; count];
            grid.multiply(&truth, &mut rhs);
            let mut x = vec![0.0; count];
            let mut solver = Solver::new(count);
            solver.prepare(&grid);
            let goal = Goal {
                share: 1e-4,
                of_whole: 0.0,
                most: 60,
            };
            let iterations = solver.solve(&grid, &rhs, &mut x, goal);
            println!("{side}: {iterations} iterations");
            assert!(iterations < 40, "{side}: {iterations}");
            let error: Vec<f32> = truth.iter().zip(&x).map(|(t, x)| t - x).collect();
            let mut product = vec![0.0; count];
            grid.multiply(&error, &mut product);
            let left = dot(&error, &product);
            grid.multiply(&truth, &mut product);
            let whole = dot(&truth, &product);
            assert!(left <= 1e-6 * whole, "{side}: {left} of {whole}");
        }
    }
    #[test]
    fn smooth_errors_vanish() {
        for side in [64usize, 256] {
            let mut grid = Grid::new(side + 2, (side + 2) * (side + 2));
            for y in 1..=side {
                for x in 1..=side {
                    let node = y * (side + 2) + x;
                    grid.right[node] = if x < side { 0.8 } else { 0.0 };
                    grid.below[node] = if y < side { 0.8 } else { 0.0 };
                }
            }
            grid.update();
            let count = grid.right.len();
            let truth: Vec<f32> = (0..count).map(|node| (node % (side + 2)) as f32).collect();
            let mut rhs = vec![0.0; count];
            grid.multiply(&truth, &mut rhs);
            let mut solver = Solver::new(count);
            solver.prepare(&grid);
            let mut x = vec![0.0; count];
            let goal = Goal {
                share: 1e-5,
                of_whole: 0.0,
                most: 30,
            };
            let iterations = solver.solve(&grid, &rhs, &mut x, goal);
            assert!(iterations < 12, "{side}: {iterations}");
            let rise = x[2 * side] - x[side + 3];
            assert!(
                (rise / (side as f32 - 3.0) - 1.0).abs() < 1e-4,
                "{side}: {rise}"
            );
            // Again and again nothing happens any more, though rounding leaves a residual.
            for _ in 0..3 {
                solver.solve(&grid, &rhs, &mut x, goal);
            }
            let rise = x[2 * side] - x[side + 3];
            assert!(
                (rise / (side as f32 - 3.0) - 1.0).abs() < 1e-4,
                "{side}: {rise}"
            );
        }
    }
}
