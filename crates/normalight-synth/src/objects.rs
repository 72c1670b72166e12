use crate::figures::figure;
use crate::part::Part;
use crate::random::{Random, about_x, about_y, about_z};
use crate::recipe::ShapeRecipe;
use crate::relief::Relief;
use crate::shape::Shape;
use crate::vessels::vessel;
use glam::{Mat3, Vec3};
use std::f32::consts::PI;

/// Draws an object.
pub(crate) fn object(recipe: &ShapeRecipe, random: &mut Random) -> Shape {
    let kind = random.weighted(&[
        recipe.sphere,
        recipe.ellipsoid,
        recipe.blob,
        recipe.lathe,
        recipe.statue,
    ]);
    match kind {
        0 => {
            let turn = random.rotation();
            let relief = relief(recipe, random, turn);
            let parts = vec![Part::sphere(Vec3::ZERO, 1.0)];
            Shape::new(None, parts, 0.0, relief, turn)
        }
        1 => {
            let turn = random.rotation();
            let relief = relief(recipe, random, turn);
            let parts = vec![Part::ellipsoid(Vec3::ZERO, radii(random), Mat3::IDENTITY)];
            Shape::new(None, parts, 0.0, relief, turn)
        }
        2 => blob(recipe, random),
        3 => {
            let vessel = vessel(random);
            let yaw = random.signed(PI);
            let turn = upright(recipe, random, yaw);
            let relief = relief(recipe, random, turn).limited(vessel.max_relief);
            let seam = random.range(0.02, 0.1);
            Shape::new(Some(vessel.lathe), vessel.fittings, seam, relief, turn)
        }
        _ => {
            let parts = figure(random);
            // People show the front.
            let front = if random.chance(0.75) { 1.0 } else { PI };
            let yaw = random.signed(front);
            let turn = upright(recipe, random, yaw);
            let relief = relief(recipe, random, turn).limited(0.06);
            Shape::new(None, parts, random.log_range(0.04, 0.2), relief, turn)
        }
    }
}

fn radii(random: &mut Random) -> Vec3 {
    Vec3::new(1.0, random.range(0.45, 1.0), random.range(0.45, 1.0))
}

fn blob(recipe: &ShapeRecipe, random: &mut Random) -> Shape {
    let turn = random.rotation();
    let mut surface = relief(recipe, random, turn);
    let (parts, seam) = if random.chance(0.4) {
        surface = surface.joined(Relief::lumps(random));
        (
            vec![Part::ellipsoid(Vec3::ZERO, radii(random), Mat3::IDENTITY)],
            0.0,
        )
    } else {
        let parts = (0..random.count(2, 8))
            .map(|_| {
                let size = random.range(0.25, 0.6);
                let centre = random.direction() * random.range(0.1, 0.7);
                Part::ellipsoid(centre, radii(random) * size, random.rotation())
            })
            .collect();
        (parts, random.range(0.1, 0.5))
    };
    Shape::new(None, parts, seam, surface, turn)
}

fn relief(recipe: &ShapeRecipe, random: &mut Random, turn: Mat3) -> Relief {
    if !random.chance(recipe.relief_share) {
        return Relief::default();
    }
    let strong = random.chance(recipe.strong_relief_share);
    Relief::draw(random, strong, turn)
}

/// As people put things on a table: seen a little from above more often than from below, hardly
/// leaning sideways. `yaw` in radians about the vertical axis.
fn upright(recipe: &ShapeRecipe, random: &mut Random, yaw: f32) -> Mat3 {
    let tilt = random.range(-0.4, 1.0) * recipe.max_tilt_degrees;
    let lean = random.signed(5.0);
    about_z(lean.to_radians()) * about_x(tilt.to_radians()) * about_y(yaw)
}
