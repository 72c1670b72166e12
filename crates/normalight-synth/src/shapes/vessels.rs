use super::lathe::{Hollow, Lathe};
use super::part::Part;
use crate::random::Random;
use glam::Vec3;

/// Steepest change of the radius with height: flatter shelves than this confuse the distance.
const MAX_SLOPE: f32 = 2.0;

/// Least width of the rim of open vessels, relative to where they are widest.
const OPENING: f32 = 0.75;

/// An upright turned body with whatever is fixed to it: handles, a spout, a knob.
pub(crate) struct Vessel {
    pub(crate) lathe: Lathe,
    pub(crate) fittings: Vec<Part>,
    /// Deepest relief its walls stand.
    pub(crate) max_relief: f32,
}

/// Draws a vessel about two units high; `open`: wide at the top, to be seen into.
pub(crate) fn vessel(random: &mut Random, open: bool) -> Vessel {
    let half_height = 1.0;
    let mut radii = profile(random);
    // From wide bowls to slender bottles.
    let widest = radii.iter().fold(0.0f32, |a, &b| a.max(b));
    let width = random.log_range(if open { 0.6 } else { 0.3 }, 1.5);
    for radius in &mut radii {
        *radius = (*radius * width / widest).max(0.06);
    }
    if open && let Some(rim) = radii.last_mut() {
        *rim = rim.max(OPENING * width);
    }
    let spacing = 2.0 * half_height / (radii.len() - 1) as f32;
    limit_slope(&mut radii, spacing * MAX_SLOPE);
    let hollow = (open || random.chance(0.4)).then(|| Hollow {
        wall: random.range(0.05, 0.1) * (1.0 + width),
        floor: random.range(-0.8, if open { 0.3 } else { 0.6 }),
    });
    let lathe = Lathe::new(radii, half_height, random.range(0.02, 0.12), hollow);
    let fittings = if random.chance(0.35) {
        fittings(&lathe, hollow.is_some(), random)
    } else {
        Vec::new()
    };
    Vessel {
        lathe,
        fittings,
        // Relief is on both sides, and walls that lean are less than half as thick across.
        max_relief: hollow.map_or(0.08, |hollow| 0.13 * hollow.wall),
    }
}

/// Relative radii from bottom to top.
fn profile(random: &mut Random) -> Vec<f32> {
    // Bottom to top; what people turn: vase, bowl, goblet, bottle, skittle, turned column, plate-like
    // dish. Jitter makes each one its own.
    const FORMS: [&[f32]; 7] = [
        &[0.5, 0.75, 1.0, 1.0, 0.8, 0.5, 0.35, 0.45],
        &[0.35, 0.6, 0.8, 0.92, 1.0, 1.0],
        &[0.8, 0.7, 0.2, 0.15, 0.2, 0.75, 1.0, 0.95, 0.85],
        &[0.9, 1.0, 1.0, 0.95, 0.9, 0.4, 0.3, 0.3, 0.34],
        &[0.55, 0.8, 1.0, 0.95, 0.65, 0.42, 0.5, 0.55, 0.2],
        &[1.0, 0.7, 0.4, 0.6, 0.65, 0.4, 0.5, 0.8, 0.3, 0.6, 0.4],
        &[0.4, 0.95, 1.0, 0.6, 0.5, 0.7],
    ];
    let mut radii: Vec<f32> = if random.chance(0.7) {
        let form = FORMS[random.below(FORMS.len())];
        form.iter()
            .map(|radius| radius * random.range(0.85, 1.15))
            .collect()
    } else {
        // A walk that mostly stays near its neighbour.
        let mut radius = random.range(0.3, 1.0);
        (0..random.count(4, 12))
            .map(|_| {
                radius = (radius + random.signed(0.45)).clamp(0.2, 1.0);
                radius
            })
            .collect()
    };
    if random.chance(0.25) {
        radii.reverse();
    }
    if random.chance(0.35) {
        // Rounded off like a gourd or an egg.
        radii.push(0.1);
    }
    radii
}

/// Lowers radii until neighbours differ by no more than `step`.
fn limit_slope(radii: &mut [f32], step: f32) {
    for index in 1..radii.len() {
        radii[index] = radii[index].min(radii[index - 1] + step);
    }
    for index in (1..radii.len()).rev() {
        radii[index - 1] = radii[index - 1].min(radii[index] + step);
    }
}

fn fittings(lathe: &Lathe, hollow: bool, random: &mut Random) -> Vec<Part> {
    let mut parts = Vec::new();
    let height = random.range(-0.2, 0.5);
    let out = lathe.radius_at(height);
    let thickness = random.range(0.05, 0.1);
    // Inside a bowl everything that reaches inwards would show.
    let bury = if hollow { 0.0 } else { 0.5 };
    let handles = random.count(0, 2);
    for side in [1.0, -1.0].into_iter().take(handles) {
        let radius = random.range(0.2, 0.4);
        let centre = Vec3::new(side * (out + radius * (0.9 - bury)), height, 0.0);
        parts.push(Part::ring(centre, Vec3::Z, radius, thickness));
    }
    if handles == 1 && !hollow {
        // A spout across from the handle.
        let start = Vec3::new(-0.8 * out, height - 0.3, 0.0);
        let end = Vec3::new(
            -out - random.range(0.3, 0.6),
            height + random.range(0.2, 0.5),
            0.0,
        );
        parts.push(Part::capsule(start, end, [2.0 * thickness, thickness]));
    }
    if !hollow {
        let size = random.range(0.1, 0.25);
        parts.push(Part::sphere(Vec3::new(0.0, 1.0 + 0.6 * size, 0.0), size));
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Stream, about_x};
    use crate::shapes::relief::Relief;
    use crate::shapes::shape::{Body, Shape};
    use crate::shapes::{Detail, View, Window};

    /// From 50 degrees above, a good part of what is seen lies within the wall.
    #[test]
    fn open_vessels_are_seen_into() {
        let mut holes = 0;
        for seed in 0..20 {
            let vessel = vessel(&mut Random::new(seed, Stream::Shape), true);
            let lathe = vessel.lathe.clone();
            let turn = about_x(50f32.to_radians());
            let body = Body::Lathe(vessel.lathe);
            let shape = Shape::new(body, Vec::new(), 0.0, Relief::default(), turn);
            let window = Window::square(0.0, 0.0, 4.4, 64, 0.0);
            let view = View::trace(&shape, window, Detail::All);
            let (mut all, mut within) = (0, 0);
            for pixel in (0..64 * 64).filter(|&pixel| view.is_inside(pixel)) {
                let place = turn.transpose() * window.ray(pixel).at(view.depth[pixel]);
                let out = (place.x * place.x + place.z * place.z).sqrt();
                all += 1;
                within += usize::from(place.y < 0.9 && out < lathe.radius_at(place.y) - 0.04);
            }
            assert!(15 * within > all, "{seed}: {within} of {all}");
            holes += enclosed(&view);
        }
        println!("{holes} pixels");
        // Rays that leap over a wall or get stuck leave holes, in some ten thousand pixels.
        assert!(holes < 40, "{holes} pixels");
    }

    /// Pixels with nothing that cannot be reached from the border.
    fn enclosed(view: &View) -> usize {
        let side = view.window.width;
        let mut outside = vec![false; side * side];
        let mut open = vec![0];
        while let Some(pixel) = open.pop() {
            if outside[pixel] || view.is_inside(pixel) {
                continue;
            }
            outside[pixel] = true;
            let (row, column) = (pixel / side, pixel % side);
            open.extend((column > 0).then(|| pixel - 1));
            open.extend((column + 1 < side).then(|| pixel + 1));
            open.extend((row > 0).then(|| pixel - side));
            open.extend((row + 1 < side).then(|| pixel + side));
        }
        let empty = |&pixel: &usize| !view.is_inside(pixel) && !outside[pixel];
        (0..side * side).filter(empty).count()
    }
}
