use super::shape::{Active, Shape};
use crate::noise::Lattice;
use glam::Vec3;

/// Most steps of a ray; thin things with steep carvings are approached in small ones.
const MAX_STEPS: usize = 160;

/// What one pixel looks along: from the camera through a point of the plane z = 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ray {
    x: f32,
    y: f32,
    inverse_distance: f32,
}

impl Ray {
    /// From a camera on the z axis, `1 / inverse_distance` above z = 0, through the point (x, y) there.
    pub(crate) fn new(x: f32, y: f32, inverse_distance: f32) -> Self {
        Self {
            x,
            y,
            inverse_distance,
        }
    }

    /// Its point at height z.
    #[inline]
    pub(crate) fn at(&self, z: f32) -> Vec3 {
        let share = 1.0 - z * self.inverse_distance;
        Vec3::new(self.x * share, self.y * share, z)
    }

    /// Unit vector towards the camera.
    pub(crate) fn to_camera(self) -> Vec3 {
        let (x, y) = (self.x, self.y);
        Vec3::new(-x * self.inverse_distance, -y * self.inverse_distance, 1.0).normalize()
    }

    /// Change of z when walking one unit down the ray.
    pub(crate) fn z_per_length(&self) -> f32 {
        self.to_camera().z
    }
}

/// Signed distance to the parts of a shape that the rays of a tile may meet.
pub(crate) struct DistanceField<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) lattice: &'a Lattice,
    pub(crate) active: Active,
}

impl DistanceField<'_> {
    #[inline]
    fn at(&self, point: Vec3) -> f32 {
        self.shape.distance(self.lattice, point, self.active)
    }
}

/// Height down to which all rays of a tile pass through empty space; `None` when they miss.
/// `ray`: the tile's middle, `radius`: how far its corners' rays ever are from it.
pub(crate) fn tile_start(field: &DistanceField, ray: Ray, radius: f32) -> Option<f32> {
    let shape = field.shape;
    let mut z = shape.reach();
    for _ in 0..MAX_STEPS {
        let free = field.at(ray.at(z)) * shape.step() - radius;
        if free < 0.1 * radius {
            break;
        }
        z -= free * ray.z_per_length();
        if z < -shape.reach() {
            return None;
        }
    }
    Some(z)
}

/// z of the first point of the surface on a ray that comes down from `start`, within a fraction of
/// `pitch`.
pub(crate) fn follow(field: &DistanceField, ray: Ray, start: f32, pitch: f32) -> Option<f32> {
    let shape = field.shape;
    let distance_at = |z: f32| field.at(ray.at(z));
    let safe_step = shape.step() * ray.z_per_length();
    let tolerance = 0.03 * pitch;
    let mut z = start;
    let (mut above, mut above_distance) = (z, f32::INFINITY);
    for _ in 0..MAX_STEPS {
        let distance = distance_at(z);
        // The distance falls along the ray about as it did in the last step: that tells how far
        // the surface is on slanted ground, where safe steps crawl.
        let fall = (above_distance - distance) / (above - z);
        if distance.abs() < tolerance {
            let fall = if fall.is_finite() { fall } else { 1.0 };
            return Some(z - distance / fall.clamp(0.1, 1.0));
        }
        if distance < 0.0 {
            let (top, bottom) = ((above, above_distance), (z, distance));
            return Some(between(distance_at, top, bottom, tolerance));
        }
        let safe = distance * safe_step;
        (above, above_distance) = (z, distance);
        z -= if fall > 0.0 && fall.is_finite() {
            let furthest = (3.0 * safe).min(shape.furthest(distance));
            (distance / fall).clamp(safe, furthest.max(safe))
        } else {
            safe
        };
        if z < -shape.reach() {
            return None;
        }
    }
    // Rays that graze the surface crawl: near enough counts.
    (above_distance < 0.3 * pitch).then_some(above)
}

/// z of the surface between a place above and one below it, each with its distance, by false
/// position.
fn between(
    distance_at: impl Fn(f32) -> f32,
    (mut above, mut over): (f32, f32),
    (mut below, mut under): (f32, f32),
    tolerance: f32,
) -> f32 {
    let mut z = below;
    if !over.is_finite() {
        // The ray began inside.
        return z;
    }
    for _ in 0..4 {
        z = above + (below - above) * (over / (over - under)).clamp(0.02, 0.98);
        let found = distance_at(z);
        if found.abs() < 0.3 * tolerance {
            break;
        }
        if found > 0.0 {
            (above, over) = (z, found);
        } else {
            (below, under) = (z, found);
        }
    }
    z
}

/// z of the object's far side on a ray, roughly: shadows need no more.
pub(crate) fn back_of(shape: &Shape, lattice: &Lattice, ray: Ray, front: f32, pitch: f32) -> f32 {
    let mut z = -shape.reach();
    for _ in 0..12 {
        let point = ray.at(z);
        let active = shape.active(point.x, point.y, 0.0);
        if active.is_empty() {
            break;
        }
        let distance = shape.distance(lattice, point, active);
        if distance < pitch || z >= front {
            break;
        }
        z += distance * 0.9;
    }
    z
}

#[cfg(test)]
impl Shape {
    /// Whether a ray from `place` leaves the shape unhindered: an independent check of shadows, slow and
    /// careful.
    pub(crate) fn is_lit(&self, place: Vec3, direction: Vec3) -> bool {
        let lattice = Lattice::shared();
        let mut walked = 0.0;
        for _ in 0..600 {
            let point = place + direction * walked;
            let distance = self.distance_everywhere(lattice, point);
            if distance < 1e-4 {
                return false;
            }
            if point.length() > 2.0 * self.reach() {
                return true;
            }
            walked += (distance * 0.5 * self.step()).max(1e-3);
        }
        true
    }
}
