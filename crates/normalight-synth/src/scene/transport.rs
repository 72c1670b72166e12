use super::points::Points;
use crate::lighting::{Bounces, Lamp, Shadows, narrow, open_sky};
use crate::materials::{Surfaces, shade};
use crate::random::Random;
use crate::recipe::TransportRecipe;
use crate::shapes::View;

/// Which light paths a scene has.
pub(super) struct Transport {
    shadows: bool,
    bounces: bool,
    ambient: f32,
}

impl Transport {
    pub(super) fn draw(recipe: &TransportRecipe, random: &mut Random) -> Self {
        Self {
            shadows: random.chance(recipe.cast_shadow_share),
            bounces: random.chance(recipe.bounce_share),
            ambient: if random.chance(recipe.ambient_share) {
                recipe.ambient * random.unit()
            } else {
                0.0
            },
        }
    }

    /// Light of each lamp that reaches the camera.
    ///
    /// `[lamps][3][points]`
    pub(super) fn light(
        &self,
        view: &View,
        points: &Points,
        surfaces: &Surfaces,
        lamps: &[Lamp],
    ) -> Vec<[Vec<f32>; 3]> {
        let count = points.normal[0].len();
        let shadows = self.shadows.then(|| Shadows::new(view));
        let mut irradiance = Vec::new();
        let mut radiance = Vec::with_capacity(lamps.len());
        for lamp in lamps {
            let mut lit = vec![1.0; count];
            if let Some(shadows) = &shadows {
                let all = shadows.lit(lamp);
                for (lit, &pixel) in lit.iter_mut().zip(&points.pixels) {
                    *lit = all[pixel as usize];
                }
            }
            narrow(lamp, points, &mut lit);
            let mut planes = std::array::from_fn(|_| vec![0.0; count]);
            shade(points, surfaces, lamp, &lit, &mut planes);
            radiance.push(planes);
            if self.bounces {
                lamp.dim(points, &mut lit);
                irradiance.push(lit);
            }
        }
        if self.bounces {
            Bounces::new(view, points).add(points, surfaces, &irradiance, &mut radiance);
        }
        radiance
    }
    /// Light of the room that is the same in all images.
    ///
    /// `[3][points]`
    pub(super) fn ambient(&self, points: &Points, surfaces: &Surfaces) -> Option<[Vec<f32>; 3]> {
        (self.ambient > 0.0).then(|| room_light(self.ambient, points, surfaces))
    }
}

/// What the room's light adds: more on surfaces that face the camera's side, less in grooves.
fn room_light(strength: f32, points: &Points, surfaces: &Surfaces) -> [Vec<f32>; 3] {
    let facing = points.normal[2].iter().map(|z| 0.5 + 0.5 * z);
    let mut arriving: Vec<f32> = facing.map(|share| strength * share).collect();
    for (arriving, &ratio) in arriving.iter_mut().zip(&points.grooves) {
        *arriving *= open_sky(ratio);
    }
    std::array::from_fn(|channel| {
        let scattered = surfaces.scattered[channel].iter();
        scattered.zip(&arriving).map(|(s, a)| s * a).collect()
    })
}
