//! Whether lights that were given fit the photographs: at its outline an object turns outwards, so that it must be brightest
//! there when the light comes from outside.
use crate::woodham::{NEARLY_FLAT, mean_outer, outer};
use crate::{ImageStack, Light, Mask, luminance};
use glam::{DMat3, Mat3, Vec2, Vec3};

/// Longest side of the grid on which the object is looked at.
const GRID: usize = 512;
/// Fewest points of the outline that say anything.
const FEW: usize = 48;
/// Most points of the object that are looked at.
const MOST: usize = 4000;
/// Sum of the light's two axes below which the photographs contradict the lights. Of 64 rendered scenes of unseen
/// meshes under 8 and under 24 true lights none has less than 0.24, half have more than 0.7; under lights in another
/// order, or in other axes, half have less than 0.05.
const CONTRADICTED: f32 = 0.2;
/// The least of other axes, and how much better they must be, before they are proposed: of those 128 true ones none
/// has others that are better by more than 0.17.
const PROPOSED: [f32; 2] = [0.4, 0.3];
/// Random orders of the lights, of which each must explain the photographs worse than theirs by this factor before
/// their axes can be at fault: turning all lights alike explains them just as well. Under true lights nine in ten
/// stay below this, under lights in a random order all of 64 above.
const ORDERS: usize = 24;
const ORDERED: f32 = 0.9;

/// How well lights and photographs agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightAgreement {
    /// How far the normals that the lights give lean outwards at the object's outline, as the sum of the means of both
    /// image axes: -1 inwards, 0 neither, 1 outwards.
    pub outwards: f32,
    /// Axes in which the lights would agree much better: for each of their coordinates which axis it is, and whether it
    /// points the other way.
    pub other_axes: Option<[(usize, bool); 3]>,
}

impl LightAgreement {
    /// Compares lights with photographs.
    ///
    /// `None` where nothing can be said: too few points of an outline inside the frame, or lights that lie in a plane.
    ///
    /// # Panics
    /// The mask has another size, or there is not one light for each image: mistakes of the caller.
    pub fn of(stack: &ImageStack, mask: &Mask, lights: &[Light]) -> Option<Self> {
        assert_eq!(lights.len(), stack.len());
        assert_eq!(
            (mask.width(), mask.height()),
            (stack.width(), stack.height())
        );
        let (edge, outwards) = outline(mask);
        if edge.len() < FEW {
            return None;
        }
        let inside = thinned(mask.pixels());
        let normals = normals(stack, lights, &[&edge[..], &inside].concat())?;
        let (edge, facing) = normals.split_at(outwards.len());
        let share = 1.0 / edge.len() as f32;
        let pairs = || edge.iter().zip(&outwards);
        // Column by column: the mean of each coordinate along the outward direction's x and y, and towards the camera.
        let lean = Mat3::from_cols(
            pairs().map(|(&n, o)| n * o.x).sum::<Vec3>() * share,
            pairs().map(|(&n, o)| n * o.y).sum::<Vec3>() * share,
            facing.iter().sum::<Vec3>() / facing.len().max(1) as f32,
        );
        let given = lean.x_axis.x + lean.y_axis.y;
        let (axes, best) = best_axes(lean);
        let gap = best - given - lean.z_axis.z;
        let flat = best - lean.z_axis[source(axes, 2)].abs();
        let proposed =
            flat > PROPOSED[0] && gap > PROPOSED[1] && is_ordered(stack, &inside, lights);
        Some(Self {
            outwards: given,
            other_axes: proposed.then_some(axes),
        })
    }

    /// Whether the lights cannot be those of the photographs.
    pub fn contradicts(&self) -> bool {
        self.outwards < CONTRADICTED || self.other_axes.is_some()
    }
}

/// Whether each light is explained better by its own photograph than by others.
fn is_ordered(stack: &ImageStack, pixels: &[usize], lights: &[Light]) -> bool {
    let count = lights.len();
    let mut colors = vec![[0.0; 3]; pixels.len()];
    let shots: Vec<Vec<f32>> = (0..count)
        .map(|image| {
            stack.linear_pixels(image, pixels, &mut colors);
            colors.iter().map(|&color| luminance(color)).collect()
        })
        .collect();
    let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| f64::from(a * b)).sum::<f64>();
    let products: Vec<Vec<f64>> = shots
        .iter()
        .map(|a| shots.iter().map(|b| dot(a, b)).collect())
        .collect();
    let total: f64 = (0..count).map(|k| products[k][k]).sum();
    let gram = lights.iter().map(|light| outer(light.direction.as_dvec3()));
    let inverse = gram.fold(DMat3::ZERO, |sum, one| sum + one).inverse();
    // What least squares leave unexplained, over all pixels at once.
    let rest = |order: &[usize]| {
        let mut explained = 0.0;
        for (a, &light) in order.iter().enumerate() {
            let turned = inverse * lights[light].direction.as_dvec3();
            for (b, &other) in order.iter().enumerate() {
                explained += products[a][b] * turned.dot(lights[other].direction.as_dvec3());
            }
        }
        total - explained
    };
    let mut order: Vec<usize> = (0..count).collect();
    let own = rest(&order);
    let mut state = 1u64;
    (0..ORDERS).all(|_| {
        for place in (1..count).rev() {
            // Knuth's linear congruential generator: any will do.
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            order.swap(place, (state >> 33) as usize % (place + 1));
        }
        own < f64::from(ORDERED) * rest(&order)
    })
}

/// Which given coordinate becomes our axis.
fn source(axes: [(usize, bool); 3], axis: usize) -> usize {
    axes.iter().position(|&(to, _)| to == axis).unwrap_or(axis)
}

/// The signed order of coordinates under which all three axes agree best, and their sum.
fn best_axes(lean: Mat3) -> ([(usize, bool); 3], f32) {
    const ORDERS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [1, 0, 2],
        [0, 2, 1],
        [2, 1, 0],
        [1, 2, 0],
        [2, 0, 1],
    ];
    let sum = |order: &[usize; 3]| (0..3).map(|k| lean.col(order[k])[k].abs()).sum::<f32>();
    let order = ORDERS
        .into_iter()
        .max_by(|a, b| sum(a).total_cmp(&sum(b)))
        .unwrap_or(ORDERS[0]);
    let axes = [0, 1, 2].map(|k| (order[k], lean.col(order[k])[k] < 0.0));
    (axes, sum(&order))
}

/// Points near the object's outline, and the outward direction at each (x right, y up).
fn outline(mask: &Mask) -> (Vec<usize>, Vec<Vec2>) {
    let stride = mask.width().max(mask.height()).div_ceil(GRID).max(1);
    let (width, height) = (mask.width() / stride, mask.height() / stride);
    let at = |x: usize, y: usize| y * stride * mask.width() + x * stride;
    let inside = |x: usize, y: usize| mask.inside()[at(x, y)];
    let sums = Sums::new(width, height, inside);
    let area = sums.of([0, width], [0, height]);
    let reach = ((f64::from(area).sqrt() / 30.0).round() as usize).max(2);
    let mut found = Vec::new();
    for y in reach + 1..height.saturating_sub(reach + 1) {
        for x in reach + 1..width.saturating_sub(reach + 1) {
            if !inside(x, y) {
                continue;
            }
            let window = |x: usize, y: usize| {
                let count = sums.of([x - reach, x + reach + 1], [y - reach, y + reach + 1]);
                count as f32 / ((2 * reach + 1) as f32).powi(2)
            };
            let falls = Vec2::new(
                window(x - 1, y) - window(x + 1, y),
                window(x, y + 1) - window(x, y - 1),
            );
            if window(x, y) < 0.85 && falls.length() > 1e-6 {
                found.push((at(x, y), falls.normalize()));
            }
        }
    }
    thinned(found).into_iter().unzip()
}

/// At most [`MOST`] of them, evenly spaced.
fn thinned<T: Copy>(all: Vec<T>) -> Vec<T> {
    all.iter()
        .copied()
        .step_by(all.len().div_ceil(MOST).max(1))
        .collect()
}

/// Least-squares normals of single pixels under these lights (Woodham 1980); zero for black ones. `None` for lights in a
/// plane.
fn normals(stack: &ImageStack, lights: &[Light], pixels: &[usize]) -> Option<Vec<Vec3>> {
    let directions: Vec<Vec3> = lights.iter().map(|light| light.direction).collect();
    let gram = mean_outer(&directions);
    if gram.determinant() < NEARLY_FLAT {
        return None;
    }
    let gram = gram.as_mat3();
    let inverse = gram.inverse();
    let mut sums = vec![Vec3::ZERO; pixels.len()];
    let mut colors = vec![[0.0; 3]; pixels.len()];
    for (image, light) in lights.iter().enumerate() {
        stack.linear_pixels(image, pixels, &mut colors);
        let weight = light.direction / light.mean_intensity().max(f32::MIN_POSITIVE);
        for (sum, &color) in sums.iter_mut().zip(&colors) {
            *sum += weight * luminance(color);
        }
    }
    let turn = |sum: Vec3| (inverse * sum).normalize_or_zero();
    Some(sums.into_iter().map(turn).collect())
}

/// Counts of points inside, summed from the upper left corner.
struct Sums {
    width: usize,
    sums: Vec<u32>,
}

impl Sums {
    fn new(width: usize, height: usize, inside: impl Fn(usize, usize) -> bool) -> Self {
        let mut sums = vec![0; (width + 1) * (height + 1)];
        for y in 0..height {
            let mut row = 0;
            for x in 0..width {
                row += u32::from(inside(x, y));
                sums[(y + 1) * (width + 1) + x + 1] = sums[y * (width + 1) + x + 1] + row;
            }
        }
        Self { width, sums }
    }

    /// How many are inside of these columns and rows (from, to).
    fn of(&self, x: [usize; 2], y: [usize; 2]) -> u32 {
        let sum = |x: usize, y: usize| self.sums[y * (self.width + 1) + x];
        sum(x[1], y[1]) + sum(x[0], y[0]) - sum(x[0], y[1]) - sum(x[1], y[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Samples, StackImage, Transfer};

    const SIDE: usize = 80;

    fn normal(pixel: usize) -> Vec3 {
        let x = (pixel % SIDE) as f32 - 39.5;
        let y = 39.5 - (pixel / SIDE) as f32;
        let z = 900.0 - x * x - y * y;
        if z > 0.0 {
            Vec3::new(x, y, z.sqrt()) / 30.0
        } else {
            Vec3::ZERO
        }
    }

    /// A matte ball under lights on two cones, its mask and the lights.
    fn ball() -> (ImageStack, Mask, Vec<Light>) {
        let lights: Vec<Light> = (0..10)
            .map(|k| {
                let turn = k as f32 * 2.4;
                let tilt = if k % 2 == 0 { 0.4 } else { 0.9 };
                let direction = Vec3::new(turn.cos() * tilt, turn.sin() * tilt, 1.0);
                Light::new(direction, 1.0)
            })
            .collect();
        let image = |light: &Light| StackImage {
            name: String::new(),
            width: SIDE,
            height: SIDE,
            channels: 1,
            samples: Samples::F32(
                (0..SIDE * SIDE)
                    .map(|pixel| 0.6 * normal(pixel).dot(light.direction).max(0.0))
                    .collect(),
            ),
            transfer: Transfer::Linear,
        };
        let stack = ImageStack::new(lights.iter().map(image).collect()).unwrap();
        let inside = (0..SIDE * SIDE).map(|p| normal(p) != Vec3::ZERO).collect();
        (stack, Mask::new(SIDE, SIDE, inside), lights)
    }

    #[test]
    fn true_lights_agree_and_others_do_not() {
        let (stack, mask, lights) = ball();
        let of = |lights: &[Light]| LightAgreement::of(&stack, &mask, lights).unwrap();
        let found = of(&lights);
        // Near the outline of a ball normals lie nearly in the image.
        assert!(found.outwards > 0.75, "{found:?}");
        assert_eq!(found.other_axes, None);
        let turned = |turn: &dyn Fn(Vec3) -> Vec3| -> Vec<Light> {
            let turned = lights.iter().map(|light| Light {
                direction: turn(light.direction),
                ..*light
            });
            turned.collect()
        };
        let down = of(&turned(&|l| Vec3::new(l.x, -l.y, l.z)));
        assert!(down.contradicts(), "{down:?}");
        assert_eq!(down.other_axes, Some([(0, false), (1, true), (2, false)]));
        let swapped = of(&turned(&|l| Vec3::new(l.y, l.z, -l.x)));
        assert_eq!(
            swapped.other_axes,
            Some([(1, false), (2, false), (0, true)])
        );
        let mut order = lights.clone();
        for k in 0..5 {
            order.swap(2 * k, (7 * k + 3) % 10);
        }
        let found = of(&order);
        assert!(
            found.contradicts() && found.other_axes.is_none(),
            "{found:?}"
        );
    }

    #[test]
    fn without_an_outline_nothing_is_said() {
        let (stack, _, lights) = ball();
        let whole = Mask::whole(SIDE, SIDE);
        assert_eq!(LightAgreement::of(&stack, &whole, &lights), None);
        let (_, mask, _) = ball();
        let flat = vec![Light::new(Vec3::X, 1.0); lights.len()];
        assert_eq!(LightAgreement::of(&stack, &mask, &flat), None);
    }
}
