use super::ray::Ray;

/// A rectangle of the plane z = 0 seen by a camera on the z axis; rows go down.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window {
    pub(crate) left: f32,
    pub(crate) top: f32,
    /// Side of a pixel in units of the object, at z = 0.
    pub(crate) pitch: f32,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// One over the camera's height over z = 0; zero for an orthographic camera.
    pub(crate) inverse_distance: f32,
}

impl Window {
    /// A square of the given side around (x, y).
    pub(crate) fn square(x: f32, y: f32, side: f32, pixels: usize, inverse_distance: f32) -> Self {
        Self {
            left: x - side / 2.0,
            top: y + side / 2.0,
            pitch: side / pixels as f32,
            width: pixels,
            height: pixels,
            inverse_distance,
        }
    }

    /// x of the centre of a column.
    pub(crate) fn x(&self, column: usize) -> f32 {
        self.left + (column as f32 + 0.5) * self.pitch
    }

    /// y of the centre of a row.
    pub(crate) fn y(&self, row: usize) -> f32 {
        self.top - (row as f32 + 0.5) * self.pitch
    }

    /// What a pixel looks along.
    pub(crate) fn ray(&self, pixel: usize) -> Ray {
        self.ray_through(self.x(pixel % self.width), self.y(pixel / self.width))
    }

    pub(crate) fn ray_through(&self, x: f32, y: f32) -> Ray {
        Ray::new(x, y, self.inverse_distance)
    }

    /// Depth in the space where the camera's rays are parallel: straight lines stay straight.
    #[inline]
    pub(crate) fn parallel_depth(&self, z: f32) -> f32 {
        z / (1.0 - z * self.inverse_distance)
    }
}
