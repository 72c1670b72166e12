use super::figures::figure;
use super::library::Library;
use super::mesh::PosedMesh;
use super::part::Part;
use super::plate::Plate;
use super::relief::Relief;
use super::shape::{Body, Shape};
use super::vessels::vessel;
use super::view::{Detail, View};
use super::window::Window;
use crate::random::{Random, about_x, about_y, about_z};
use crate::recipe::ShapeRecipe;
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::PI;

/// Something to photograph, around the origin and about two units large.
pub(crate) enum Object<'a> {
    Solid(Box<Shape>),
    Mesh(PosedMesh<'a>),
}

impl Object<'_> {
    /// Half extents to the right and up of a rectangle around the origin that holds everything.
    pub(crate) fn extent(&self) -> Vec2 {
        match self {
            Self::Solid(shape) => shape.extent(),
            Self::Mesh(mesh) => mesh.extent(),
        }
    }

    /// Radius of a sphere around the origin that holds everything.
    pub(crate) fn reach(&self) -> f32 {
        match self {
            Self::Solid(shape) => shape.reach(),
            Self::Mesh(mesh) => mesh.reach(),
        }
    }

    pub(crate) fn view(&self, window: Window, detail: Detail) -> View {
        match self {
            Self::Solid(shape) => View::trace(shape, window, detail),
            Self::Mesh(mesh) => mesh.view(window, detail),
        }
    }
}

/// Draws an object; `meshes` are those of the recipe's folders.
pub(crate) fn object<'a>(
    recipe: &ShapeRecipe,
    meshes: &'a Library,
    random: &mut Random,
) -> Object<'a> {
    let kind = random.weighted(&[
        recipe.sphere,
        recipe.ellipsoid,
        recipe.blob,
        recipe.lathe,
        recipe.statue,
        recipe.plate,
        if meshes.is_empty() { 0.0 } else { recipe.mesh },
    ]);
    let shape = match kind {
        0 => {
            let turn = random.rotation();
            let relief = relief(recipe, random, turn);
            let parts = vec![Part::sphere(Vec3::ZERO, 1.0)];
            Shape::new(Body::None, parts, 0.0, relief, turn)
        }
        1 => {
            let turn = random.rotation();
            let relief = relief(recipe, random, turn);
            let parts = vec![Part::ellipsoid(Vec3::ZERO, radii(random), Mat3::IDENTITY)];
            Shape::new(Body::None, parts, 0.0, relief, turn)
        }
        2 => blob(recipe, random),
        3 => {
            let open = random.chance(recipe.open_vessel_share);
            let vessel = vessel(random, open);
            let yaw = random.signed(PI);
            let turn = match open {
                true => from_above(random, yaw),
                false => upright(recipe, random, yaw),
            };
            let relief = relief(recipe, random, turn).limited(vessel.max_relief);
            let seam = random.range(0.02, 0.1);
            let body = Body::Lathe(vessel.lathe);
            Shape::new(body, vessel.fittings, seam, relief, turn)
        }
        4 => {
            let parts = figure(random);
            let yaw = yaw(random);
            let turn = upright(recipe, random, yaw);
            let relief = relief(recipe, random, turn).limited(0.06);
            let seam = random.log_range(0.04, 0.2);
            Shape::new(Body::None, parts, seam, relief, turn)
        }
        5 => plate(recipe, random),
        _ => {
            let mesh = meshes.draw(random);
            let mesh = mesh.expect("only a library with meshes has a weight");
            let yaw = yaw(random);
            let turn = upright(recipe, random, yaw);
            return Object::Mesh(mesh.posed(turn));
        }
    };
    Object::Solid(Box::new(shape))
}

/// People show the front.
fn yaw(random: &mut Random) -> f32 {
    let front = if random.chance(0.75) { 1.0 } else { PI };
    random.signed(front)
}

/// Lying or hanging: seen nearly from the front; half of them with a figure pressed in.
fn plate(recipe: &ShapeRecipe, random: &mut Random) -> Shape {
    let plate = Plate::draw(random);
    let mut parts = Vec::new();
    if random.chance(0.5) {
        let depth = random.log_range(0.06, 0.4);
        let size = random.range(0.5, 0.75);
        parts = figure(random)
            .iter()
            .map(|part| part.scaled(size).pressed(depth))
            .collect();
    }
    let tilt = recipe.max_tilt_degrees.to_radians();
    let turn =
        about_z(random.signed(PI)) * about_x(random.signed(tilt)) * about_y(random.signed(tilt));
    let seam = random.log_range(0.005, 0.03);
    Shape::new(
        Body::Plate(Box::new(plate)),
        parts,
        seam,
        Relief::default(),
        turn,
    )
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
    Shape::new(Body::None, parts, seam, surface, turn)
}

fn relief(recipe: &ShapeRecipe, random: &mut Random, turn: Mat3) -> Relief {
    if !random.chance(recipe.relief_share) {
        return Relief::default();
    }
    let strong = random.chance(recipe.strong_relief_share);
    Relief::draw(random, strong, turn)
}

/// As one looks into a bowl. `yaw` as for [`upright`].
fn from_above(random: &mut Random, yaw: f32) -> Mat3 {
    let (tilt, lean) = (random.range(25.0, 70.0), random.signed(5.0));
    about_z(lean.to_radians()) * about_x(tilt.to_radians()) * about_y(yaw)
}

/// As people put things on a table: seen a little from above more often than from below, hardly
/// leaning sideways; a few lie as they fell. `yaw` in radians about the vertical axis.
fn upright(recipe: &ShapeRecipe, random: &mut Random, yaw: f32) -> Mat3 {
    if random.chance(recipe.tumbled_share) {
        return random.rotation();
    }
    let tilt = random.range(-0.4, 1.0) * recipe.max_tilt_degrees;
    let lean = random.signed(5.0);
    about_z(lean.to_radians()) * about_x(tilt.to_radians()) * about_y(yaw)
}
