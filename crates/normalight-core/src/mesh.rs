mod normals;
mod sides;
mod winding;

pub use normals::CornerNormals;

use crate::CoreError;
use glam::{DVec3, Vec3};

/// Most triangles of one mesh: far above any scan that is of use here, and it bounds the memory.
pub const MAX_TRIANGLES: usize = 4_000_000;

/// Sine of an angle below which two edges point the same way, given the rounding of `f32`.
const FLAT: f64 = 1e-7;

/// A surface of triangles, which go round counter-clockwise when seen from outside.
///
/// Every index has its position, every position is finite and every triangle has an area.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Checks a mesh and takes it; triangles without area among others are dropped.
    ///
    /// # Errors
    /// No triangles at all, or more than [`MAX_TRIANGLES`]; a position that is not finite; an
    /// index without a position; no triangle with an area.
    pub fn new(positions: Vec<Vec3>, mut triangles: Vec<[u32; 3]>) -> Result<Self, CoreError> {
        let found = triangles.len();
        if found == 0 {
            return Err(CoreError::NoTriangles);
        }
        if found > MAX_TRIANGLES {
            return Err(CoreError::TooManyTriangles {
                found,
                allowed: MAX_TRIANGLES,
            });
        }
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(CoreError::MeshPosition {
                vertex,
                value: positions[vertex],
            });
        }
        let vertices = positions.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&index| index as usize >= vertices) {
                return Err(CoreError::MeshIndex {
                    triangle,
                    index,
                    vertices,
                });
            }
        }
        triangles.retain(|&corners| has_area(corners.map(|index| positions[index as usize])));
        if triangles.is_empty() {
            return Err(CoreError::FlatMesh { triangles: found });
        }
        Ok(Self {
            positions,
            triangles,
        })
    }

    /// The vertices, also those that no triangle uses.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Three positions of each triangle, counter-clockwise when seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Lowest and highest coordinates of all triangles.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let corners = self.triangles.iter().flatten();
        let corners = corners.map(|&index| self.positions[index as usize]);
        corners.fold((Vec3::MAX, Vec3::MIN), |(low, high), corner| {
            (low.min(corner), high.max(corner))
        })
    }

    /// Where the corners of a triangle are.
    fn corners_in_space(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize].as_dvec3())
    }

    /// For each vertex, one that stands for all vertices at its place: scans repeat vertices along the
    /// seams of their texture.
    fn places(&self) -> Vec<u32> {
        // Adding zero makes minus zero plain zero.
        let key = |vertex: u32| {
            let position = self.positions[vertex as usize] + Vec3::ZERO;
            position.to_array().map(f32::to_bits)
        };
        let mut order: Vec<u32> = (0..self.positions.len() as u32).collect();
        order.sort_unstable_by_key(|&vertex| (key(vertex), vertex));
        let mut places = vec![0; order.len()];
        for group in order.chunk_by(|&one, &other| key(one) == key(other)) {
            for &vertex in group {
                places[vertex as usize] = group[0];
            }
        }
        places
    }
}

/// Normal times twice the area of the triangle with these corners. Double precision: squares of large
/// coordinates would overflow otherwise.
fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

fn has_area(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let edges = (b - a).length() * (c - a).length();
    area_vector([a, b, c]).length() > FLAT * edges
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Vec<Vec3> {
        vec![Vec3::ZERO, Vec3::X, Vec3::Y]
    }

    #[test]
    fn faults_are_named() {
        let new = TriangleMesh::new;
        assert_eq!(new(triangle(), vec![]), Err(CoreError::NoTriangles));
        let error = new(triangle(), vec![[0, 1, 2], [0, 1, 3]]).unwrap_err();
        let expected = CoreError::MeshIndex {
            triangle: 1,
            index: 3,
            vertices: 3,
        };
        assert_eq!(error, expected);
        for bad in [f32::NAN, f32::INFINITY] {
            let mut positions = triangle();
            positions[1].y = bad;
            let error = new(positions, vec![[0, 1, 2]]).unwrap_err();
            assert!(matches!(error, CoreError::MeshPosition { vertex: 1, .. }));
        }
        let line = [1.0, 2.0, 4.0].map(|k| Vec3::new(0.1, 0.2, 0.7) * k);
        let error = new(line.to_vec(), vec![[0, 1, 2], [1, 1, 2]]).unwrap_err();
        assert_eq!(error, CoreError::FlatMesh { triangles: 2 });
        let many = vec![[0, 1, 2]; MAX_TRIANGLES + 1];
        let error = new(triangle(), many).unwrap_err();
        assert!(matches!(error, CoreError::TooManyTriangles { .. }));
    }

    #[test]
    fn triangles_without_area_are_dropped() {
        let mesh = TriangleMesh::new(triangle(), vec![[0, 0, 1], [0, 1, 2], [2, 1, 2]]).unwrap();
        assert_eq!(mesh.triangles(), [[0, 1, 2]]);
        // Neither tiny nor huge triangles are flat.
        for scale in [1e-30, 1e38] {
            let positions = triangle().into_iter().map(|p| p * scale).collect();
            let mesh = TriangleMesh::new(positions, vec![[0, 1, 2]]).unwrap();
            assert_eq!(mesh.corner_normals(0.0).normals, [Vec3::Z; 3]);
        }
    }

    #[test]
    fn bounds_ignore_loose_vertices() {
        let mut positions = triangle();
        positions.push(Vec3::splat(9.0));
        let mesh = TriangleMesh::new(positions, vec![[0, 1, 2]]).unwrap();
        assert_eq!(mesh.bounds(), (Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0)));
    }
}
