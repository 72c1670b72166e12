use super::view::{View, Window};
use glam::{Mat3, Vec2, Vec3};
use normalight_core::TriangleMesh;

/// A mesh around the origin, at most one unit from it, with a smooth normal at every vertex.
#[derive(Debug, Clone)]
pub(crate) struct Mesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub(crate) fn new(mesh: &TriangleMesh) -> Self {
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
            normals: mesh.vertex_normals(),
            triangles: mesh.triangles().to_vec(),
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
    pub(crate) fn view(&self, window: Window) -> View {
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
        let mut back = vec![f32::INFINITY; area];
        let mut hits = vec![None; area];
        for (index, triangle) in self.mesh.triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|corner| corners[corner as usize]);
            fill(&window, a, b, c, |pixel, depth, weights| {
                back[pixel] = back[pixel].min(depth);
                if depth > front[pixel] {
                    front[pixel] = depth;
                    let triangle = index as u32;
                    hits[pixel] = Some(Hit { triangle, weights });
                }
            });
        }
        let height = |depth: f32| depth / (1.0 + depth * window.inverse_distance);
        let depth = front.iter().map(|&depth| match depth {
            f32::NEG_INFINITY => depth,
            depth => height(depth),
        });
        let normals = hits.iter().enumerate().map(|(pixel, hit)| match hit {
            Some(hit) => self.normal(hit, &window, window.ray(pixel).to_camera()),
            None => Vec3::ZERO,
        });
        View::from_planes(
            window,
            depth.collect(),
            back.iter().map(|&depth| height(depth)).collect(),
            normals.collect(),
        )
    }

    /// Of the side that is seen.
    fn normal(&self, hit: &Hit, window: &Window, to_camera: Vec3) -> Vec3 {
        let triangle = self.mesh.triangles[hit.triangle as usize].map(|corner| corner as usize);
        let [u, v] = hit.weights;
        // Weights of the picture count for less where a triangle is nearer to the camera.
        let mut smooth = Vec3::ZERO;
        for (corner, weight) in triangle.into_iter().zip([1.0 - u - v, u, v]) {
            let shrink = 1.0 - self.places[corner].z * window.inverse_distance;
            smooth += self.mesh.normals[corner] * (weight / shrink);
        }
        let smooth = self.rotation * smooth;
        let [a, b, c] = triangle.map(|corner| self.places[corner]);
        let flat = (b - a).cross(c - a);
        // The mesh's own orientation tells which side of the smooth normal belongs to the camera.
        let seen = if flat.dot(to_camera) < 0.0 {
            -smooth
        } else {
            smooth
        };
        seen.normalize_or(to_camera)
    }
}

/// Calls `draw` with pixel, depth and weights of the second and third corner for every pixel whose
/// centre lies in a triangle of (column, row, depth).
fn fill(window: &Window, a: Vec3, b: Vec3, c: Vec3, mut draw: impl FnMut(usize, f32, [f32; 2])) {
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
                let depth = a.z + (b.z - a.z) * u + (c.z - a.z) * v;
                draw(row * window.width + column, depth, [u, v]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A torus around the z axis with analytic normals to compare with.
    fn torus(rings: u32, sides: u32) -> TriangleMesh {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for ring in 0..rings {
            for side in 0..sides {
                let u = std::f32::consts::TAU * ring as f32 / rings as f32;
                let v = std::f32::consts::TAU * side as f32 / sides as f32;
                let out = 0.7 + 0.3 * v.cos();
                positions.push(Vec3::new(out * u.cos(), out * u.sin(), 0.3 * v.sin()));
                let place = |r: u32, s: u32| (r % rings) * sides + s % sides;
                let (a, b) = (place(ring, side), place(ring + 1, side));
                let (c, d) = (place(ring + 1, side + 1), place(ring, side + 1));
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        TriangleMesh::new(positions, triangles).unwrap()
    }

    fn window(inverse_distance: f32) -> Window {
        Window::square(0.0, 0.0, 2.2, 80, inverse_distance)
    }

    #[test]
    fn torus_has_analytic_normals_and_depth() {
        for inverse_distance in [0.0, 0.2] {
            let mesh = Mesh::new(&torus(200, 100));
            // Turned, so that the hole is seen aslant.
            let turn = crate::random::about_x(0.5) * crate::random::about_y(0.3);
            let window = window(inverse_distance);
            let view = mesh.posed(turn).view(window);
            let mut seen = 0;
            for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
                let local = turn.transpose() * window.ray(pixel).at(view.depth[pixel]);
                let out = local.truncate().normalize() * 0.7;
                let expected = turn * (local - out.extend(0.0)).normalize();
                let distance = (local - out.extend(0.0)).length() - 0.3;
                assert!(distance.abs() < 2e-3, "{distance}");
                if view.normals[pixel].z > 0.1 {
                    let degrees = view.normals[pixel].angle_between(expected).to_degrees();
                    assert!(degrees < 1.5, "{degrees} degrees");
                    seen += 1;
                }
            }
            assert!(seen > 1500, "{seen} pixels");
        }
    }

    #[test]
    fn the_far_side_lies_behind_the_near_one() {
        let mesh = Mesh::new(&torus(60, 30));
        let view = mesh.posed(Mat3::IDENTITY).view(window(0.0));
        for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
            // Seen along its axis a torus is symmetric to the plane z = 0.
            assert!((view.depth[pixel] + view.back[pixel]).abs() < 0.03);
        }
    }

    #[test]
    fn vertices_that_nothing_uses_change_nothing() {
        let mesh = torus(20, 10);
        let mut positions = mesh.positions().to_vec();
        positions.push(Vec3::new(1e3, 0.0, 0.0));
        let stray = TriangleMesh::new(positions, mesh.triangles().to_vec()).unwrap();
        let [one, two] = [mesh, stray].map(|mesh| {
            let mesh = Mesh::new(&mesh);
            mesh.posed(Mat3::IDENTITY).view(window(0.0)).depth
        });
        assert_eq!(one, two);
    }

    /// Few large triangles, seen from nearby: a sphere whose smooth normals follow its flat faces' places
    /// in space, not in the picture.
    #[test]
    fn normals_run_evenly_over_a_slanted_triangle() {
        let corners = [
            Vec3::new(-0.8, -0.4, -0.5),
            Vec3::new(0.8, -0.4, 0.5),
            Vec3::new(0.0, 0.6, 0.0),
        ];
        let mesh = TriangleMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
        let mut mesh = Mesh::new(&mesh);
        let normals = [
            Vec3::new(-0.5, 0.0, 0.8),
            Vec3::new(0.5, 0.0, 0.8),
            Vec3::new(0.0, 0.5, 0.8),
        ];
        mesh.normals = normals.to_vec();
        let posed = mesh.posed(Mat3::IDENTITY);
        let [a, b, c] = [0, 1, 2].map(|corner| posed.places[corner]);
        let window = window(0.35);
        let view = posed.view(window);
        let mut seen = 0;
        for pixel in (0..80 * 80).filter(|&pixel| view.is_inside(pixel)) {
            // Weights by areas in space.
            let place = window.ray(pixel).at(view.depth[pixel]);
            let whole = (b - a).cross(c - a).length();
            let u = (place - a).cross(c - a).length() / whole;
            let v = (b - a).cross(place - a).length() / whole;
            let expected = normals[0] * (1.0 - u - v) + normals[1] * u + normals[2] * v;
            let degrees = view.normals[pixel]
                .angle_between(expected.normalize())
                .to_degrees();
            assert!(degrees < 0.3, "{degrees} degrees");
            seen += 1;
        }
        assert!(seen > 300, "{seen}");
    }
}
