use crate::noise::Lattice;
use crate::ray::{follow, tile_start};
use crate::shape::Shape;
use glam::Vec3;

/// Rays of one tile share their start; pixels a side.
const TILE: usize = 8;
/// Flatter views of the surface than this cosine are left out of the mask: they are seen edge-on,
/// where one pixel holds both object and background.
const MIN_NORMAL_Z: f32 = 0.02;

/// A rectangle of the plane x, y seen by an orthographic camera; rows go down.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window {
    pub(crate) left: f32,
    pub(crate) top: f32,
    /// Side of a pixel in units of the object.
    pub(crate) pitch: f32,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Window {
    /// x of the centre of a column.
    pub(crate) fn x(&self, column: usize) -> f32 {
        self.left + (column as f32 + 0.5) * self.pitch
    }

    /// y of the centre of a row.
    pub(crate) fn y(&self, row: usize) -> f32 {
        self.top - (row as f32 + 0.5) * self.pitch
    }
}

/// What the camera sees of a shape.
#[derive(Debug, Clone)]
pub(crate) struct View {
    pub(crate) window: Window,
    /// z of the surface, negative infinity where nothing is.
    ///
    /// `[height, width]`
    pub(crate) depth: Vec<f32>,
    /// Unit normals, zero where nothing is or when only the depth was asked for.
    ///
    /// `[height, width]`
    pub(crate) normals: Vec<Vec3>,
}

/// What to find out about every pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Detail {
    Depth,
    DepthAndNormals,
}

impl View {
    /// Follows one ray a pixel down to the surface.
    pub(crate) fn trace(shape: &Shape, window: Window, detail: Detail) -> Self {
        let lattice = Lattice::shared();
        let mut view = Self {
            window,
            depth: vec![f32::NEG_INFINITY; window.width * window.height],
            normals: vec![Vec3::ZERO; window.width * window.height],
        };
        for row in (0..window.height).step_by(TILE) {
            for column in (0..window.width).step_by(TILE) {
                view.trace_tile(shape, lattice, row, column);
            }
        }
        view.close_pinholes();
        if detail == Detail::DepthAndNormals {
            view.find_normals(shape);
        }
        view
    }

    pub(crate) fn is_inside(&self, pixel: usize) -> bool {
        self.depth[pixel] > f32::NEG_INFINITY
    }

    /// z of the surface at the nearest pixel; negative infinity outside the object or the window.
    #[inline]
    pub(crate) fn depth_at(&self, x: f32, y: f32) -> f32 {
        let column = (x - self.window.left) / self.window.pitch;
        let row = (self.window.top - y) / self.window.pitch;
        let inside = column >= 0.0
            && row >= 0.0
            && column < self.window.width as f32
            && row < self.window.height as f32;
        if !inside {
            return f32::NEG_INFINITY;
        }
        self.depth[row as usize * self.window.width + column as usize]
    }

    fn trace_tile(&mut self, shape: &Shape, lattice: &Lattice, row: usize, column: usize) {
        let window = self.window;
        let rows = row..(row + TILE).min(window.height);
        let columns = column..(column + TILE).min(window.width);
        let half = TILE as f32 / 2.0 * window.pitch;
        let radius = half * std::f32::consts::SQRT_2;
        let centre_x = window.left + column as f32 * window.pitch + half;
        let centre_y = window.top - row as f32 * window.pitch - half;
        let active = shape.active(centre_x, centre_y, radius);
        if active.is_empty() {
            return;
        }
        let Some(start) = tile_start(shape, lattice, active, centre_x, centre_y, radius) else {
            return;
        };
        for row in rows {
            let y = window.y(row);
            for column in columns.clone() {
                let ray = Vec3::new(window.x(column), y, start);
                let Some(hit) = follow(shape, lattice, active, ray, window.pitch) else {
                    continue;
                };
                self.depth[row * window.width + column] = hit;
            }
        }
    }

    /// Lays single pixels onto their neighbours where a ray got stuck in a crease.
    fn close_pinholes(&mut self) {
        let (width, height) = (self.window.width, self.window.height);
        for row in 1..height.max(2) - 1 {
            for column in 1..width.max(2) - 1 {
                let pixel = row * width + column;
                if !self.is_inside(pixel) && self.is_surrounded(row, column) {
                    let across = self.depth[pixel - 1] + self.depth[pixel + 1];
                    let along = self.depth[pixel - width] + self.depth[pixel + width];
                    self.depth[pixel] = (across + along) / 4.0;
                }
            }
        }
    }

    /// Finds the normals from the gradient of the shape. Pixels seen edge-on leave the view, unless they are
    /// within the object, where a hole in the mask would be unlike any real mask.
    pub(crate) fn find_normals(&mut self, shape: &Shape) {
        let lattice = Lattice::shared();
        let (window, width) = (self.window, self.window.width);
        let spread = 0.1 * window.pitch;
        let mut edge_on = Vec::new();
        for row in 0..window.height {
            for column in 0..width {
                let pixel = row * width + column;
                if !self.is_inside(pixel) {
                    continue;
                }
                let (x, y) = (window.x(column), window.y(row));
                let active = shape.active(x, y, 2.0 * spread);
                let hit = Vec3::new(x, y, self.depth[pixel]);
                let mut normal = shape.normal(lattice, hit, active, spread);
                if normal.z < MIN_NORMAL_Z {
                    if !self.is_surrounded(row, column) {
                        edge_on.push(pixel);
                        continue;
                    }
                    normal.z = MIN_NORMAL_Z;
                    normal = normal.normalize();
                }
                self.normals[pixel] = normal;
            }
        }
        // Only now, or each would expose the next.
        for pixel in edge_on {
            self.depth[pixel] = f32::NEG_INFINITY;
        }
    }

    fn is_surrounded(&self, row: usize, column: usize) -> bool {
        let (width, height) = (self.window.width, self.window.height);
        let pixel = row * width + column;
        (column == 0 || self.is_inside(pixel - 1))
            && (column + 1 == width || self.is_inside(pixel + 1))
            && (row == 0 || self.is_inside(pixel - width))
            && (row + 1 == height || self.is_inside(pixel + width))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::part::Part;
    use crate::relief::Relief;
    use glam::Mat3;

    #[test]
    fn sphere_has_analytic_normals_and_mask() {
        let radius = 0.8;
        let parts = vec![Part::sphere(Vec3::ZERO, radius)];
        let shape = Shape::new(None, parts, 0.0, Relief::default(), Mat3::IDENTITY);
        let window = Window {
            left: -1.0,
            top: 1.0,
            pitch: 2.0 / 50.0,
            width: 50,
            height: 50,
        };
        let view = View::trace(&shape, window, Detail::DepthAndNormals);
        for row in 0..50 {
            for column in 0..50 {
                // Written out apart from the window: x right, y up, rows from the top.
                let x = -1.0 + (column as f32 + 0.5) * 0.04;
                let y = 1.0 - (row as f32 + 0.5) * 0.04;
                let height_squared = radius * radius - x * x - y * y;
                let normal = view.normals[row * 50 + column];
                if height_squared < -0.01 {
                    assert_eq!(normal, Vec3::ZERO);
                } else if height_squared > 0.01 {
                    let expected = Vec3::new(x, y, height_squared.sqrt()) / radius;
                    let degrees = normal.angle_between(expected).to_degrees();
                    assert!(degrees < 0.5, "{row} {column}: {degrees} degrees");
                    let depth = view.depth[row * 50 + column];
                    assert!((depth - height_squared.sqrt()).abs() < 0.01);
                }
            }
        }
    }
}
