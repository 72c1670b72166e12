use super::relief::Relief;
use super::view::{View, faced};
use crate::noise::Lattice;
use crate::random::Random;
use crate::recipe::ShapeRecipe;
use glam::{Mat3, Vec3};

/// Most that relief displaces a mesh of reach 1: its walls are thin.
const MOST_ON_MESHES: f32 = 0.04;
/// Steeper views than this cosine are displaced along the ray as if they were not.
const STEEPEST: f32 = 0.3;

/// Relief on top of what a view shows, whatever the shape: as displacement mapping and normal maps have it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Overlay {
    relief: Relief,
    /// A few pixels wide: too narrow for the picture's depth to cast its shadows, so it only turns normals
    /// and makes grooves.
    fine: Relief,
}

impl Overlay {
    /// `is_mesh`: meshes have no relief yet. `pitch`: side of a pixel.
    pub(crate) fn draw(
        recipe: &ShapeRecipe,
        random: &mut Random,
        is_mesh: bool,
        pitch: f32,
    ) -> Self {
        let mut overlay = Self::default();
        // Folds and grooves hang down or lie across.
        let turn = match random.chance(0.5) {
            true => Mat3::IDENTITY,
            false => random.rotation(),
        };
        if is_mesh && random.chance(recipe.mesh_relief_share) {
            let strong = random.chance(recipe.strong_relief_share);
            overlay.relief = Relief::draw(random, strong, turn).limited(MOST_ON_MESHES);
        }
        if random.chance(recipe.fine_relief_share) {
            overlay.fine = Relief::fine(random, pitch, turn);
        }
        overlay
    }

    /// Displaces what is seen to where its distance from the smooth surface is the relief's height `h`: depth
    /// along the ray, which finds the place, and normals, `n - grad h` there. The smooth surface's `n` is taken
    /// from before, off by at most `h` times its curvature and the tangent of the view. Nothing new comes into sight,
    /// and nothing is hidden.
    ///
    /// Returns how many times as deep as wide the narrow grooves are that each pixel lies in, nothing if
    /// there are none. `[height, width]`
    pub(crate) fn apply(&self, view: &mut View) -> Vec<f32> {
        let lattice = Lattice::shared();
        let mut grooves = Vec::new();
        if self.relief.is_flat() && self.fine.is_flat() {
            return grooves;
        }
        if !self.fine.is_flat() {
            grooves = vec![0.0; view.depth.len()];
        }
        let spread = 0.5 * view.window.pitch;
        for pixel in 0..view.depth.len() {
            if !view.is_inside(pixel) {
                continue;
            }
            let ray = view.window.ray(pixel);
            let (normal, to_camera) = (view.normals[pixel], ray.to_camera());
            let depth = view.depth[pixel];
            let per_height = to_camera.z / normal.dot(to_camera).max(STEEPEST);
            let displaced = |place: Vec3| depth + self.relief.at(lattice, place) * per_height;
            let near = ray.at(displaced(ray.at(depth)));
            view.depth[pixel] = displaced(near);
            view.back[pixel] = view.back[pixel].min(view.depth[pixel]);
            let place = ray.at(view.depth[pixel]);
            let carved = normal - self.gradient(lattice, place, spread);
            view.normals[pixel] = faced(carved.normalize_or(normal), to_camera);
            if let Some(groove) = grooves.get_mut(pixel) {
                *groove = self.fine.groove(lattice, place);
            }
        }
        grooves
    }

    fn gradient(&self, lattice: &Lattice, place: Vec3, spread: f32) -> Vec3 {
        let both = [&self.relief, &self.fine].into_iter();
        both.filter(|relief| !relief.is_flat())
            .map(|relief| relief.gradient(lattice, place, spread))
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;
    use crate::shapes::part::Part;
    use crate::shapes::shape::{Body, Shape};
    use crate::shapes::view::Detail;
    use crate::shapes::window::Window;

    /// A ball with relief laid over its picture against the same relief carved into the solid.
    #[test]
    fn relief_over_a_picture_is_that_of_the_solid() {
        let window = Window::square(0.0, 0.0, 2.4, 120, 0.1);
        let ball = |relief: &Relief| {
            let parts = vec![Part::sphere(Vec3::ZERO, 1.0)];
            let shape = Shape::new(Body::None, parts, 0.0, relief.clone(), Mat3::IDENTITY);
            View::trace(&shape, window, Detail::All)
        };
        for seed in 0..8 {
            let mut random = Random::new(seed, Stream::Overlay);
            let relief = Relief::draw(&mut random, false, Mat3::IDENTITY).limited(MOST_ON_MESHES);
            let (plain, carved) = (ball(&Relief::default()), ball(&relief));
            let mut laid = plain.clone();
            let fine = Relief::default();
            let grooves = Overlay { relief, fine }.apply(&mut laid);
            assert!(grooves.is_empty());
            let (mut count, mut depth, mut angle) = (0.0, [0.0; 2], [0.0; 2]);
            for pixel in (0..120 * 120).filter(|&pixel| plain.normals[pixel].z > 0.5) {
                count += 1.0;
                for (which, view) in [&plain, &laid].into_iter().enumerate() {
                    depth[which] += (view.depth[pixel] - carved.depth[pixel]).abs();
                    angle[which] += view.normals[pixel]
                        .angle_between(carved.normals[pixel])
                        .to_degrees();
                }
            }
            println!("depth {depth:?}, normals {angle:?} over {count}");
            assert!(depth[1] < 0.1 * depth[0], "{depth:?}");
            // Off by `h tan`: the smooth normal is that of the place before.
            assert!(angle[1] < 0.3 * angle[0], "{angle:?} over {count}");
        }
    }
}
