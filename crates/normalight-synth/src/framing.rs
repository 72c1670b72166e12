use crate::random::Random;
use crate::recipe::ShapeRecipe;
use crate::shape::Shape;
use crate::view::{Detail, View, Window};

/// Longer side in pixels of the first look at a whole object, which finds where it is.
const COARSE_SCOUT: usize = 32;
/// The same for crops, which take the shadows and bounces of their surroundings from it.
const SCOUT: usize = 44;
/// Least share of a crop that shows the object.
const MIN_COVER: f32 = 0.4;

/// What part of the object a sample shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Framing {
    /// All of it, its longer side filling the square but for a margin: the view of the light
    /// network.
    WholeObject,
    /// A random square cut from a larger picture of the object, at least 40 % object.
    Crop,
}

/// The sample's view and one of the whole object.
pub(crate) struct Framed {
    pub(crate) view: View,
    /// `None` when `view` shows the whole object itself or nobody asked.
    pub(crate) overview: Option<View>,
}

/// Points the camera at the shape; `around` tells what to find out about the whole object.
pub(crate) fn frame(
    shape: &Shape,
    recipe: &ShapeRecipe,
    random: &mut Random,
    size: usize,
    framing: Framing,
    around: Option<Detail>,
) -> Framed {
    let extent = shape.extent();
    let pixels = match framing {
        Framing::WholeObject => COARSE_SCOUT,
        Framing::Crop => SCOUT,
    };
    let scout_pitch = 2.0 * extent.max_element() / pixels as f32;
    let window = Window {
        left: -extent.x,
        top: extent.y,
        pitch: scout_pitch,
        width: (2.0 * extent.x / scout_pitch + 1.0) as usize,
        height: (2.0 * extent.y / scout_pitch + 1.0) as usize,
    };
    let mut scout = View::trace(shape, window, Detail::Depth);
    let (x, y, side) = scout.bounds().unwrap_or((0.0, 0.0, 1.0));
    match framing {
        Framing::WholeObject => {
            let margin = random.range(recipe.margin[0], recipe.margin[1]);
            let side = side / (1.0 - 2.0 * margin);
            Framed {
                view: whole(shape, x, y, side, size),
                overview: None,
            }
        }
        Framing::Crop => {
            let [low, high] = recipe.crop_object_pixels;
            let pitch = side / random.log_range(low, high);
            let view = crop(shape, &scout, random, size, pitch);
            if around == Some(Detail::DepthAndNormals) {
                scout.find_normals(shape);
            }
            Framed {
                view,
                overview: around.map(|_| scout),
            }
        }
    }
}

/// The whole object; the coarse scout may have overlooked a thin tip, which must not be cut off.
fn whole(shape: &Shape, x: f32, y: f32, mut side: f32, size: usize) -> View {
    loop {
        let view = View::trace(shape, square(x, y, side, size), Detail::DepthAndNormals);
        // A window that holds the whole shape can only touch it in tiny images.
        if !view.touches_border() || side > 3.0 * shape.reach() {
            return view;
        }
        side *= 1.08;
    }
}

/// A random window with enough of the object; nearer than asked when the object is too slender.
fn crop(shape: &Shape, scout: &View, random: &mut Random, size: usize, pitch: f32) -> View {
    let inside: Vec<usize> = (0..scout.depth.len())
        .filter(|&pixel| scout.is_inside(pixel))
        .collect();
    let mut pitch = pitch;
    loop {
        for _ in 0..4 {
            let pixel = match inside.len() {
                0 => scout.depth.len() / 2,
                count => inside[random.below(count)],
            };
            let window = scout.window;
            // Anywhere around the pixel, so that outlines are seen as often as the inside.
            let shift = 0.3 * size as f32 * pitch;
            let x = window.x(pixel % window.width) + random.signed(shift);
            let y = window.y(pixel / window.width) + random.signed(shift);
            let candidate = square(x, y, size as f32 * pitch, size);
            // Smaller than a few pixels of the scout there is nothing to foresee.
            let tiny = pitch * (size as f32) < 3.0 * window.pitch;
            if !tiny && scout.cover(candidate) < MIN_COVER + 0.08 {
                continue;
            }
            let view = View::trace(shape, candidate, Detail::DepthAndNormals);
            let seen = (0..size * size)
                .filter(|&pixel| view.is_inside(pixel))
                .count();
            let tried_long = pitch * (size as f32) < 0.02 * window.pitch;
            if seen as f32 >= MIN_COVER * (size * size) as f32 || tried_long {
                return view;
            }
        }
        pitch *= 0.85;
    }
}

fn square(x: f32, y: f32, side: f32, pixels: usize) -> Window {
    Window {
        left: x - side / 2.0,
        top: y + side / 2.0,
        pitch: side / pixels as f32,
        width: pixels,
        height: pixels,
    }
}

impl View {
    fn touches_border(&self) -> bool {
        let (width, height) = (self.window.width, self.window.height);
        (0..self.depth.len()).any(|pixel| {
            let (row, column) = (pixel / width, pixel % width);
            let border = row == 0 || column == 0 || row + 1 == height || column + 1 == width;
            border && self.is_inside(pixel)
        })
    }

    /// Centre and longer side of what is seen.
    fn bounds(&self) -> Option<(f32, f32, f32)> {
        let width = self.window.width;
        let (mut left, mut right, mut top, mut bottom) = (usize::MAX, 0, usize::MAX, 0);
        for pixel in (0..self.depth.len()).filter(|&pixel| self.is_inside(pixel)) {
            let (row, column) = (pixel / width, pixel % width);
            left = left.min(column);
            right = right.max(column);
            top = top.min(row);
            bottom = bottom.max(row);
        }
        if left == usize::MAX {
            return None;
        }
        let x = (self.window.x(left) + self.window.x(right)) / 2.0;
        let y = (self.window.y(top) + self.window.y(bottom)) / 2.0;
        let side = (right - left).max(bottom - top) + 1;
        Some((x, y, side as f32 * self.window.pitch))
    }

    /// Share of another window that this view's object covers, judged from 8x8 places.
    fn cover(&self, window: Window) -> f32 {
        const PLACES: usize = 8;
        let step = window.pitch * window.width as f32 / PLACES as f32;
        let mut covered = 0;
        for row in 0..PLACES {
            for column in 0..PLACES {
                let x = window.left + (column as f32 + 0.5) * step;
                let y = window.top - (row as f32 + 0.5) * step;
                covered += usize::from(self.depth_at(x, y) > f32::NEG_INFINITY);
            }
        }
        covered as f32 / (PLACES * PLACES) as f32
    }
}
