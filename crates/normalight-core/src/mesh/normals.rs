use super::{TriangleMesh, area_vector};
use glam::{DVec3, Vec3};

/// Triangles on one side that are compared with each other; more are cut apart.
const MOST_ON_A_SIDE: usize = 8;

/// Unit normals for the corners of triangles; corners among which the surface is smooth share one.
#[derive(Debug, Clone, PartialEq)]
pub struct CornerNormals {
    /// The different normals.
    pub normals: Vec<Vec3>,
    /// For the three corners of each triangle, which of them is theirs.
    pub corners: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Normals that are smooth where triangles meet at an angle of at most `crease` (radians, 0..=pi) and
    /// have an edge where they meet at more: of the triangles around a vertex, those that hang together
    /// over smooth sides share the mean of their normals, weighted by their angles there (Thürmer &
    /// Wüthrich 1998), which does not depend on how a surface is cut into triangles.
    ///
    /// Vertices at one place count as one. Triangles must go round the same way, see [`Self::oriented`]:
    /// two that do not have an edge between them.
    pub fn corner_normals(&self, crease: f32) -> CornerNormals {
        // Triangles of one plane meet at no angle but for rounding.
        let least = libm::cos(f64::from(crease)) - 1e-9;
        let flat: Vec<DVec3> = (0..self.triangles.len())
            .map(|triangle| area_vector(self.corners_in_space(triangle)).normalize_or_zero())
            .collect();
        let mut groups = Groups::new(3 * self.triangles.len());
        let sides = self.sides(&self.places());
        for shared in sides.chunk_by(|one, other| one.ends == other.ends) {
            let shared = &shared[..shared.len().min(MOST_ON_A_SIDE)];
            for (index, one) in shared.iter().enumerate() {
                for other in &shared[index + 1..] {
                    let angle = flat[one.triangle as usize].dot(flat[other.triangle as usize]);
                    if angle >= least {
                        let (ours, theirs) = (one.corners(), other.corners());
                        groups.join(ours[0], theirs[0]);
                        groups.join(ours[1], theirs[1]);
                    }
                }
            }
        }
        let mut sums = vec![DVec3::ZERO; 3 * self.triangles.len()];
        for (triangle, &normal) in flat.iter().enumerate() {
            let places = self.corners_in_space(triangle);
            for corner in 0..3 {
                let one = places[(corner + 1) % 3] - places[corner];
                let other = places[(corner + 2) % 3] - places[corner];
                let angle = libm::atan2(one.cross(other).length(), one.dot(other));
                let group = groups.of((3 * triangle + corner) as u32);
                sums[group as usize] += normal * angle;
            }
        }
        let mut numbers = vec![u32::MAX; sums.len()];
        let mut normals = Vec::new();
        let corners = (0..self.triangles.len()).map(|triangle| {
            std::array::from_fn(|corner| {
                let group = groups.of((3 * triangle + corner) as u32) as usize;
                if numbers[group] == u32::MAX {
                    numbers[group] = normals.len() as u32;
                    normals.push(sums[group].normalize_or(flat[triangle]).as_vec3());
                }
                numbers[group]
            })
        });
        CornerNormals {
            corners: corners.collect(),
            normals,
        }
    }
}

/// Which things belong together: a forest whose trees are the groups (Galler & Fischer 1964).
struct Groups(Vec<u32>);

impl Groups {
    /// All apart.
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The one that stands for the group.
    fn of(&mut self, thing: u32) -> u32 {
        let mut root = thing;
        while self.0[root as usize] != root {
            // Every second step is left out the next time.
            let above = self.0[self.0[root as usize] as usize];
            self.0[root as usize] = above;
            root = above;
        }
        root
    }

    fn join(&mut self, one: u32, other: u32) {
        let (one, other) = (self.of(one), self.of(other));
        self.0[one.max(other) as usize] = one.min(other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    /// Eight corners that three sides each share.
    fn cube() -> TriangleMesh {
        let at = |corner: u32, bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let place = |corner| Vec3::new(at(corner, 0), at(corner, 1), at(corner, 2));
        let squares = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = squares
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        TriangleMesh::new((0..8).map(place).collect(), triangles.collect()).unwrap()
    }

    #[test]
    fn a_cube_is_flat_up_to_its_edges() {
        let mesh = cube();
        let found = mesh.corner_normals(89f32.to_radians());
        assert_eq!(found.normals.len(), 24);
        for (corners, triangle) in found.corners.iter().zip(mesh.triangles()) {
            let [a, b, c] = triangle.map(|corner| mesh.positions()[corner as usize]);
            let expected = (b - a).cross(c - a).normalize();
            for &corner in corners {
                assert_eq!(found.normals[corner as usize], expected);
            }
        }
        // Above a right angle its corners are round.
        let round = mesh.corner_normals(91f32.to_radians());
        assert_eq!(round.normals.len(), 8);
        for (corners, triangle) in round.corners.iter().zip(mesh.triangles()) {
            for (&corner, &vertex) in corners.iter().zip(triangle) {
                let expected = mesh.positions()[vertex as usize].normalize();
                assert!((round.normals[corner as usize] - expected).length() < 1e-6);
            }
        }
    }

    /// Rings of twelve and more facets meet at less than the crease: no vertex is cut.
    #[test]
    fn a_sphere_stays_smooth() {
        let (rings, sectors) = (24u32, 36u32);
        let mut positions = Vec::new();
        for ring in 0..=rings {
            for sector in 0..sectors {
                let polar = PI * ring as f32 / rings as f32;
                let azimuth = 2.0 * PI * sector as f32 / sectors as f32;
                let flat = if ring % rings == 0 { 0.0 } else { polar.sin() };
                let place = Vec3::new(flat * azimuth.cos(), polar.cos(), flat * azimuth.sin());
                positions.push(place);
            }
        }
        let mut triangles = Vec::new();
        for ring in 0..rings {
            for sector in 0..sectors {
                let place = |r: u32, s: u32| r * sectors + s % sectors;
                let (a, b) = (place(ring, sector), place(ring, sector + 1));
                let (c, d) = (place(ring + 1, sector + 1), place(ring + 1, sector));
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        let mesh = TriangleMesh::new(positions, triangles).unwrap();
        let found = mesh.corner_normals(40f32.to_radians());
        assert_eq!(found.normals.len() as u32, (rings - 1) * sectors + 2);
        for (corners, triangle) in found.corners.iter().zip(mesh.triangles()) {
            for (&corner, &vertex) in corners.iter().zip(triangle) {
                let off = found.normals[corner as usize] - mesh.positions()[vertex as usize];
                assert!(off.length() < 0.01, "{off}");
            }
        }
    }

    /// Two walls of a ridge that do not share the vertices along it: the normals there must lie
    /// between the walls all the same, however a wall is cut.
    #[test]
    fn normals_are_smooth_across_seams() {
        let positions = vec![
            Vec3::new(0.0, 0.0, 0.0),
            Vec3::new(-0.0, 1.0, 0.0),
            Vec3::new(-1.0, 0.0, -1.0),
            Vec3::new(-1.0, 1.0, -1.0),
            Vec3::new(0.0, 0.0, -0.0),
            Vec3::new(0.0, 1.0, 0.0),
            Vec3::new(1.0, 0.0, -1.0),
            Vec3::new(1.0, 1.0, -1.0),
        ];
        let left = [[0, 1, 2], [1, 3, 2]];
        let right = [[4, 6, 5], [5, 6, 7]];
        let mesh = TriangleMesh::new(positions, [left, right].concat()).unwrap();
        let found = mesh.corner_normals(PI);
        let at = |triangle: usize, corner: usize| {
            found.normals[found.corners[triangle][corner] as usize]
        };
        for (triangle, corner) in [(0, 0), (0, 1), (1, 0), (2, 0), (2, 2), (3, 0)] {
            let normal = at(triangle, corner);
            assert!((normal - Vec3::Z).length() < 1e-6, "{triangle} {corner}");
        }
        let wall = Vec3::new(-1.0, 0.0, 1.0).normalize();
        assert!((at(1, 1) - wall).length() < 1e-6);
    }

    /// A sheet given twice, once for each side, is two sheets.
    #[test]
    fn both_sides_of_a_sheet_keep_their_own() {
        let places = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
        let triangles = vec![[0, 1, 2], [2, 1, 3], [0, 2, 1], [2, 3, 1]];
        let mesh = TriangleMesh::new(places, triangles).unwrap();
        let found = mesh.corner_normals(1.0);
        for (triangle, corners) in found.corners.iter().enumerate() {
            let expected = if triangle < 2 { Vec3::Z } else { -Vec3::Z };
            assert!(
                corners
                    .iter()
                    .all(|&c| found.normals[c as usize] == expected)
            );
        }
    }
}
