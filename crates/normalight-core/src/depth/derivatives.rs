use super::DepthMap;
use crate::Vec3;

impl DepthMap {
    /// How a quantity changes from pixel to pixel, to the right and upwards: over both neighbours where the
    /// surface goes on to both, over one where it ends or is torn, zero on its own.
    pub(super) fn derivatives(&self, pixel: usize, of: impl Fn(usize) -> Vec3) -> [Vec3; 2] {
        let [left, right, above, below] = self.neighbours(pixel);
        let change = |from: Option<usize>, to: Option<usize>| match (from, to) {
            (Some(from), Some(to)) => (of(to) - of(from)) / 2.0,
            (Some(from), None) => of(pixel) - of(from),
            (None, Some(to)) => of(to) - of(pixel),
            (None, None) => Vec3::ZERO,
        };
        [change(left, right), change(below, above)]
    }

    /// The pixels on the same surface to the left, to the right, above and below.
    fn neighbours(&self, pixel: usize) -> [Option<usize>; 4] {
        let (width, inside) = (self.width(), self.mask().inside());
        let x = pixel % width;
        let right = x + 1 < width && inside[pixel + 1] && !self.breaks_right(pixel);
        let left = x > 0 && inside[pixel - 1] && !self.breaks_right(pixel - 1);
        let below = inside.get(pixel + width) == Some(&true) && !self.breaks_below(pixel);
        let above = pixel >= width && inside[pixel - width] && !self.breaks_below(pixel - width);
        [
            left.then(|| pixel - 1),
            right.then_some(pixel + 1),
            above.then(|| pixel - width),
            below.then_some(pixel + width),
        ]
    }

    /// The unit normal of the surface at every pixel; zero outside the mask, and the line to the camera's
    /// plane where the surface has no extent.
    pub(super) fn surface_normals(&self) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; self.heights().len()];
        for pixel in self.mask().pixels() {
            let [right, up] = self.derivatives(pixel, |pixel| self.position(pixel));
            // A strip that is one pixel wide is taken to lie flat across.
            let right = if right == Vec3::ZERO { Vec3::X } else { right };
            let up = if up == Vec3::ZERO { Vec3::Y } else { up };
            normals[pixel] = right.cross(up).normalize_or(Vec3::Z);
        }
        normals
    }
}
