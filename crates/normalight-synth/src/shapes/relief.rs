use crate::noise::Lattice;
use crate::random::Random;
use glam::{Mat3, Vec3};

/// Corners of a tetrahedron: differences at them give a gradient with four evaluations instead of six.
pub(crate) const TETRAHEDRON: [Vec3; 4] = [
    Vec3::new(1.0, 1.0, 1.0),
    Vec3::new(1.0, -1.0, -1.0),
    Vec3::new(-1.0, 1.0, -1.0),
    Vec3::new(-1.0, -1.0, 1.0),
];

/// Bumps, folds or carving: how far the surface is pushed outwards at every point in space.
#[derive(Debug, Clone, Default)]
pub(crate) struct Relief {
    layers: Vec<Layer>,
    reach: f32,
    slope: f32,
}

#[derive(Debug, Clone)]
struct Layer {
    /// From space to the cells of the noise.
    to_noise: Mat3,
    offset: Vec3,
    height: f32,
    /// Cells per unit.
    frequency: f32,
    /// Sharp valleys instead of round bumps.
    ridged: bool,
}

/// What is asked of a layer, before it is laid out at random.
struct LayerPlan {
    /// Cells per unit.
    frequency: f32,
    /// Change of the displacement along the surface where it is steep.
    slope: f32,
    /// Sharp valleys instead of round bumps.
    ridged: bool,
    /// Turns and stretches space before the noise.
    turn: Mat3,
}

impl Relief {
    /// Mild or strong relief of an upright object about two units tall, turned by `rotation`.
    pub(crate) fn draw(random: &mut Random, strong: bool, rotation: Mat3) -> Self {
        let mut relief = Self::default();
        let layers = random.count(1, if strong { 3 } else { 2 });
        // Folds of cloth hang down: long in y.
        let stretch = if random.chance(0.35) {
            Vec3::new(1.0, random.range(0.15, 0.4), 1.0)
        } else {
            Vec3::ONE
        };
        for _ in 0..layers {
            let (frequency, slope) = if strong {
                (random.log_range(2.5, 13.0), random.range(0.2, 0.6))
            } else {
                (random.log_range(1.2, 6.0), random.range(0.05, 0.35))
            };
            let ridged = random.chance(0.3);
            let turn = rotation * Mat3::from_diagonal(stretch) * rotation.transpose();
            relief.add(
                random,
                &LayerPlan {
                    frequency,
                    slope,
                    ridged,
                    turn,
                },
            );
        }
        relief
    }

    /// Large soft bumps that make a blob out of a ball.
    pub(crate) fn lumps(random: &mut Random) -> Self {
        let mut relief = Self::default();
        for _ in 0..random.count(1, 2) {
            let (frequency, slope) = (random.log_range(0.9, 2.5), random.range(0.3, 0.8));
            relief.add(
                random,
                &LayerPlan {
                    frequency,
                    slope,
                    ridged: false,
                    turn: Mat3::IDENTITY,
                },
            );
        }
        relief
    }

    /// Grooves, cracks or grains with cells of `unit` times a few.
    pub(crate) fn fine(random: &mut Random, unit: f32, rotation: Mat3) -> Self {
        let mut relief = Self::default();
        let stretch = if random.chance(0.3) {
            Vec3::new(1.0, random.range(0.1, 0.4), 1.0)
        } else {
            Vec3::ONE
        };
        let turn = rotation * Mat3::from_diagonal(stretch) * rotation.transpose();
        for _ in 0..random.count(1, 2) {
            let frequency = 1.0 / (unit * random.log_range(3.0, 12.0));
            let (slope, ridged) = (random.range(0.1, 0.6), random.chance(0.6));
            relief.add(
                random,
                &LayerPlan {
                    frequency,
                    slope,
                    ridged,
                    turn,
                },
            );
        }
        relief
    }

    /// Both reliefs on one surface.
    pub(crate) fn joined(mut self, other: Self) -> Self {
        self.layers.extend(other.layers);
        self.reach += other.reach;
        self.slope += other.slope;
        self
    }

    /// Made shallower until nothing is displaced by more than `reach`, so that thin parts neither
    /// break nor melt.
    pub(crate) fn limited(mut self, reach: f32) -> Self {
        if self.reach > reach {
            let share = reach / self.reach;
            for layer in &mut self.layers {
                layer.height *= share;
            }
            self.slope *= share;
            self.reach = reach;
        }
        self
    }

    fn add(&mut self, random: &mut Random, plan: &LayerPlan) {
        // Quintic value noise rises by about 1.5 times its height a cell where it is steep.
        let height = plan.slope / (1.5 * plan.frequency);
        self.layers.push(Layer {
            // Turned at random so that the cells' walls do not line up with the image.
            to_noise: random.rotation() * plan.turn * plan.frequency,
            offset: random.vector(16.0),
            height,
            frequency: plan.frequency,
            ridged: plan.ridged,
        });
        self.reach += height;
        self.slope += plan.slope;
    }

    pub(crate) fn is_flat(&self) -> bool {
        self.layers.is_empty()
    }

    /// Largest displacement in either direction.
    pub(crate) fn reach(&self) -> f32 {
        self.reach
    }

    /// Typical steepest change of the displacement along the surface.
    pub(crate) fn slope(&self) -> f32 {
        self.slope
    }

    /// Displacement at a point, within -reach..reach.
    #[inline]
    pub(crate) fn at(&self, lattice: &Lattice, point: Vec3) -> f32 {
        let layers = self.layers.iter();
        layers.map(|layer| layer.at(lattice, point)).sum()
    }

    /// Change of the displacement with each axis, from differences over `spread`.
    pub(crate) fn gradient(&self, lattice: &Lattice, point: Vec3, spread: f32) -> Vec3 {
        let corners = TETRAHEDRON.iter();
        let sum: Vec3 = corners
            .map(|&corner| corner * self.at(lattice, point + corner * spread))
            .sum();
        sum / (4.0 * spread)
    }

    /// How many times as deep as wide the grooves are that a point lies in: 0 at the mean height and above,
    /// a groove being half a cell wide.
    pub(crate) fn groove(&self, lattice: &Lattice, point: Vec3) -> f32 {
        let layers = self.layers.iter();
        let depth = |layer: &Layer| (-layer.at(lattice, point)).max(0.0);
        layers
            .map(|layer| depth(layer) * 2.0 * layer.frequency)
            .sum()
    }
}

impl Layer {
    #[inline]
    fn at(&self, lattice: &Lattice, point: Vec3) -> f32 {
        let noise = lattice.at(self.to_noise * point + self.offset);
        if self.ridged {
            // A slightly rounded absolute value: creases, but no infinitely thin ones.
            self.height * ((noise * noise + 0.003).sqrt() * 1.6 - 0.6).min(1.0)
        } else {
            self.height * noise
        }
    }
}
