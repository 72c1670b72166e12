use crate::brdf::Surface;
use crate::noise::Lattice;
use crate::random::Random;
use crate::recipe::MaterialRecipe;
use glam::{Mat3, Vec3};

/// A paint: one substance, or several that meet along a noisy border.
#[derive(Debug, Clone)]
pub(crate) struct Paint {
    first: Substance,
    others: Vec<(Substance, Border)>,
}

/// A substance with its pattern.
#[derive(Debug, Clone)]
struct Substance {
    surface: Surface,
    pattern: Option<Pattern>,
}

/// Where another substance lies over the first.
#[derive(Debug, Clone)]
struct Border {
    to_noise: Mat3,
    offset: Vec3,
    threshold: f32,
    softness: f32,
}

/// How the colour changes over the surface; a solid texture.
#[derive(Debug, Clone)]
struct Pattern {
    kind: PatternKind,
    to_noise: Mat3,
    offset: Vec3,
    /// Colour at the other end of the pattern.
    colour: Vec3,
}

#[derive(Debug, Clone, Copy)]
enum PatternKind {
    Clouds,
    /// Wavy stripes, with the sharpness of their borders.
    Stripes(f32),
    Cells,
}

impl Paint {
    pub(crate) fn draw(recipe: &MaterialRecipe, random: &mut Random) -> Self {
        let first = Substance::draw(recipe, random);
        let mut others = Vec::new();
        if random.chance(recipe.mixed_share) {
            for _ in 0..random.count(1, 2) {
                let border = Border {
                    to_noise: random.rotation() * random.log_range(0.8, 8.0),
                    offset: random.vector(16.0),
                    threshold: random.signed(0.35),
                    softness: random.log_range(0.01, 1.0),
                };
                others.push((Substance::draw(recipe, random), border));
            }
        }
        Self { first, others }
    }

    /// What the object is made of at a point of its surface.
    pub(crate) fn at(&self, lattice: &Lattice, point: Vec3) -> Surface {
        let mut surface = self.first.at(lattice, point);
        for (substance, border) in &self.others {
            let noise = lattice.at(border.to_noise * point + border.offset);
            let share = smooth_step((noise - border.threshold) / border.softness + 0.5);
            if share > 0.0 {
                surface = surface.mixed(&substance.at(lattice, point), share);
            }
        }
        surface
    }
}

impl Substance {
    fn draw(recipe: &MaterialRecipe, random: &mut Random) -> Self {
        let metal = random.chance(recipe.metal_share);
        let mut surface = Surface {
            alphas: [rough(recipe, random), 1.0],
            ..Surface::default()
        };
        if metal {
            surface.f0 = metal_colour(random);
            surface.albedo = colour(recipe, random) * random.range(0.0, 0.2);
            surface.weights[0] = 1.0;
        } else {
            surface.albedo = colour(recipe, random);
            if !random.chance(recipe.matte_share) {
                let [low, high] = recipe.dielectric_f0;
                surface.f0 = Vec3::splat(random.range(low, high));
                surface.weights[0] = random.log_range(0.5, 2.5);
            }
        }
        if surface.weights[0] > 0.0 && random.chance(0.4) {
            // Measured highlights have long tails: a second, wider one under the first.
            let share = random.range(0.2, 0.7);
            let wider = surface.alphas[0] * random.range(1.5, 4.0);
            surface.alphas[1] = wider.min(1.0);
            surface.weights[1] = surface.weights[0] * share;
            surface.weights[0] *= 1.0 - share;
        }
        if random.chance(recipe.rough_diffuse_share) {
            surface.facet_variance = random.range(0.02, 0.5);
        }
        if random.chance(recipe.sheen_share) {
            surface.sheen = random.range(0.05, 0.5) * surface.albedo.max_element();
        }
        let pattern = random
            .chance(recipe.textured_share)
            .then(|| Pattern::draw(recipe, random));
        Self { surface, pattern }
    }

    fn at(&self, lattice: &Lattice, point: Vec3) -> Surface {
        let mut surface = self.surface;
        if let Some(pattern) = &self.pattern {
            let share = pattern.share(lattice, point);
            surface.albedo = surface.albedo.lerp(pattern.colour, share);
        }
        surface
    }
}

impl Pattern {
    fn draw(recipe: &MaterialRecipe, random: &mut Random) -> Self {
        let kind = match random.below(3) {
            0 => PatternKind::Clouds,
            1 => PatternKind::Stripes(random.log_range(1.0, 12.0)),
            _ => PatternKind::Cells,
        };
        Self {
            kind,
            to_noise: random.rotation() * random.log_range(1.5, 14.0),
            offset: random.vector(16.0),
            colour: colour(recipe, random),
        }
    }

    /// Share of the other colour.
    fn share(&self, lattice: &Lattice, point: Vec3) -> f32 {
        let place = self.to_noise * point + self.offset;
        match self.kind {
            PatternKind::Clouds => smooth_step(lattice.at(place) + 0.5),
            PatternKind::Stripes(sharpness) => {
                let along = place.x + 0.8 * lattice.at(place * 0.4);
                let wave = (along - along.floor() - 0.5).abs() * 4.0 - 1.0;
                smooth_step(wave * sharpness + 0.5)
            }
            PatternKind::Cells => {
                let warp = 0.4 * lattice.at(place * 0.7);
                0.5 + 0.5 * lattice.cell(place + Vec3::splat(warp))
            }
        }
    }
}

fn rough(recipe: &MaterialRecipe, random: &mut Random) -> f32 {
    random.log_range(recipe.roughness[0], recipe.roughness[1])
}

/// Any brightness, from grey to strongly coloured.
fn colour(recipe: &MaterialRecipe, random: &mut Random) -> Vec3 {
    let [low, high] = recipe.albedo;
    let brightness = if random.chance(0.5) {
        random.range(low, high)
    } else {
        random.log_range(low, high)
    };
    let strength = random.unit() * random.unit();
    let tint = Vec3::ONE + random.vector(1.0) * strength;
    (tint * brightness).clamp(Vec3::splat(low), Vec3::splat(high))
}

/// Grey steel to reddish copper and yellow gold, roughly.
fn metal_colour(random: &mut Random) -> Vec3 {
    let red = random.range(0.5, 0.97);
    let warmth = random.unit() * random.unit();
    let green = red * (1.0 - 0.4 * warmth * random.unit());
    Vec3::new(red, green, green * (1.0 - 0.6 * warmth))
}

fn smooth_step(value: f32) -> f32 {
    let t = value.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
