use super::lathe::Lathe;
use super::part::Part;
use super::plate::Plate;
use super::relief::{Relief, TETRAHEDRON};
use crate::noise::Lattice;
use glam::{Mat3, Vec2, Vec3};

/// Most parts of one object: [`Active`] has one bit for each, and one for the body.
const MAX_PARTS: usize = 31;

/// What the parts are joined to.
#[derive(Debug, Clone)]
pub(crate) enum Body {
    /// Nothing: the parts are all there is.
    None,
    Lathe(Lathe),
    Plate(Box<Plate>),
}

impl Body {
    fn rotated(self, rotation: Mat3) -> Self {
        match self {
            Self::None => Self::None,
            Self::Lathe(lathe) => Self::Lathe(lathe.rotated(rotation)),
            Self::Plate(plate) => Self::Plate(Box::new(plate.rotated(rotation))),
        }
    }

    /// Radius of a sphere around the origin that holds the body.
    fn reach(&self) -> Option<f32> {
        match self {
            Self::None => None,
            Self::Lathe(lathe) => Some(lathe.reach()),
            Self::Plate(plate) => Some(plate.reach()),
        }
    }

    /// Half extents to the right and up of a rectangle around the origin that holds the body.
    fn extent(&self) -> Vec2 {
        match self {
            Self::None => Vec2::ZERO,
            Self::Lathe(lathe) => lathe.extent(),
            Self::Plate(plate) => Vec2::splat(plate.reach()),
        }
    }

    /// Share of its distance that is safe to walk.
    fn step(&self) -> f32 {
        match self {
            Self::None => 0.95,
            Self::Lathe(lathe) => lathe.step(),
            Self::Plate(plate) => plate.step(),
        }
    }
}

/// A solid object around the origin, about two units large, as a signed distance.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    body: Body,
    parts: Vec<Part>,
    /// Width of the seam over which parts flow into each other.
    seam: f32,
    relief: Relief,
    /// Radius of a sphere around the origin that holds everything.
    reach: f32,
}

/// The parts that can matter for a bundle of rays, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Active(u32);

impl Active {
    const BODY: u32 = 1 << MAX_PARTS;

    pub(crate) fn is_empty(self) -> bool {
        self.0 == 0
    }
}

impl Shape {
    /// Upright parts and body, turned by `rotation`; the relief is already turned.
    pub(crate) fn new(
        body: Body,
        mut parts: Vec<Part>,
        seam: f32,
        relief: Relief,
        rotation: Mat3,
    ) -> Self {
        parts.truncate(MAX_PARTS);
        for part in &mut parts {
            *part = part.rotated(rotation);
        }
        let body = body.rotated(rotation);
        let reach = parts
            .iter()
            .map(|part| part.centre().length() + part.reach())
            .chain(body.reach())
            .fold(0.0f32, f32::max)
            + relief.reach()
            + seam;
        Self {
            body,
            parts,
            seam: seam.max(1e-3),
            relief,
            reach,
        }
    }

    pub(crate) fn reach(&self) -> f32 {
        self.reach
    }

    /// Half extents to the right and up of a rectangle around the origin that holds everything.
    pub(crate) fn extent(&self) -> Vec2 {
        let parts = self
            .parts
            .iter()
            .map(|part| part.centre().truncate().abs() + Vec2::splat(part.reach()));
        parts.fold(self.body.extent(), Vec2::max) + Vec2::splat(self.relief.reach() + self.seam)
    }

    /// Share of the distance that is safe to walk along a ray.
    pub(crate) fn step(&self) -> f32 {
        self.body.step() / (1.0 + self.relief.slope())
    }

    /// How far a ray may go at this distance on the guess that it falls evenly, without leaping over the
    /// thinnest large wall.
    pub(crate) fn furthest(&self, distance: f32) -> f32 {
        match &self.body {
            Body::Plate(plate) => distance + plate.thickness() / 2.0,
            Body::Lathe(lathe) => lathe.furthest(distance),
            Body::None => f32::INFINITY,
        }
    }

    /// Parts that come near the column of rays around (x, y) with the given radius.
    pub(crate) fn active(&self, x: f32, y: f32, radius: f32) -> Active {
        let margin = radius + self.seam + self.relief.reach();
        let mut bits = 0;
        for (index, part) in self.parts.iter().enumerate() {
            let (dx, dy) = (part.centre().x - x, part.centre().y - y);
            let near = part.reach() + margin;
            if dx * dx + dy * dy < near * near {
                bits |= 1 << index;
            }
        }
        if let Some(reach) = self.body.reach() {
            let near = reach + margin;
            if x * x + y * y < near * near {
                bits |= Active::BODY;
            }
        }
        Active(bits)
    }

    /// Signed distance, negative inside; too short rather than too long away from the surface.
    #[inline]
    pub(crate) fn distance(&self, lattice: &Lattice, point: Vec3, active: Active) -> f32 {
        let smooth = self.smooth_distance(lattice, point, active);
        if self.relief.is_flat() {
            return smooth;
        }
        let reach = self.relief.reach();
        if smooth > 2.0 * reach {
            return smooth - reach;
        }
        smooth - self.relief.at(lattice, point)
    }

    /// [`Self::distance`] with no part left out.
    #[cfg(test)]
    pub(crate) fn distance_everywhere(&self, lattice: &Lattice, point: Vec3) -> f32 {
        self.distance(
            lattice,
            point,
            Active(((1 << self.parts.len()) - 1) | Active::BODY),
        )
    }

    /// Outward unit normal from differences over `spread`, at a point of the surface.
    pub(crate) fn normal(
        &self,
        lattice: &Lattice,
        point: Vec3,
        active: Active,
        spread: f32,
    ) -> Vec3 {
        // The error of the differences grows with the spread times the curvature.
        let mut gradient = Vec3::ZERO;
        for corner in TETRAHEDRON {
            gradient += corner * self.distance(lattice, point + corner * spread, active);
        }
        gradient.normalize_or(Vec3::Z)
    }

    #[inline]
    fn smooth_distance(&self, lattice: &Lattice, point: Vec3, active: Active) -> f32 {
        let mut nearest = f32::INFINITY;
        if active.0 & Active::BODY != 0 {
            nearest = match &self.body {
                Body::None => f32::INFINITY,
                Body::Lathe(lathe) => lathe.distance(point),
                Body::Plate(plate) => plate.distance(lattice, point),
            };
        }
        let inverse_seam = 0.25 / self.seam;
        let mut rest = active.0 & !Active::BODY;
        while rest != 0 {
            let distance = self.parts[rest.trailing_zeros() as usize].distance(point);
            rest &= rest - 1;
            // Smaller of two, with the inner corner filled over the seam.
            let overlap = (self.seam - (nearest - distance).abs()).max(0.0);
            nearest = nearest.min(distance) - overlap * overlap * inverse_seam;
        }
        nearest
    }
}
