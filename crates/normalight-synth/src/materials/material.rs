use super::measured::Measured;
use super::pattern::{Pattern, smooth_step};
use super::surface::{MAX_LAYERS, Surface};
use crate::noise::Lattice;
use crate::random::Random;
use crate::recipe::MaterialRecipe;
use glam::{Mat3, Vec3};

/// Fit of the light that a lobe of rough facets loses, see [`between_facets`].
const LOST: [f32; 3] = [0.2256, 1.1638, -0.8221];

/// A material: one layer, or several side by side that meet along a noisy border.
#[derive(Debug, Clone)]
pub(crate) struct Material {
    first: MaterialLayer,
    others: Vec<(MaterialLayer, Border)>,
    /// The measured ones among the layers, as [`Surface::measured`] numbers them.
    measured: Vec<Measured>,
}

/// A layer with its patterns.
#[derive(Debug, Clone)]
struct MaterialLayer {
    surface: Surface,
    /// Number of the measured layer, if it is one.
    measured: Option<usize>,
    /// A pattern and the colour at its other end, relative to the first for measured layers.
    coloured: Option<(Pattern, Vec3)>,
    /// A pattern and the factor of the highlight's width at its other end.
    roughened: Option<(Pattern, f32)>,
}

/// Where another layer lies over the first.
#[derive(Debug, Clone)]
struct Border {
    to_noise: Mat3,
    offset: Vec3,
    threshold: f32,
    softness: f32,
}

impl Material {
    /// Draws a material; `library` holds the measured materials to choose from.
    pub(crate) fn draw(recipe: &MaterialRecipe, library: &[Measured], random: &mut Random) -> Self {
        let mut measured = Vec::new();
        let first = MaterialLayer::draw(recipe, library, &mut measured, random);
        let mut others = Vec::new();
        if random.chance(recipe.mixed_share) {
            for _ in 0..random.count(1, MAX_LAYERS - 1) {
                let border = Border {
                    to_noise: random.rotation() * random.log_range(0.8, 8.0),
                    offset: random.vector(16.0),
                    threshold: random.signed(0.35),
                    softness: random.log_range(0.01, 1.0),
                };
                let other = MaterialLayer::draw(recipe, library, &mut measured, random);
                others.push((other, border));
            }
        }
        Self {
            first,
            others,
            measured,
        }
    }

    pub(crate) fn measured(&self) -> &[Measured] {
        &self.measured
    }

    /// What the object is made of at a point of its surface.
    pub(crate) fn at(&self, lattice: &Lattice, point: Vec3) -> Surface {
        let mut surface = self.first.at(lattice, point);
        for (layer, border) in &self.others {
            let noise = lattice.at(border.to_noise * point + border.offset);
            let share = smooth_step((noise - border.threshold) / border.softness + 0.5);
            if share > 0.0 {
                surface = surface.mixed(&layer.at(lattice, point), share);
            }
        }
        surface
    }
}

impl MaterialLayer {
    fn draw(
        recipe: &MaterialRecipe,
        library: &[Measured],
        measured: &mut Vec<Measured>,
        random: &mut Random,
    ) -> Self {
        let number = (!library.is_empty() && random.chance(recipe.measured_share)).then(|| {
            measured.push(library[random.below(library.len())].clone());
            measured.len() - 1
        });
        let stone = number.is_none() && random.chance(recipe.dark_stone_share);
        let mut surface = match number {
            // Without any light of its own.
            Some(_) => Surface::MATTE,
            None if stone => dark_stone(random),
            None => modelled(recipe, random),
        };
        surface.axis = random.direction();
        let coloured = random.chance(recipe.textured_share).then(|| {
            let pattern = Pattern::draw(random);
            // Dark stone has dark grains and veins.
            let strength = if stone { 0.2 } else { 1.0 };
            (pattern, colour(recipe, random) * strength)
        });
        if let Some(number) = number {
            surface.measured[number] = Vec3::ONE;
        }
        let roughened = random.chance(recipe.rough_texture_share).then(|| {
            let factor = random.log_range(0.3, 3.0);
            (Pattern::draw(random), factor)
        });
        Self {
            surface,
            measured: number,
            coloured,
            roughened,
        }
    }

    fn at(&self, lattice: &Lattice, point: Vec3) -> Surface {
        let mut surface = self.surface;
        if let Some((pattern, colour)) = &self.coloured {
            let share = pattern.at(lattice, point);
            match self.measured {
                Some(number) => surface.measured[number] = Vec3::ONE.lerp(*colour, share),
                None => surface.albedo = surface.albedo.lerp(*colour, share),
            }
        }
        if let Some((pattern, factor)) = &self.roughened {
            let factor = 1.0 + (factor - 1.0) * pattern.at(lattice, point);
            surface.alphas = surface
                .alphas
                .map(|alpha| (alpha * factor).clamp(0.02, 1.0));
            surface.wide_alpha = (surface.wide_alpha * factor).clamp(0.02, 1.0);
        }
        surface
    }
}

/// A layer of diffuse light and highlights by formula.
fn modelled(recipe: &MaterialRecipe, random: &mut Random) -> Surface {
    let metal = random.chance(recipe.metal_share);
    if metal && random.chance(recipe.broad_metal_share) {
        return broad_metal(recipe, random);
    }
    let alpha = rough(recipe, random);
    let mut surface = Surface {
        alphas: [alpha; 2],
        ..Surface::MATTE
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
    if surface.weights[0] > 0.0 && random.chance(recipe.brushed_share) {
        let stretch = random.log_range(1.3, 5.0);
        surface.alphas = [(alpha * stretch).min(1.0), (alpha / stretch).max(0.02)];
    }
    if surface.weights[0] > 0.0 && random.chance(0.4) {
        // Measured highlights have long tails: a second, wider one under the first.
        let share = random.range(0.2, 0.7);
        let wider = alpha * random.range(1.5, 4.0);
        surface.wide_alpha = wider.min(1.0);
        surface.weights[1] = surface.weights[0] * share;
        surface.weights[0] *= 1.0 - share;
    }
    if random.chance(recipe.rough_diffuse_share) {
        surface.facet_variance = random.range(0.02, 0.5);
    }
    if random.chance(recipe.sheen_share) {
        surface.sheen = random.range(0.05, 0.5) * surface.albedo.max_element();
    }
    surface
}

/// Metal whose highlights are as wide as shading: blasted with sand, coarsely brushed, or painted with
/// flakes of metal under a gloss.
fn broad_metal(recipe: &MaterialRecipe, random: &mut Random) -> Surface {
    let alpha = random.log_range(0.3, 0.9);
    let mut surface = Surface {
        f0: metal_colour(random),
        alphas: [alpha; 2],
        weights: [1.0, 0.0],
        ..Surface::MATTE
    };
    match random.below(3) {
        0 => {}
        1 => {
            let stretch = random.log_range(1.3, 3.0);
            surface.alphas = [(alpha * stretch).min(1.0), alpha / stretch];
        }
        _ => {
            // The gloss reflects about 4 %, the flakes most of the rest; paint may have any colour.
            surface.f0 = surface.f0.lerp(colour(recipe, random), random.unit());
            surface.alphas = [random.log_range(0.04, 0.15); 2];
            surface.wide_alpha = alpha;
            surface.weights = [0.04 / surface.f0.max_element().max(0.1), 0.9];
        }
    }
    surface.albedo = between_facets(surface.f0, alpha) + colour(recipe, random) * 0.05;
    surface
}

/// Light that leaves rough metal of reflectance `f0` only after several facets, which a lobe of single
/// facets lacks, as a diffuse colour (Kulla & Conty 2017): what all directions together lose in a lobe of
/// width `alpha`, 0.2..=0.9, is fitted to the lobe of [`super::shade`].
pub(super) fn between_facets(f0: Vec3, alpha: f32) -> Vec3 {
    let lost = alpha * (LOST[0] + alpha * (LOST[1] + alpha * LOST[2]));
    f0 * f0 * (lost * (1.0 - lost)) / (Vec3::ONE - f0 * lost)
}

/// Polished: black granite, basalt, obsidian.
fn dark_stone(random: &mut Random) -> Surface {
    Surface {
        albedo: (Vec3::ONE + random.vector(0.2)) * random.log_range(0.008, 0.06),
        f0: Vec3::splat(random.range(0.035, 0.07)),
        alphas: [random.log_range(0.03, 0.15); 2],
        weights: [1.0, 0.0],
        ..Surface::MATTE
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
