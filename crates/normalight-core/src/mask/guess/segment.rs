//! Object and background, first over the whole frame in large cells, then along the outline in smaller ones.
use super::cells::{Cells, Grid};
use super::evidence::{Background, Bins, Densities, FEATURES, Features};
use super::walk::{Joint, Pull, walk};
use crate::Mask;

/// Part of the brightest cells' brightness below which light is noise.
const DARK: f32 = 0.01;
/// Width of the border that stands for the background, as a part of the frame's shorter side.
const BORDER: usize = 24;
/// How much a cell of the border counts as background that is on none of its surfaces: the object
/// may cross the border.
const FOREIGN: f32 = 0.3;
/// Rounds of telling what both look like and which is which.
const ROUNDS: usize = 4;
/// Weight of a cell's own evidence against its neighbours': labels are smooth over about
/// 1 / sqrt(PULL) cells.
const PULL: f32 = 0.1;
/// Weight of labels that are settled.
const SETTLED: f32 = 10.0;
/// Evidence against the object, as a logarithm, half way up the sides of the frame.
const CENTRE: f32 = 0.7;
/// Parts of the object that are smaller than this share of its largest are none.
const SMALL: f32 = 0.1;
/// Half of the widest gap in an object's outline that is bridged, as a part of the frame's shorter side.
const GAP: usize = 40;
/// Shares of the frame that an object told from a background covers.
const COVER: [f32; 2] = [0.003, 0.97];

/// Labels of the cells of a grid, and what they rest on.
pub(super) struct Segmentation {
    grid: Grid,
    inside: Vec<bool>,
    background: Background,
    bins: Bins,
    /// Usual differences of features between neighbours on the background.
    texture: Features,
}

impl Segmentation {
    /// From cells that are the whole grid; with the share of the outline where the evidence agrees.
    /// `None` where there is no light or no object beside a background.
    pub(super) fn new(cells: &Cells) -> Option<(Self, f32)> {
        let grid = cells.grid;
        let floor = noise_floor(cells)?;
        let border = border(grid);
        let (background, explained) = Background::new(cells, &border, floor);
        let features = background.features(cells);
        let bins = Bins::new(&features);
        // A border without any one surface still has its colours.
        let surfaces = explained.iter().filter(|&&explained| explained).count();
        let foreign = if 5 * surfaces < border.len() {
            1.0
        } else {
            FOREIGN
        };
        let weights = explained
            .iter()
            .map(|&explained| if explained { 1.0 } else { foreign });
        let seeds: Vec<(usize, f32)> = border.iter().copied().zip(weights).collect();
        let mut is_seed = vec![false; grid.len()];
        seeds
            .iter()
            .for_each(|&(cell, weight)| is_seed[cell] = weight == 1.0);
        let pairs = cells.neighbours();
        let texture = texture(&features, &pairs, &is_seed);
        let joints = joints(&features, &pairs, &texture);
        let seen = || seeds.iter().map(|&(cell, weight)| (features[cell], weight));
        let mut there = Densities::new(&bins, seen());
        // What the middle of the frame shows is taken for the object at first, as far as the border does
        // not show it too.
        let central = |cell: usize| grid.centre(cell).map(|along| 1.0 - along * along);
        let middle = features.iter().enumerate().map(|(cell, &features)| {
            let [x, y] = central(cell);
            (features, x * y)
        });
        let mut here = Densities::new(&bins, middle);
        let mut evidence = Vec::new();
        let mut likely = Vec::new();
        for _ in 0..ROUNDS {
            evidence = features
                .iter()
                .map(|&features| here.ratio(&there, &bins, features))
                .collect();
            let pulls: Vec<Pull> = evidence
                .iter()
                .enumerate()
                .map(|(cell, &evidence)| Pull {
                    target: chance(evidence + prior(grid, cell)),
                    weight: PULL,
                })
                .collect();
            likely = walk(&joints, &pulls);
            let weighted = |side: fn(f32) -> f32| {
                let cells = features.iter().zip(&likely);
                cells.map(move |(&features, &likely)| (features, side(likely).max(0.0)))
            };
            here = Densities::new(&bins, weighted(|likely| 2.0 * likely - 1.0));
            there = Densities::new(&bins, weighted(|likely| 1.0 - 2.0 * likely).chain(seen()));
        }
        let inside = likely.iter().map(|&likely| likely > 0.5).collect();
        let mask = tidy(Mask::new(grid.width, grid.height, inside));
        let mask = enclosed(mask, grid);
        let cover = mask.count() as f32 / grid.len() as f32;
        if !(COVER[0]..=COVER[1]).contains(&cover) {
            return None;
        }
        let certainty = agreement(&mask, grid, &pairs, &evidence);
        let segmentation = Self {
            grid,
            inside: mask.inside,
            background,
            bins,
            texture,
        };
        Some((segmentation, certainty))
    }

    /// Goes over to a finer grid; gives the cells along the outline and the labels of those that
    /// are settled.
    pub(super) fn band(&mut self, grid: Grid) -> (Vec<usize>, Vec<Option<bool>>) {
        let old = self.grid;
        let near: Vec<bool> = around(old, 1, |cell, other| {
            self.inside[cell] != self.inside[other]
        });
        let beside: Vec<bool> = around(old, 2, |_, other| near[other]);
        let (mut places, mut known) = (Vec::new(), Vec::new());
        let inside = (0..grid.len())
            .map(|cell| {
                let parent = grid.parent(cell, &old);
                if beside[parent] {
                    places.push(cell);
                    known.push((!near[parent]).then_some(self.inside[parent]));
                }
                self.inside[parent]
            })
            .collect();
        (self.grid, self.inside) = (grid, inside);
        (places, known)
    }

    /// Labels the cells along the outline anew.
    pub(super) fn refine(&mut self, cells: &Cells, known: &[Option<bool>]) {
        let features = self.background.features(cells);
        let settled = |wanted: bool| {
            let cells = features.iter().zip(known);
            cells
                .filter(move |(_, known)| **known == Some(wanted))
                .map(|(&features, _)| (features, 1.0))
        };
        let here = Densities::new(&self.bins, settled(true));
        let there = Densities::new(&self.bins, settled(false));
        let pulls: Vec<Pull> = features
            .iter()
            .zip(known)
            .map(|(&features, &known)| match known {
                Some(inside) => Pull {
                    target: f32::from(u8::from(inside)),
                    weight: SETTLED,
                },
                None => Pull {
                    target: chance(here.ratio(&there, &self.bins, features)),
                    weight: PULL,
                },
            })
            .collect();
        let joints = joints(&features, &cells.neighbours(), &self.texture);
        for (&cell, likely) in cells.places.iter().zip(walk(&joints, &pulls)) {
            self.inside[cell] = likely > 0.5;
        }
    }

    pub(super) fn into_mask(self) -> Mask {
        tidy(Mask::new(self.grid.width, self.grid.height, self.inside))
    }
}

fn tidy(mask: Mask) -> Mask {
    mask.without_small_parts(SMALL).holes_filled()
}

/// With what lies within an outline that has gaps: the middle of an object may look as the
/// background does. Bays and clefts stay open.
fn enclosed(mask: Mask, grid: Grid) -> Mask {
    let gap = grid.width.min(grid.height) / GAP;
    let grown = around(grid, gap, |_, other| mask.inside[other]);
    let grown = Mask::new(grid.width, grid.height, grown);
    let filled = grown.holes_filled();
    let within = |cell: usize| filled.inside[cell] && !grown.inside[cell];
    let within = around(grid, gap, |_, other| within(other));
    let both = mask.inside.iter().zip(within).map(|(&a, b)| a || b);
    Mask::new(grid.width, grid.height, both.collect()).holes_filled()
}

/// `None` where there is no light.
fn noise_floor(cells: &Cells) -> Option<f32> {
    let mut means: Vec<f32> = cells
        .colours
        .iter()
        .map(|rgb| rgb.iter().sum::<f32>() / 3.0)
        .collect();
    means.sort_unstable_by(f32::total_cmp);
    let at = |share: f32| means[((means.len() - 1) as f32 * share) as usize];
    // Small objects count, single highlights less.
    let bright = at(0.98).max(0.3 * at(0.998));
    (bright > 0.0).then_some(DARK * bright)
}

fn border(grid: Grid) -> Vec<usize> {
    let (width, height) = (grid.width, grid.height);
    let wide = width.min(height).div_ceil(BORDER);
    let on_border = |&cell: &usize| {
        let (x, y) = (cell % width, cell / width);
        x.min(y).min(width - 1 - x).min(height - 1 - y) < wide
    };
    (0..grid.len()).filter(on_border).collect()
}

fn prior(grid: Grid, cell: usize) -> f32 {
    let [x, y] = grid.centre(cell);
    -CENTRE * (x * x + y * y)
}

fn chance(evidence: f32) -> f32 {
    1.0 / (1.0 + libm::expf(-evidence))
}

/// Root mean square differences between neighbours of the background, at least those of noise.
fn texture(features: &[Features], pairs: &[[usize; 2]], is_seed: &[bool]) -> Features {
    const LEAST: Features = [0.3, 0.05, 0.03, 0.03];
    let mut sums = [0.0f32; FEATURES];
    let mut count = 0.0f32;
    for &[a, b] in pairs.iter().filter(|[a, b]| is_seed[*a] && is_seed[*b]) {
        count += 1.0;
        for (sum, (a, b)) in sums.iter_mut().zip(features[a].iter().zip(&features[b])) {
            *sum += (a - b) * (a - b);
        }
    }
    std::array::from_fn(|k| (sums[k] / count.max(1.0)).sqrt().max(LEAST[k]))
}

/// Neighbours hold together except where they differ more than the background's texture does.
fn joints(features: &[Features], pairs: &[[usize; 2]], texture: &Features) -> Vec<Joint> {
    let weight = |a: Features, b: Features| {
        let differences = (0..FEATURES).map(|k| (a[k] - b[k]) / (2.0 * texture[k]));
        0.02 + libm::expf(-0.5 * differences.map(|value| value * value).sum::<f32>())
    };
    let joint = |&ends: &[usize; 2]| Joint {
        ends,
        weight: weight(features[ends[0]], features[ends[1]]),
    };
    pairs.iter().map(joint).collect()
}

/// Share of the outline on whose two sides the evidence agrees with the labels. Where the frame cuts
/// the object off nothing confirms the outline.
fn agreement(mask: &Mask, grid: Grid, pairs: &[[usize; 2]], evidence: &[f32]) -> f32 {
    let cut = (0..grid.len()).filter(|&cell| {
        let (x, y) = (cell % grid.width, cell / grid.width);
        let edge = x == 0 || y == 0 || x + 1 == grid.width || y + 1 == grid.height;
        edge && mask.inside[cell]
    });
    let (mut agreeing, mut all) = (0.0f32, cut.count() as f32);
    for &[a, b] in pairs {
        let (a, b) = match (mask.inside[a], mask.inside[b]) {
            (true, false) => (a, b),
            (false, true) => (b, a),
            _ => continue,
        };
        all += 1.0;
        agreeing += f32::from(u8::from(evidence[a] > 0.0 && evidence[b] < 0.0));
    }
    agreeing / all.max(1.0)
}

/// For each cell, whether something holds for it and a cell at most `reach` away along either side.
fn around(grid: Grid, reach: usize, holds: impl Fn(usize, usize) -> bool) -> Vec<bool> {
    (0..grid.len())
        .map(|cell| {
            let (x, y) = (cell % grid.width, cell / grid.width);
            let rows = y.saturating_sub(reach)..=(y + reach).min(grid.height - 1);
            rows.into_iter().any(|row| {
                let columns = x.saturating_sub(reach)..=(x + reach).min(grid.width - 1);
                columns
                    .into_iter()
                    .any(|column| holds(cell, row * grid.width + column))
            })
        })
        .collect()
}
