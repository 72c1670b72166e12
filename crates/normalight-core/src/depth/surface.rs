use super::DepthMap;
use crate::{CoreError, MAX_TRIANGLES, NormalMap, Vec3};

/// A depth map as triangles, which go round counter-clockwise when seen from the camera.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthMesh {
    /// Width and height of the map in pixels.
    pub size: [usize; 2],
    /// The vertices: x right, y up, z to the camera, in pixels from the middle of the map.
    pub positions: Vec<Vec3>,
    /// A unit normal for each vertex.
    pub normals: Vec<Vec3>,
    /// The pixel of each vertex, rows from the top.
    pub pixels: Vec<u32>,
    /// Three vertices each.
    pub triangles: Vec<[u32; 3]>,
}

impl DepthMesh {
    /// Where a vertex lies in images of the map's size: right and down, 0..1.
    pub fn texture_place(&self, vertex: usize) -> [f32; 2] {
        let [width, height] = self.size;
        let pixel = self.pixels[vertex] as usize;
        [
            ((pixel % width) as f32 + 0.5) / width as f32,
            ((pixel / width) as f32 + 0.5) / height as f32,
        ]
    }
}

impl DepthMap {
    /// Triangles between pixels of the mask, of which every `step`-th (from 1) in both directions becomes a
    /// vertex; with a step of 1 each pixel is one. No triangle spans a place outside the mask or where the
    /// surface is torn. Squares are cut along the shorter diagonal. Vertices without a normal face the camera.
    ///
    /// # Errors
    /// [`CoreError::MapSize`]; [`CoreError::NoTriangles`]; [`CoreError::TooManyTriangles`], see
    /// [`Self::step_for`].
    pub fn mesh(&self, normals: &NormalMap, step: usize) -> Result<DepthMesh, CoreError> {
        let (width, height) = (self.width(), self.height());
        if (normals.width(), normals.height()) != (width, height) {
            return Err(CoreError::MapSize {
                found_width: normals.width(),
                found_height: normals.height(),
                expected_width: width,
                expected_height: height,
            });
        }
        let step = step.max(1);
        let mut builder = Builder {
            depth: self,
            normals,
            numbers: vec![u32::MAX; width * height],
            mesh: DepthMesh {
                size: [width, height],
                positions: Vec::new(),
                normals: Vec::new(),
                pixels: Vec::new(),
                triangles: Vec::new(),
            },
        };
        for y in (0..height.saturating_sub(step)).step_by(step) {
            for x in (0..width.saturating_sub(step)).step_by(step) {
                builder.square(y * width + x, step);
                let found = builder.mesh.triangles.len();
                if found > MAX_TRIANGLES {
                    return Err(CoreError::TooManyTriangles {
                        found,
                        allowed: MAX_TRIANGLES,
                    });
                }
            }
        }
        if builder.mesh.triangles.is_empty() {
            return Err(CoreError::NoTriangles);
        }
        Ok(builder.mesh)
    }

    /// The smallest step with which a mesh has at most about this many triangles, and surely no more than
    /// [`MAX_TRIANGLES`].
    pub fn step_for(&self, triangles: usize) -> usize {
        let most = triangles.clamp(2, MAX_TRIANGLES) as f64;
        // Two for each pixel of the mask; what the border takes away is to spare.
        let ratio = 2.0 * self.mask().count() as f64 / most;
        ratio.sqrt().ceil().max(1.0) as usize
    }

    /// Whether one can go from a pixel to the one `step` to the right or below without leaving the surface.
    fn joined(&self, pixel: usize, step: usize, down: bool) -> bool {
        let stride = if down { self.width() } else { 1 };
        let inside = self.mask().inside();
        (0..step).map(|k| pixel + k * stride).all(|at| {
            let torn = match down {
                true => self.breaks_below(at),
                false => self.breaks_right(at),
            };
            inside[at] && inside[at + stride] && !torn
        })
    }
}

struct Builder<'a> {
    depth: &'a DepthMap,
    normals: &'a NormalMap,
    /// The vertex of each pixel.
    numbers: Vec<u32>,
    mesh: DepthMesh,
}

impl Builder<'_> {
    /// Up to two triangles between a pixel and those `step` to the right and below.
    fn square(&mut self, pixel: usize, step: usize) {
        let depth = self.depth;
        let below = pixel + step * depth.width();
        let [a, b, c, d] = [pixel, pixel + step, below, below + step];
        let top = depth.joined(a, step, false);
        let bottom = depth.joined(c, step, false);
        let left = depth.joined(a, step, true);
        let right = depth.joined(b, step, true);
        let falling = [(left && bottom, [a, c, d]), (top && right, [a, d, b])];
        let rising = [(left && top, [a, c, b]), (bottom && right, [b, c, d])];
        let count = |cut: &[(bool, [usize; 3])]| cut.iter().filter(|(whole, _)| *whole).count();
        let length = |one, other| depth.position(one).distance_squared(depth.position(other));
        let cut = match count(&falling).cmp(&count(&rising)) {
            std::cmp::Ordering::Greater => falling,
            std::cmp::Ordering::Less => rising,
            std::cmp::Ordering::Equal if length(a, d) <= length(b, c) => falling,
            std::cmp::Ordering::Equal => rising,
        };
        for (_, corners) in cut.into_iter().filter(|(whole, _)| *whole) {
            let triangle = corners.map(|corner| self.vertex(corner));
            self.mesh.triangles.push(triangle);
        }
    }

    fn vertex(&mut self, pixel: usize) -> u32 {
        let number = &mut self.numbers[pixel];
        if *number == u32::MAX {
            *number = self.mesh.positions.len() as u32;
            self.mesh.positions.push(self.depth.position(pixel));
            let normal = self.normals.normals()[pixel];
            self.mesh.normals.push(match normal {
                Vec3::ZERO => Vec3::Z,
                normal => normal,
            });
            self.mesh.pixels.push(pixel as u32);
        }
        *number
    }
}
