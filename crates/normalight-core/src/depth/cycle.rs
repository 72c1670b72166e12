//! The multigrid K-cycle: Notay & Vassilevski, "Recursive Krylov-based multigrid cycles", Numerical Linear
//! Algebra with Applications 15 (2008). Piecewise constant corrections are poor on their own; two steps of
//! conjugate gradients on each coarser level make up for it, so that the number of iterations hardly grows
//! with the number of pixels.
use super::graph::Graph;
use super::grid::Grid;
use super::pairing::{Links, NONE, coarsened};

/// A level that is not smaller than this share of the finer one is of no use.
const WORTHWHILE: f32 = 0.9;

/// The second step on a coarser level is left out when the first leaves less than this.
const ENOUGH: f64 = 0.25;

/// The coarser levels of a grid.
#[derive(Debug, Default)]
pub(super) struct Hierarchy(Vec<Level>);

#[derive(Debug)]
struct Level {
    graph: Graph,
    /// For each node of the finer level its node here.
    parents: Vec<u32>,
    /// For each node its connected part, and the nodes of each.
    parts: Vec<u32>,
    sizes: Vec<u32>,
    rhs: Vec<f32>,
    x: Vec<f32>,
    residual: Vec<f32>,
    first: Vec<f32>,
    product: Vec<f32>,
}

impl Level {
    fn new((graph, parents): (Graph, Vec<u32>), nodes: usize) -> Self {
        let zeros = || vec![0.0; nodes];
        let (parts, sizes) = graph.parts();
        Self {
            graph,
            parents,
            parts,
            sizes,
            rhs: zeros(),
            x: zeros(),
            residual: zeros(),
            first: zeros(),
            product: zeros(),
        }
    }

    /// Takes the mean off the right-hand side of each part. Only differences of heights count, so no heights
    /// give a right-hand side with a mean; rounding does, and the steps along what the sweeps answer to it,
    /// nearly constant heights, could be of any length.
    fn centre(&mut self) {
        let mut means = vec![0.0f64; self.sizes.len()];
        for (&part, &value) in self.parts.iter().zip(&self.rhs) {
            means[part as usize] += f64::from(value);
        }
        for (mean, &size) in means.iter_mut().zip(&self.sizes) {
            *mean /= f64::from(size);
        }
        for (&part, value) in self.parts.iter().zip(&mut self.rhs) {
            *value = (f64::from(*value) - means[part as usize]) as f32;
        }
    }
}

impl Hierarchy {
    /// Down to where every part of the grid is a single node.
    pub(super) fn new(grid: &Grid) -> Self {
        let mut levels: Vec<Level> = Vec::new();
        let mut finer = grid.count();
        let mut next = coarsened(grid);
        loop {
            let nodes = next.0.count();
            if nodes == 0 || nodes as f32 > WORTHWHILE * finer as f32 {
                return Self(levels);
            }
            finer = nodes;
            let level = Level::new(next, nodes);
            next = coarsened(&level.graph);
            levels.push(level);
        }
    }

    /// One cycle from zero: `x` is about the solution of `A x = b`. `residual` is working space.
    pub(super) fn cycle(&mut self, grid: &Grid, b: &[f32], x: &mut [f32], residual: &mut [f32]) {
        grid.first_sweep(b, x, residual);
        correct(residual, x, &mut self.0);
        grid.last_sweep(b, x);
    }
}

/// Adds what the coarser levels make of a residual.
fn correct(residual: &[f32], x: &mut [f32], coarser: &mut [Level]) {
    let Some(level) = coarser.first_mut() else {
        return;
    };
    level.rhs.fill(0.0);
    for (&parent, residual) in level.parents.iter().zip(residual) {
        if parent != NONE {
            level.rhs[parent as usize] += residual;
        }
    }
    level.centre();
    accelerated(coarser);
    let level = &coarser[0];
    for (&parent, x) in level.parents.iter().zip(x) {
        if parent != NONE {
            *x += level.x[parent as usize];
        }
    }
}

/// Up to two steps of flexible conjugate gradients on the first of these levels, preconditioned by a cycle
/// through the others.
fn accelerated(levels: &mut [Level]) {
    let [level, coarser @ ..] = levels else {
        return;
    };
    let before = dot(&level.rhs, &level.rhs);
    cycle(level, coarser);
    level.graph.multiply(&level.x, &mut level.product);
    let first_energy = dot(&level.x, &level.product);
    if first_energy <= 0.0 {
        return;
    }
    let first_step = dot(&level.x, &level.rhs) / first_energy;
    add(&mut level.rhs, -first_step, &level.product);
    if dot(&level.rhs, &level.rhs) <= ENOUGH * ENOUGH * before {
        return scale(&mut level.x, first_step);
    }
    std::mem::swap(&mut level.first, &mut level.x);
    cycle(level, coarser);
    level.graph.multiply(&level.x, &mut level.residual);
    let both = dot(&level.x, &level.product);
    let energy = dot(&level.x, &level.residual) - both * both / first_energy;
    // Nothing new in a second step that is the first again, up to rounding.
    let step = if energy > 1e-6 * first_energy {
        dot(&level.x, &level.rhs) / energy
    } else {
        0.0
    };
    scale(&mut level.x, step);
    let first_step = first_step - both * step / first_energy;
    add(&mut level.x, first_step, &level.first);
}

fn cycle(level: &mut Level, coarser: &mut [Level]) {
    let Level {
        graph,
        rhs,
        x,
        residual,
        ..
    } = level;
    graph.first_sweep(rhs, x, residual);
    correct(residual, x, coarser);
    graph.last_sweep(rhs, x);
}

/// Sum of products, in double precision but for eight of them.
pub(super) fn dot(one: &[f32], other: &[f32]) -> f64 {
    let (ones, ones_left) = one.as_chunks::<8>();
    let (others, others_left) = other.as_chunks::<8>();
    let mut sums = [0.0f64; 8];
    for (one, other) in ones.iter().zip(others) {
        for lane in 0..8 {
            sums[lane] += f64::from(one[lane] * other[lane]);
        }
    }
    let left = ones_left.iter().zip(others_left);
    let left: f64 = left.map(|(one, other)| f64::from(one * other)).sum();
    sums.iter().sum::<f64>() + left
}

/// `x += step * direction`.
pub(super) fn add(x: &mut [f32], step: f64, direction: &[f32]) {
    let step = step as f32;
    for (x, direction) in x.iter_mut().zip(direction) {
        *x += step * direction;
    }
}

fn scale(x: &mut [f32], factor: f64) {
    for x in x {
        *x *= factor as f32;
    }
}
