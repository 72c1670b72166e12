use super::lamp::Lamp;
use crate::lanes::{LANES, Lanes, lanes, vectorised};
use crate::shapes::{View, Window};
use glam::{Vec2, Vec3};

/// Side in pixels of a tile that is walked over together; as wide as the lanes.
const TILE: usize = LANES;
/// Pixels around the picture where nothing is.
const BORDER: usize = TILE;
/// Steps of one pixel before they grow: near obstacles need precision.
const FINE_STEPS: f32 = 24.0;
const COARSE_STEP: f32 = 1.5;
/// Below this depth nothing is.
const NOTHING: f32 = -1e6;
/// Slope up to which a surface may fall off within the pixel that stands for it.
const STEEPEST: f32 = 6.0;

/// Cast shadows from the depth map of an object's near and far side. No ray slips through what is thinner
/// than its rise with a step: open sheets cast shadows too.
///
/// For near lamps all pixels of a tile take the direction from the tile's middle: good within a few degrees
/// from pictures of 100 pixels on, rough in smaller ones.
///
/// Works in the space where the camera's rays are parallel: there a lamp's rays run over the picture in
/// straight lines, and all pixels of a tile walk the same way.
pub(crate) struct Shadows {
    window: Window,
    /// Depth of the near and of the far side with a border around, rows from the top.
    near: Vec<f32>,
    far: Vec<f32>,
    /// Height at which each pixel's walk starts: above its own surface by as much as the surface may
    /// rise within a pixel.
    start: Vec<f32>,
    stride: usize,
    top: f32,
    tiles: Vec<Tile>,
}

/// A square of pixels with something of the object in it.
struct Tile {
    row: usize,
    column: usize,
    /// A point of the object in its middle, and where that is in the space of parallel rays.
    place: Vec3,
    parallel: Vec3,
    lowest: f32,
}

impl Shadows {
    pub(crate) fn new(view: &View) -> Self {
        let window = view.window;
        let rows = window.height.next_multiple_of(TILE) + 2 * BORDER;
        let stride = window.width.next_multiple_of(TILE) + 2 * BORDER;
        let mut near = vec![NOTHING; rows * stride];
        let mut far = vec![NOTHING; rows * stride];
        let mut start = vec![NOTHING; rows * stride];
        let mut top = NOTHING;
        for pixel in (0..view.depth.len()).filter(|&pixel| view.is_inside(pixel)) {
            let (row, column) = (pixel / window.width, pixel % window.width);
            let place = (row + BORDER) * stride + column + BORDER;
            let depth = window.parallel_depth(view.depth[pixel]);
            near[place] = depth;
            far[place] = window.parallel_depth(view.back[pixel]);
            let normal = view.normals[pixel];
            let slope = (normal.truncate().length() / normal.z.max(1e-3)).min(STEEPEST);
            start[place] = depth + (0.25 + 0.75 * slope) * window.pitch;
            top = top.max(depth);
        }
        let mut shadows = Self {
            window,
            near,
            far,
            start,
            stride,
            top,
            tiles: Vec::new(),
        };
        for row in (0..window.height).step_by(TILE) {
            for column in (0..window.width).step_by(TILE) {
                shadows.tiles.extend(shadows.tile(view, row, column));
            }
        }
        shadows
    }

    fn tile(&self, view: &View, row: usize, column: usize) -> Option<Tile> {
        let window = self.window;
        let (mut depth, mut count, mut lowest) = (0.0, 0.0f32, f32::INFINITY);
        for row in row..(row + TILE).min(window.height) {
            for column in column..(column + TILE).min(window.width) {
                let pixel = row * window.width + column;
                if view.is_inside(pixel) {
                    depth += view.depth[pixel];
                    count += 1.0;
                    lowest = lowest.min(self.start[self.index(row, column)]);
                }
            }
        }
        (count > 0.0).then(|| {
            let depth = depth / count;
            let x = window.left + (column + TILE / 2) as f32 * window.pitch;
            let y = window.top - (row + TILE / 2) as f32 * window.pitch;
            Tile {
                row,
                column,
                place: window.ray_through(x, y).at(depth),
                parallel: Vec3::new(x, y, window.parallel_depth(depth)),
                lowest,
            }
        })
    }

    fn index(&self, row: usize, column: usize) -> usize {
        (row + BORDER) * self.stride + column + BORDER
    }

    /// Share of the lamp that every pixel sees: 0 in shadow, 1 lit, between at the border.
    ///
    /// `[height, width]`; 1 outside the object
    pub(crate) fn lit(&self, lamp: &Lamp) -> Vec<f32> {
        let mut lit = vec![1.0; self.window.width * self.window.height];
        vectorised(
            #[inline(always)]
            || {
                for tile in &self.tiles {
                    self.walk(tile, lamp, &mut lit);
                }
            },
        );
        lit
    }

    /// The way from a tile to the lamp: right and up in the picture, and the rise with each unit.
    fn way(&self, tile: &Tile, lamp: &Lamp) -> Option<(Vec2, f32)> {
        let direction = lamp.direction_from(tile.place);
        // Derivative of the map to parallel rays along the direction, up to a factor.
        let way = direction + tile.parallel * (self.window.inverse_distance * direction.z);
        let flat = way.truncate().length();
        (flat > 1e-3).then(|| (way.truncate() / flat, way.z / flat))
    }

    #[inline(always)]
    fn walk(&self, tile: &Tile, lamp: &Lamp, lit: &mut [f32]) {
        let Some((way, rise)) = self.way(tile, lamp) else {
            return;
        };
        let pitch = self.window.pitch;
        let inverse_pitch = 1.0 / pitch;
        let mut seen = [[1.0f32; LANES]; TILE];
        let mut step = 1.0f32;
        let first = self.index(tile.row, tile.column) as isize;
        loop {
            let height = rise * step * pitch;
            if tile.lowest + height > self.top + pitch {
                break;
            }
            let right = round(way.x * step);
            let down = round(-way.y * step);
            let (row, column) = (tile.row as isize + down, tile.column as isize + right);
            let outside = row <= -(TILE as isize)
                || column <= -(TILE as isize)
                || row >= self.window.height as isize
                || column >= self.window.width as isize;
            if outside {
                break;
            }
            let there = (first + down * self.stride as isize + right) as usize;
            // The rounding of the way changes the height too.
            let walked = (right as f32 * way.x - down as f32 * way.y).max(0.5);
            let height = rise * walked * pitch;
            let size = if step < FINE_STEPS { 1.0 } else { COARSE_STEP };
            // Below the far side by less, the ray comes out above it, or half in it, with the next step.
            let ahead = Step {
                height,
                under: (0.5 + rise.max(0.0) * size) * pitch,
                inverse_pitch,
            };
            for (row, seen) in seen.iter_mut().enumerate() {
                let start = lanes(&self.start, first as usize + row * self.stride);
                let near = lanes(&self.near, there + row * self.stride);
                let far = lanes(&self.far, there + row * self.stride);
                pass(seen, start, near, far, &ahead);
            }
            step += size;
        }
        let width = self.window.width.min(tile.column + TILE) - tile.column;
        for (row, seen) in seen.iter().enumerate() {
            let row = tile.row + row;
            if row < self.window.height {
                let place = row * self.window.width + tile.column;
                lit[place..place + width].copy_from_slice(&seen[..width]);
            }
        }
    }
}

/// A step of the walks, the same for all of a tile.
struct Step {
    /// How far the rays have risen.
    height: f32,
    /// How far below the far side of an obstacle a ray passes under it.
    under: f32,
    /// One over the side of a pixel.
    inverse_pitch: f32,
}

/// One step of sixteen walks.
#[inline(always)]
fn pass(seen: &mut Lanes, start: &Lanes, near: &Lanes, far: &Lanes, step: &Step) {
    for lane in 0..LANES {
        let z = start[lane] + step.height;
        // A pixel of half shadow.
        let clear = 0.5 + (z - near[lane]) * step.inverse_pitch;
        // Behind the far side the ray passes under the obstacle.
        let clear = if z + step.under < far[lane] {
            1.0
        } else {
            clear
        };
        let clear = if clear > 0.0 { clear } else { 0.0 };
        seen[lane] = if clear < seen[lane] {
            clear
        } else {
            seen[lane]
        };
    }
}

fn round(value: f32) -> isize {
    (value + if value < 0.0 { -0.5 } else { 0.5 }) as isize
}

#[cfg(test)]
mod tests;
