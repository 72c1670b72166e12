use super::lathe::rounded_max;
use crate::noise::Lattice;
use crate::random::Random;
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::TAU;

/// A flat thing lying in the plane z = 0 with a carved, struck, woven or grown front: what reliefs,
/// coins, cloth and bark have in common is a height over that plane.
#[derive(Debug, Clone)]
pub(crate) struct Plate {
    outline: Outline,
    thickness: f32,
    rim: Option<Rim>,
    layers: Vec<Layer>,
    /// Steepest slope the layers are expected to reach.
    slope: f32,
    highest: f32,
    to_plate: Mat3,
}

/// The edge seen from the front.
#[derive(Debug, Clone, Copy)]
enum Outline {
    Disc(f32),
    /// Half sides and the radius of the corners.
    Rectangle(Vec2, f32),
}

/// A raised border as on coins.
#[derive(Debug, Clone, Copy)]
struct Rim {
    width: f32,
    height: f32,
}

/// One kind of unevenness, a height over the plane.
#[derive(Debug, Clone)]
struct Layer {
    kind: LayerKind,
    to_noise: Mat3,
    offset: Vec3,
    height: f32,
}

#[derive(Debug, Clone, Copy)]
enum LayerKind {
    /// Soft bumps.
    Bumps,
    /// Sharp valleys, as in bark and broken stone.
    Cracks,
    /// Rounded ridges side by side that bend: folds of cloth, wood, grooves.
    Folds,
    /// Threads over and under each other.
    Weave,
    /// Blocks of different heights with steep sides: letters, ornaments, cobbles.
    Blocks,
}

impl Plate {
    /// Draws one about two units wide, its front towards z.
    pub(crate) fn draw(random: &mut Random) -> Self {
        let mut plate = Self {
            outline: outline(random),
            thickness: random.range(0.05, 0.25),
            rim: None,
            layers: Vec::new(),
            slope: 0.0,
            highest: 0.0,
            to_plate: Mat3::IDENTITY,
        };
        match random.below(4) {
            0 => plate.strike(random),
            1 => plate.carve(random),
            2 => plate.weave(random),
            _ => plate.grow(random),
        }
        plate
    }

    /// A coin or medal: nearly flat, with a rim.
    fn strike(&mut self, random: &mut Random) {
        if random.chance(0.8) {
            let height = random.range(0.01, 0.05);
            self.rim = Some(Rim {
                width: random.range(0.03, 0.09),
                height,
            });
            self.highest += height;
        }
        self.add(random, LayerKind::Bumps, [1.0, 3.0], [0.05, 0.2]);
        if random.chance(0.6) {
            self.add(random, LayerKind::Blocks, [3.0, 9.0], [0.05, 0.2]);
        }
    }

    fn carve(&mut self, random: &mut Random) {
        self.add(random, LayerKind::Bumps, [0.8, 2.5], [0.1, 0.5]);
        self.add(random, LayerKind::Blocks, [1.5, 5.0], [0.1, 0.5]);
        if random.chance(0.5) {
            self.add(random, LayerKind::Cracks, [2.0, 8.0], [0.1, 0.4]);
        }
    }

    fn weave(&mut self, random: &mut Random) {
        self.add(random, LayerKind::Folds, [0.7, 3.0], [0.3, 1.0]);
        self.add(random, LayerKind::Bumps, [0.8, 3.0], [0.1, 0.5]);
        if random.chance(0.4) {
            self.add(random, LayerKind::Weave, [6.0, 16.0], [0.1, 0.4]);
        }
    }

    fn grow(&mut self, random: &mut Random) {
        for frequency in [[1.0, 2.5], [2.5, 6.0], [6.0, 14.0]] {
            self.add(random, LayerKind::Cracks, frequency, [0.2, 0.6]);
        }
        let stretch = random.range(0.2, 1.0);
        for layer in &mut self.layers {
            layer.to_noise *= Mat3::from_diagonal(Vec3::new(1.0, stretch, 1.0));
        }
    }

    /// Frequency, in cells per unit, and slope are ranges.
    fn add(&mut self, random: &mut Random, kind: LayerKind, frequency: [f32; 2], slope: [f32; 2]) {
        let frequency = random.log_range(frequency[0], frequency[1]);
        let slope = random.range(slope[0], slope[1]);
        let height = slope / (kind.steepest() * frequency);
        // The layers vary in the plane: noise of space is cut along a random plane, patterns lie flat.
        let turn = match kind {
            LayerKind::Bumps | LayerKind::Cracks | LayerKind::Blocks => random.rotation(),
            LayerKind::Folds | LayerKind::Weave => crate::random::about_z(random.range(0.0, TAU)),
        };
        self.layers.push(Layer {
            kind,
            to_noise: turn * frequency,
            offset: random.vector(16.0),
            height,
        });
        self.slope += slope;
        self.highest += height;
    }

    pub(crate) fn rotated(mut self, rotation: Mat3) -> Self {
        self.to_plate *= rotation.transpose();
        self
    }

    pub(crate) fn reach(&self) -> f32 {
        let side = match self.outline {
            Outline::Disc(radius) => radius,
            Outline::Rectangle(half, _) => half.length(),
        };
        (side * side + self.depth() * self.depth()).sqrt()
    }

    pub(crate) fn thickness(&self) -> f32 {
        self.thickness
    }

    /// From z = 0 to the flat back: the deepest carving leaves the thickness.
    fn depth(&self) -> f32 {
        self.thickness + self.highest
    }

    pub(crate) fn step(&self) -> f32 {
        0.9 / (1.0 + self.slope)
    }

    /// Estimate of the signed distance, negative inside.
    pub(crate) fn distance(&self, lattice: &Lattice, point: Vec3) -> f32 {
        let local = self.to_plate * point;
        let flat = local.truncate();
        let edge = match self.outline {
            Outline::Disc(radius) => flat.length() - radius,
            Outline::Rectangle(half, corner) => {
                let beyond = flat.abs() - half + Vec2::splat(corner);
                beyond.max(Vec2::ZERO).length() + beyond.x.max(beyond.y).min(0.0) - corner
            }
        };
        let slab = local.z.max(-self.depth() - local.z);
        // Far away the exact front does not matter.
        if edge.max(slab - self.highest) > 0.3 {
            return edge.max(slab - self.highest);
        }
        let front = local.z - self.height(lattice, flat, edge);
        rounded_max(edge, front.max(-self.depth() - local.z), 0.03)
    }

    fn height(&self, lattice: &Lattice, flat: Vec2, edge: f32) -> f32 {
        let mut height = 0.0;
        for layer in &self.layers {
            let place = layer.to_noise * flat.extend(0.0) + layer.offset;
            height += layer.height * layer.kind.at(lattice, place);
        }
        if let Some(rim) = self.rim {
            let inward = (-edge / rim.width).clamp(0.0, 2.0);
            // Flat on top for one width, then down over another.
            let down = (inward - 1.0).max(0.0);
            let share = 1.0 - down * down * (3.0 - 2.0 * down);
            height = height * (1.0 - share) + rim.height * share;
        }
        height.clamp(-self.highest, self.highest)
    }
}

impl LayerKind {
    /// Steepest change of [`Self::at`] per cell, roughly.
    fn steepest(self) -> f32 {
        match self {
            Self::Bumps => 1.7,
            Self::Cracks => 2.4,
            Self::Folds => 9.0,
            Self::Weave => 8.0,
            Self::Blocks => 12.0,
        }
    }

    /// About -1..1.
    fn at(self, lattice: &Lattice, place: Vec3) -> f32 {
        match self {
            Self::Bumps => lattice.at(place),
            Self::Cracks => {
                let noise = lattice.at(place);
                ((noise * noise + 0.003).sqrt() * 1.6 - 0.6).min(1.0)
            }
            Self::Folds => wave(place.x + 1.2 * lattice.at(place * 0.35)),
            Self::Weave => {
                let (u, v) = (wave(place.x), wave(place.y));
                // Which thread is above changes like a chess board's colours.
                let over = wave(0.5 * place.x) * wave(0.5 * place.y);
                let upper = 0.5 + 0.5 * over.clamp(-1.0, 1.0);
                0.5 * (u * upper + v * (1.0 - upper))
            }
            Self::Blocks => {
                let noise = lattice.at(place) * 2.2;
                let level = noise.floor();
                let rest = noise - level;
                // A few terraces with walls a quarter as wide as the steps.
                let wall = ((rest - 0.75) * 4.0).clamp(0.0, 1.0);
                (level + 0.5 + wall * wall * (3.0 - 2.0 * wall)) / 2.0
            }
        }
    }
}

/// A smooth wave of period 1 and amplitude 1 without trigonometry.
fn wave(position: f32) -> f32 {
    let t = position - position.floor();
    // Two parabolas: within 6 % of a sine.
    let half = if t < 0.5 { t } else { t - 0.5 };
    let arch = 16.0 * half * (0.5 - half);
    if t < 0.5 { arch } else { -arch }
}

fn outline(random: &mut Random) -> Outline {
    if random.chance(0.4) {
        return Outline::Disc(1.0);
    }
    let half = Vec2::new(1.0, random.range(0.5, 1.0));
    let half = if random.chance(0.5) {
        half
    } else {
        Vec2::new(half.y, half.x)
    };
    Outline::Rectangle(half, random.log_range(0.02, 0.4))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bare_disc_has_its_distances() {
        let disc = Plate {
            outline: Outline::Disc(1.0),
            thickness: 0.1,
            rim: None,
            layers: Vec::new(),
            slope: 0.0,
            highest: 0.0,
            to_plate: Mat3::IDENTITY,
        };
        let lattice = Lattice::shared();
        assert!((disc.distance(lattice, Vec3::new(0.2, 0.3, 0.25)) - 0.25).abs() < 1e-5);
        assert!((disc.distance(lattice, Vec3::new(0.0, 1.4, -0.05)) - 0.4).abs() < 1e-5);
        assert!((disc.distance(lattice, Vec3::new(0.0, 0.0, -0.3)) - 0.2).abs() < 1e-5);
        assert!(disc.distance(lattice, Vec3::new(0.0, 0.0, -0.05)) < 0.0);
    }

    #[test]
    fn layers_stay_within_the_slope_they_promise() {
        let lattice = Lattice::shared();
        let kinds = [
            LayerKind::Bumps,
            LayerKind::Cracks,
            LayerKind::Folds,
            LayerKind::Weave,
            LayerKind::Blocks,
        ];
        let mut random = Random::new(5, crate::random::Stream::Shape);
        for kind in kinds {
            let mut within = 0;
            for _ in 0..2000 {
                let place = random.vector(10.0);
                let along = crate::random::about_z(random.range(0.0, TAU)) * Vec3::X;
                let change = kind.at(lattice, place + along * 1e-3) - kind.at(lattice, place);
                within += usize::from((change / 1e-3).abs() <= kind.steepest() + 0.05);
                assert!(kind.at(lattice, place).abs() < 1.7, "{kind:?}");
            }
            assert!(within > 1900, "{kind:?}: {within}");
        }
    }
}
