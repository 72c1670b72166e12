use super::layers::{Layer, far_side};
use super::view::{Detail, View, faced, is_faced};
use super::window::Window;
use glam::{Mat3, Vec2, Vec3};
use normalight_core::{CornerNormals, TriangleMesh};

/// A mesh around the origin, at most one unit from it, with normals that are smooth up to its edges.
#[derive(Debug, Clone)]
pub(crate) struct Mesh {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    normals: CornerNormals,
}

impl Mesh {
    /// Whatever way its triangles go round; where they meet at more than `crease` degrees is an edge.
    pub(crate) fn new(mesh: TriangleMesh, crease: f32) -> Self {
        let mesh = mesh.oriented();
        let (low, high) = mesh.bounds();
        // By their size first, so that no square overflows.
        let size = (high * 0.5 - low * 0.5).max_element();
        let middle = low * 0.5 + high * 0.5;
        let within = |place: Vec3| (place - middle) / size.max(f32::MIN_POSITIVE);
        // Vertices that no triangle uses may lie anywhere; they are never drawn.
        let positions = mesh.positions().iter().map(|&place| {
            let place = within(place);
            if place.abs().max_element() <= 1.001 {
                place
            } else {
                Vec3::ZERO
            }
        });
        let positions: Vec<Vec3> = positions.collect();
        let reach = positions.iter().map(|p| p.length()).fold(0.0f32, f32::max);
        let scale = 1.0 / reach.max(f32::MIN_POSITIVE);
        Self {
            positions: positions.iter().map(|&place| place * scale).collect(),
            triangles: mesh.triangles().to_vec(),
            normals: mesh.corner_normals(crease.to_radians()),
        }
    }

    /// The mesh turned by `rotation`.
    pub(crate) fn posed(&self, rotation: Mat3) -> PosedMesh<'_> {
        PosedMesh {
            mesh: self,
            places: self.positions.iter().map(|&p| rotation * p).collect(),
            rotation,
        }
    }
}

/// A mesh in front of the camera.
pub(crate) struct PosedMesh<'a> {
    mesh: &'a Mesh,
    places: Vec<Vec3>,
    rotation: Mat3,
}

/// What is seen at a pixel: a triangle and the weights of its second and third corner.
#[derive(Clone, Copy)]
struct Hit {
    triangle: u32,
    weights: [f32; 2],
}

impl PosedMesh<'_> {
    pub(crate) fn reach(&self) -> f32 {
        1.0
    }

    /// Half extents to the right and up of a rectangle around the origin that holds everything.
    pub(crate) fn extent(&self) -> Vec2 {
        let places = self.places.iter();
        places.fold(Vec2::ZERO, |extent, place| {
            extent.max(place.truncate().abs())
        })
    }

    /// Draws all triangles into a depth buffer; both their sides are seen.
    pub(crate) fn view(&self, window: Window, detail: Detail) -> View {
        // In the space of parallel rays, columns, rows and depth are linear over a triangle.
        let corners: Vec<Vec3> = self
            .places
            .iter()
            .map(|place| {
                let shrink = 1.0 / (1.0 - place.z * window.inverse_distance);
                Vec3::new(
                    (place.x * shrink - window.left) / window.pitch - 0.5,
                    (window.top - place.y * shrink) / window.pitch - 0.5,
                    place.z * shrink,
                )
            })
            .collect();
        let area = window.width * window.height;
        let mut front = vec![f32::NEG_INFINITY; area];
        let mut hits = vec![None; area];
        let mut layers = Vec::new();
        for (index, triangle) in self.mesh.triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
            fill(&window, a, b, c, |layer, weights| {
                let pixel = layer.pixel as usize;
                if layer.depth > front[pixel] {
                    front[pixel] = layer.depth;
                    let triangle = index as u32;
                    hits[pixel] = Some(Hit { triangle, weights });
                }
                if detail == Detail::All {
                    layers.push(layer);
                }
            });
        }
        let height = |depth: f32| match depth {
            f32::NEG_INFINITY => depth,
            depth => depth / (1.0 + depth * window.inverse_distance),
        };
        let depth = front.iter().map(|&depth| height(depth)).collect();
        if detail == Detail::Depth {
            return View::of_depth(window, depth);
        }
        let back = far_side(layers, area);
        let normals = hits.iter().enumerate().map(|(pixel, hit)| match hit {
            Some(hit) => self.normal(hit, &window, window.ray(pixel).to_camera()),
            None => Vec3::ZERO,
        });
        View::from_planes(
            window,
            depth,
            back.iter().map(|&depth| height(depth)).collect(),
            normals.collect(),
        )
    }

    /// Of the side that is seen. Towards the edge of what is seen, normals between those of the corners may
    /// face away although their triangle does not; they are turned until they just face the camera, as
    /// renderers do.
    fn normal(&self, hit: &Hit, window: &Window, to_camera: Vec3) -> Vec3 {
        let triangle = self.mesh.triangles[hit.triangle as usize].map(|corner| corner as usize);
        let [u, v] = hit.weights;
        // Weights of the picture count for less where a triangle is nearer to the camera.
        let mut smooth = Vec3::ZERO;
        let normals = self.mesh.normals.corners[hit.triangle as usize];
        for (corner, weight) in [1.0 - u - v, u, v].into_iter().enumerate() {
            let shrink = 1.0 - self.places[triangle[corner]].z * window.inverse_distance;
            let normal = self.mesh.normals.normals[normals[corner] as usize];
            smooth += normal * (weight / shrink);
        }
        let smooth = self.rotation * smooth;
        let [a, b, c] = triangle.map(|corner| self.places[corner]);
        let flat = (b - a).cross(c - a);
        // The mesh's own orientation tells which side of the smooth normal belongs to the camera.
        let side = if flat.dot(to_camera) < 0.0 { -1.0 } else { 1.0 };
        let seen = (smooth * side).normalize_or(to_camera);
        if is_faced((flat * side).normalize_or_zero(), to_camera) {
            faced(seen, to_camera)
        } else {
            seen
        }
    }
}

/// Calls `draw` with layer and weights of the second and third corner for every pixel whose centre lies in
/// a triangle of (column, row, depth).
fn fill(window: &Window, a: Vec3, b: Vec3, c: Vec3, mut draw: impl FnMut(Layer, [f32; 2])) {
    let low = a.min(b).min(c);
    let high = a.max(b).max(c);
    if high.x < 0.0 || high.y < 0.0 {
        return;
    }
    let first_column = low.x.ceil().max(0.0) as usize;
    let last_column = (high.x.floor() as usize).min(window.width - 1);
    let last_row = (high.y.floor() as usize).min(window.height - 1);
    let twice_area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if twice_area == 0.0 {
        return;
    }
    let inverse = 1.0 / twice_area;
    for row in low.y.ceil().max(0.0) as usize..=last_row {
        for column in first_column..=last_column {
            let (x, y) = (column as f32 - a.x, row as f32 - a.y);
            let u = (x * (c.y - a.y) - (c.x - a.x) * y) * inverse;
            let v = ((b.x - a.x) * y - x * (b.y - a.y)) * inverse;
            if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
                let layer = Layer {
                    pixel: (row * window.width + column) as u32,
                    depth: a.z + (b.z - a.z) * u + (c.z - a.z) * v,
                    facing: twice_area < 0.0,
                };
                draw(layer, [u, v]);
            }
        }
    }
}

#[cfg(test)]
mod tests;
