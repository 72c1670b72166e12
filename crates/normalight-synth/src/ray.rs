use crate::noise::Lattice;
use crate::shape::{Active, Shape};
use glam::Vec3;

const MAX_STEPS: usize = 48;

/// Height down to which all rays of a tile pass through empty space; `None` when they miss.
pub(crate) fn tile_start(
    shape: &Shape,
    lattice: &Lattice,
    active: Active,
    x: f32,
    y: f32,
    radius: f32,
) -> Option<f32> {
    let mut z = shape.reach();
    for _ in 0..MAX_STEPS {
        let free = shape.distance(lattice, Vec3::new(x, y, z), active) * shape.step() - radius;
        if free < 0.1 * radius {
            break;
        }
        z -= free;
        if z < -shape.reach() {
            return None;
        }
    }
    Some(z)
}

/// z of the first point of the surface on a ray towards negative z, within a fraction of `pitch`.
pub(crate) fn follow(
    shape: &Shape,
    lattice: &Lattice,
    active: Active,
    ray: Vec3,
    pitch: f32,
) -> Option<f32> {
    let distance_at = |z: f32| shape.distance(lattice, Vec3::new(ray.x, ray.y, z), active);
    let tolerance = 0.03 * pitch;
    let mut z = ray.z;
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
        let safe = distance * shape.step();
        (above, above_distance) = (z, distance);
        z -= if fall > 0.0 && fall.is_finite() {
            (distance / fall).clamp(safe, 3.0 * safe)
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
