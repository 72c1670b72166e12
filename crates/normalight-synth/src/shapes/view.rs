use super::ray::{DistanceField, back_of, follow, tile_start};
use super::shape::Shape;
use super::window::Window;
use crate::noise::Lattice;
use glam::Vec3;

/// Side in pixels of a tile, whose rays share their start.
const TILE: usize = 8;
/// Flatter views of the surface than this cosine are left out of the mask: they are seen edge-on,
/// where one pixel holds both object and background.
const MIN_NORMAL_Z: f32 = 0.02;

/// What the camera sees of a shape.
#[derive(Debug, Clone)]
pub(crate) struct View {
    pub(crate) window: Window,
    /// z of the surface, negative infinity where nothing is.
    ///
    /// `[height, width]`
    pub(crate) depth: Vec<f32>,
    /// z of the object's far side, never above `depth`, the same for an open sheet; meaningless where
    /// nothing is or when only the depth was asked for.
    ///
    /// `[height, width]`
    pub(crate) back: Vec<f32>,
    /// Unit normals, zero where nothing is, meaningless when only the depth was asked for.
    ///
    /// `[height, width]`
    pub(crate) normals: Vec<Vec3>,
}

/// What to find out about every pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Detail {
    Depth,
    /// Normals and the far side too.
    All,
}

/// Side in pixels of a block that shares one ray to the far side: shadows need it only roughly.
const BACK_BLOCK: usize = 2;

impl View {
    /// Follows one ray per pixel down to the surface.
    pub(crate) fn trace(shape: &Shape, window: Window, detail: Detail) -> Self {
        let lattice = Lattice::shared();
        let mut view = Self {
            window,
            depth: vec![f32::NEG_INFINITY; window.width * window.height],
            back: vec![f32::NEG_INFINITY; window.width * window.height],
            normals: vec![Vec3::ZERO; window.width * window.height],
        };
        for row in (0..window.height).step_by(TILE) {
            for column in (0..window.width).step_by(TILE) {
                view.trace_tile(shape, lattice, row, column);
            }
        }
        view.close_pinholes();
        if detail == Detail::All {
            view.find_normals(shape);
            view.find_back(shape);
        }
        view
    }

    pub(crate) fn is_inside(&self, pixel: usize) -> bool {
        self.depth[pixel] > f32::NEG_INFINITY
    }

    fn trace_tile(&mut self, shape: &Shape, lattice: &Lattice, row: usize, column: usize) {
        let window = self.window;
        let rows = row..(row + TILE).min(window.height);
        let columns = column..(column + TILE).min(window.width);
        let half = TILE as f32 / 2.0 * window.pitch;
        let centre_x = window.left + column as f32 * window.pitch + half;
        let centre_y = window.top - row as f32 * window.pitch - half;
        // Rays of a camera nearby spread, and lean over other columns of space.
        let spread = shape.reach() * window.inverse_distance;
        let radius = half * std::f32::consts::SQRT_2 * (1.0 + spread);
        let leaning = spread * (centre_x * centre_x + centre_y * centre_y).sqrt();
        let active = shape.active(centre_x, centre_y, radius + leaning);
        if active.is_empty() {
            return;
        }
        let middle = window.ray_through(centre_x, centre_y);
        let field = DistanceField {
            shape,
            lattice,
            active,
        };
        let Some(start) = tile_start(&field, middle, radius) else {
            return;
        };
        for row in rows {
            for column in columns.clone() {
                let pixel = row * window.width + column;
                let ray = window.ray(pixel);
                if let Some(hit) = follow(&field, ray, start, window.pitch) {
                    self.depth[pixel] = hit;
                }
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

    /// Finds the normals from the gradient of the shape.
    pub(crate) fn find_normals(&mut self, shape: &Shape) {
        let lattice = Lattice::shared();
        let spread = 0.1 * self.window.pitch;
        for pixel in 0..self.depth.len() {
            if !self.is_inside(pixel) {
                continue;
            }
            let hit = self.window.ray(pixel).at(self.depth[pixel]);
            let active = shape.active(hit.x, hit.y, 2.0 * spread);
            self.normals[pixel] = shape.normal(lattice, hit, active, spread);
        }
        self.leave_edges();
    }

    /// From the depth alone.
    pub(crate) fn of_depth(window: Window, depth: Vec<f32>) -> Self {
        Self {
            window,
            back: Vec::new(),
            normals: Vec::new(),
            depth,
        }
    }

    /// From depth, far side and normals of the surface as it is.
    pub(crate) fn from_planes(
        window: Window,
        depth: Vec<f32>,
        back: Vec<f32>,
        normals: Vec<Vec3>,
    ) -> Self {
        let mut view = Self {
            window,
            depth,
            back,
            normals,
        };
        view.leave_edges();
        view
    }

    /// Pixels seen edge-on leave the view, unless they are within the object, where a hole in the mask
    /// would be unlike any real mask.
    fn leave_edges(&mut self) {
        let width = self.window.width;
        let mut leaving = Vec::new();
        for pixel in 0..self.depth.len() {
            if !self.is_inside(pixel) {
                continue;
            }
            let (normal, to_camera) = (self.normals[pixel], self.window.ray(pixel).to_camera());
            if is_faced(normal, to_camera) {
                continue;
            }
            if self.is_surrounded(pixel / width, pixel % width) {
                self.normals[pixel] = faced(normal, to_camera);
            } else {
                leaving.push(pixel);
            }
        }
        // Only now, or each would expose the next.
        for pixel in leaving {
            self.depth[pixel] = f32::NEG_INFINITY;
            self.normals[pixel] = Vec3::ZERO;
        }
    }

    /// Finds the far side by rays from behind, one for a block of pixels.
    fn find_back(&mut self, shape: &Shape) {
        let lattice = Lattice::shared();
        let (width, height) = (self.window.width, self.window.height);
        for row in (0..height).step_by(BACK_BLOCK) {
            for column in (0..width).step_by(BACK_BLOCK) {
                let block: Vec<usize> = (row..(row + BACK_BLOCK).min(height))
                    .flat_map(|row| {
                        (column..(column + BACK_BLOCK).min(width)).map(move |c| row * width + c)
                    })
                    .filter(|&pixel| self.is_inside(pixel))
                    .collect();
                let Some(&pixel) = block.first() else {
                    continue;
                };
                let ray = self.window.ray(pixel);
                let back = back_of(shape, lattice, ray, self.depth[pixel], self.window.pitch);
                for pixel in block {
                    self.back[pixel] = back.min(self.depth[pixel]);
                }
            }
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

/// Whether the camera sees a surface of this unit normal other than edge-on.
pub(crate) fn is_faced(normal: Vec3, to_camera: Vec3) -> bool {
    normal.z.min(normal.dot(to_camera)) >= MIN_NORMAL_Z
}

/// The unit normal itself if the camera sees such a surface, else one near by that it just sees.
pub(crate) fn faced(normal: Vec3, to_camera: Vec3) -> Vec3 {
    if is_faced(normal, to_camera) {
        return normal;
    }
    // Twice as much, of which making it a unit vector takes a little.
    let least = 2.0 * MIN_NORMAL_Z;
    let mut seen = normal + to_camera * (least - normal.dot(to_camera)).max(0.0);
    seen.z = seen.z.max(least);
    seen.normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::part::Part;
    use crate::shapes::relief::Relief;
    use crate::shapes::shape::Body;
    use glam::Mat3;

    #[test]
    fn sphere_has_analytic_normals_and_mask() {
        let radius = 0.8;
        let parts = vec![Part::sphere(Vec3::ZERO, radius)];
        let shape = Shape::new(Body::None, parts, 0.0, Relief::default(), Mat3::IDENTITY);
        let window = Window {
            left: -1.0,
            top: 1.0,
            pitch: 2.0 / 50.0,
            width: 50,
            height: 50,
            inverse_distance: 0.0,
        };
        let view = View::trace(&shape, window, Detail::All);
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
