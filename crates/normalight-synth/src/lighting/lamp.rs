use super::layouts::directions;
use crate::lanes::{LANES, Lanes, lanes};
use crate::random::{Random, about_x, about_y};
use crate::recipe::LightRecipe;
use crate::scene::Points;
use glam::{Mat3, Vec3};
use normalight_core::Light;

/// Lights lower over the horizon than this z are raised: they would leave the image black.
const MIN_Z: f32 = 0.08;

/// Where a lamp stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lamp {
    /// Unit vector from the object's middle.
    pub(crate) direction: Vec3,
    /// Distance from the object's middle; `None` is infinitely far.
    pub(crate) distance: Option<f32>,
}

impl Lamp {
    pub(crate) fn distant(direction: Vec3) -> Self {
        Self {
            direction,
            distance: None,
        }
    }

    pub(crate) fn near(direction: Vec3, distance: f32) -> Self {
        Self {
            direction,
            distance: Some(distance),
        }
    }

    /// Unit vector from a place to the lamp.
    pub(crate) fn direction_from(&self, place: Vec3) -> Vec3 {
        match self.distance {
            None => self.direction,
            Some(distance) => (self.direction * distance - place).normalize_or(self.direction),
        }
    }

    /// Unit vectors from sixteen points to the lamp, and its strength there: 1 at the object's middle,
    /// falling with the square of the distance.
    #[inline(always)]
    pub(crate) fn seen_from(&self, points: &Points, start: usize) -> ([Lanes; 3], Lanes) {
        let direction = self.direction.to_array();
        let Some(distance) = self.distance else {
            return (direction.map(|value| [value; LANES]), [1.0; LANES]);
        };
        let mut to_lamp = [[0.0; LANES]; 3];
        let mut strength = [0.0; LANES];
        for (axis, to_lamp) in to_lamp.iter_mut().enumerate() {
            let place = lanes(&points.place[axis], start);
            for lane in 0..LANES {
                to_lamp[lane] = direction[axis] * distance - place[lane];
            }
        }
        for lane in 0..LANES {
            let [x, y, z] = [to_lamp[0][lane], to_lamp[1][lane], to_lamp[2][lane]];
            let square = x * x + y * y + z * z + 1e-6;
            let inverse = 1.0 / square.sqrt();
            strength[lane] = distance * distance / square;
            for to_lamp in &mut to_lamp {
                to_lamp[lane] *= inverse;
            }
        }
        (to_lamp, strength)
    }

    /// From the share of the lamp that points see to the light that falls on them, relative to a lamp of
    /// intensity 1 that faces them.
    pub(crate) fn dim(&self, points: &Points, lit: &mut [f32]) {
        for start in (0..lit.len()).step_by(LANES) {
            let (to_lamp, strength) = self.seen_from(points, start);
            let normal: [&Lanes; 3] =
                std::array::from_fn(|axis| lanes(&points.normal[axis], start));
            for lane in 0..LANES {
                let cosine = normal[0][lane] * to_lamp[0][lane]
                    + normal[1][lane] * to_lamp[1][lane]
                    + normal[2][lane] * to_lamp[2][lane];
                lit[start + lane] *= cosine.max(0.0) * strength[lane];
            }
        }
    }
}

/// Draws where the lamps of one scene stand. `reach`: radius of a sphere that holds the object.
pub(crate) fn lamps(
    recipe: &LightRecipe,
    random: &mut Random,
    count: usize,
    reach: f32,
) -> Vec<Lamp> {
    let directions = directions(recipe, random, count);
    let shift = if random.chance(recipe.shift_share) {
        let size = recipe.shift_degrees.to_radians();
        about_x(random.signed(size)) * about_y(random.signed(size))
    } else {
        Mat3::IDENTITY
    };
    let [low, high] = recipe.near_distance;
    let size = 2.0 * reach;
    let near = random
        .chance(recipe.near_share)
        .then(|| random.log_range(low, high) * size);
    directions
        .into_iter()
        .map(|direction| {
            let mut turned = shift * direction;
            turned.z = turned.z.max(MIN_Z);
            let direction = turned.normalize();
            match near {
                // A hand does not keep the distance exactly.
                Some(distance) => Lamp::near(direction, distance * random.range(0.85, 1.15)),
                None => Lamp::distant(direction),
            }
        })
        .collect()
}

/// Draws brightness and colour of each of the lamps.
pub(crate) fn tinted(recipe: &LightRecipe, random: &mut Random, lamps: &[Lamp]) -> Vec<Light> {
    let brightness = random.unit();
    let colour = if random.chance(recipe.colour_share) {
        recipe.colour * random.unit()
    } else {
        0.0
    };
    lamps
        .iter()
        .map(|lamp| {
            let intensity = if brightness < recipe.equal_share {
                1.0
            } else if brightness < recipe.equal_share + recipe.mild_share {
                random.range(0.7, 1.3)
            } else {
                random.log_range(recipe.intensity[0], recipe.intensity[1])
            };
            let mut light = Light::new(lamp.direction, intensity);
            if colour > 0.0 {
                light.intensity = light
                    .intensity
                    .map(|value| value * (1.0 + random.signed(colour)));
            }
            light
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Stream;

    #[test]
    fn lights_are_unit_vectors_in_front_of_the_object() {
        let recipe = LightRecipe::default();
        for seed in 0..200 {
            let mut random = Random::new(seed, Stream::Lights);
            let lamps = lamps(&recipe, &mut random, 12, 1.0);
            for light in tinted(&recipe, &mut random, &lamps) {
                assert!((light.direction.length() - 1.0).abs() < 1e-5);
                assert!(light.direction.z > 0.05);
                assert!(
                    light
                        .intensity
                        .iter()
                        .all(|i| (0.2 * 0.9..=2.0 * 1.1).contains(i))
                );
            }
        }
    }

    #[test]
    fn near_lamps_lose_strength_with_the_square_of_the_distance() {
        let lamp = Lamp::near(Vec3::Z, 4.0);
        let places = vec![
            Vec3::ZERO,
            Vec3::new(0.0, 0.0, 2.0),
            Vec3::new(3.0, 0.0, 0.0),
        ];
        let up = vec![Vec3::Z; 3];
        let points = Points::from_parts(vec![0; 3], places.clone(), up.clone(), &up);
        let (to_lamp, strength) = lamp.seen_from(&points, 0);
        for (lane, expected) in [1.0, 4.0, 16.0 / 25.0].into_iter().enumerate() {
            assert!((strength[lane] - expected).abs() < 1e-5);
            let direction = Vec3::new(to_lamp[0][lane], to_lamp[1][lane], to_lamp[2][lane]);
            assert!((direction - lamp.direction_from(places[lane])).length() < 1e-5);
        }
        assert!((to_lamp[0][2] + 0.6).abs() < 1e-5);
    }
}
