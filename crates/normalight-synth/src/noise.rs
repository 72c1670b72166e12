use crate::random::{Random, Stream};
use glam::Vec3;
use std::sync::OnceLock;

/// Side of the periodic lattice; a power of two.
const SIDE: usize = 32;
/// Length of the bank of normal deviates; a power of two.
const BANK: usize = 1 << 14;

/// Smooth noise in -1..1 over space, one random value per unit cell's corner.
pub(crate) struct Lattice(Vec<f32>);

impl Lattice {
    /// The one lattice all scenes share; they differ by where and how they look at it.
    pub(crate) fn shared() -> &'static Self {
        static LATTICE: OnceLock<Lattice> = OnceLock::new();
        LATTICE.get_or_init(|| {
            let mut random = Random::new(1, Stream::Shape);
            Self(
                (0..SIDE * SIDE * SIDE)
                    .map(|_| random.signed(1.0))
                    .collect(),
            )
        })
    }

    /// Value at a point; quintic interpolation keeps normals of displaced surfaces smooth.
    #[inline]
    pub(crate) fn at(&self, point: Vec3) -> f32 {
        let (x, y, z) = (floor(point.x), floor(point.y), floor(point.z));
        let t = point - Vec3::new(x as f32, y as f32, z as f32);
        let t = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
        let mask = SIDE as i32 - 1;
        let x0 = (x & mask) as usize;
        let y0 = (y & mask) as usize * SIDE;
        let z0 = (z & mask) as usize * SIDE * SIDE;
        let x1 = (x0 + 1) & (SIDE - 1);
        let y1 = (y0 + SIDE) & (SIDE * SIDE - 1);
        let z1 = (z0 + SIDE * SIDE) & (SIDE * SIDE * SIDE - 1);
        let line = |start: usize| {
            let low = self.0[start + x0];
            low + (self.0[start + x1] - low) * t.x
        };
        let plane = |start: usize| {
            let low = line(start + y0);
            low + (line(start + y1) - low) * t.y
        };
        let low = plane(z0);
        low + (plane(z1) - low) * t.z
    }

    /// Random value in -1..1 of the unit cell a point lies in.
    pub(crate) fn cell(&self, point: Vec3) -> f32 {
        self.at(Vec3::new(
            floor(point.x) as f32,
            floor(point.y) as f32,
            floor(point.z) as f32,
        ))
    }
}

// The library's floor is a function call on processors without a rounding instruction.
#[inline]
fn floor(value: f32) -> i32 {
    let whole = value as i32;
    whole - i32::from(value < whole as f32)
}

/// Normal deviates (mean 0, deviation 1) to read from any place.
pub(crate) struct Deviates(Vec<f32>);

impl Deviates {
    pub(crate) fn shared() -> &'static Self {
        static DEVIATES: OnceLock<Deviates> = OnceLock::new();
        DEVIATES.get_or_init(|| {
            let mut random = Random::new(2, Stream::Camera);
            Self((0..BANK).map(|_| random.normal()).collect())
        })
    }

    /// Deviates in the bank.
    pub(crate) const COUNT: usize = BANK;

    /// All from `start` on to the end of the bank.
    pub(crate) fn from(&self, start: usize) -> &[f32] {
        &self.0[start & (BANK - 1)..]
    }
}
