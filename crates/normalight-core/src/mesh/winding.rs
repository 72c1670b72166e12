use super::{TriangleMesh, area_vector};

impl TriangleMesh {
    /// The mesh with neighbouring triangles going round the same way: models are often put together from
    /// pieces of which some are inside out. Of every connected piece the side that most of its area calls
    /// outside stays outside.
    ///
    /// Neighbours are two triangles that share a side which no third one has; a one-sided surface,
    /// such as a Moebius strip, keeps a seam.
    pub fn oriented(mut self) -> Self {
        let neighbours = self.neighbours();
        let mut turned: Vec<Option<bool>> = vec![None; self.triangles.len()];
        let mut piece = Vec::new();
        for seed in 0..self.triangles.len() {
            if turned[seed].is_some() {
                continue;
            }
            turned[seed] = Some(false);
            piece.clear();
            piece.push(seed);
            let mut next = 0;
            // Areas of what stays and of what is turned.
            let mut areas = [0.0; 2];
            while let Some(&triangle) = piece.get(next) {
                next += 1;
                let this = turned[triangle] == Some(true);
                areas[usize::from(this)] += self.area(triangle);
                for &(neighbour, agrees) in neighbours[triangle].iter().flatten() {
                    let neighbour = neighbour as usize;
                    if turned[neighbour].is_none() {
                        turned[neighbour] = Some(this == agrees);
                        piece.push(neighbour);
                    }
                }
            }
            let most_turned = areas[1] > areas[0];
            for &triangle in &piece {
                if turned[triangle] != Some(most_turned) {
                    self.triangles[triangle].swap(1, 2);
                }
            }
        }
        self
    }

    /// For each triangle up to three others and whether they go round the same way.
    fn neighbours(&self) -> Vec<[Option<(u32, bool)>; 3]> {
        let sides = self.sides(&self.places());
        let mut neighbours = vec![[None; 3]; self.triangles.len()];
        for shared in sides.chunk_by(|one, other| one.ends == other.ends) {
            let [one, other] = shared else {
                continue;
            };
            // Triangles that go round the same way run along their common side in opposite directions.
            let agrees = one.forward != other.forward;
            for (side, neighbour) in [(one, other), (other, one)] {
                let place = &mut neighbours[side.triangle as usize][side.corner as usize];
                *place = Some((neighbour.triangle, agrees));
            }
        }
        neighbours
    }

    fn area(&self, triangle: usize) -> f64 {
        area_vector(self.corners_in_space(triangle)).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Six squares of two triangles, counter-clockwise from outside; corners are not shared by the squares.
    fn cube() -> TriangleMesh {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for axis in 0..3 {
            for sign in [-1.0f32, 1.0] {
                let mut out = [0.0; 3];
                out[axis] = sign;
                let out = Vec3::from_array(out);
                let (u, v) = out.any_orthonormal_pair();
                let first = positions.len() as u32;
                positions.extend([out - u - v, out + u - v, out + u + v, out - u + v]);
                triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|c: u32| first + c)));
            }
        }
        TriangleMesh::new(positions, triangles).unwrap()
    }

    fn outward(mesh: &TriangleMesh) -> usize {
        let count = mesh.triangles.iter().filter(|corners| {
            let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
            (b - a).cross(c - a).dot(a + b + c) > 0.0
        });
        count.count()
    }

    #[test]
    fn any_few_turned_triangles_are_turned_back() {
        let mesh = cube();
        assert_eq!(outward(&mesh), 12);
        assert_eq!(mesh.clone().oriented(), mesh);
        // All choices of fewer than half of the twelve.
        for choice in (0u32..1 << 12).filter(|choice| choice.count_ones() < 6) {
            let mut turned = mesh.clone();
            for (triangle, corners) in turned.triangles.iter_mut().enumerate() {
                if choice >> triangle & 1 == 1 {
                    corners.swap(1, 2);
                }
            }
            assert_eq!(turned.oriented(), mesh, "{choice:b}");
        }
    }

    #[test]
    fn pieces_decide_for_themselves() {
        // A second cube, far away and inside out but for one triangle.
        let (one, mut other) = (cube(), cube());
        for corners in &mut other.triangles[1..] {
            corners.swap(1, 2);
        }
        let shift = one.positions.len() as u32;
        let far = other.positions.iter().map(|&place| place + Vec3::X * 9.0);
        let positions = one.positions.iter().copied().chain(far).collect();
        let moved = other.triangles.iter().map(|t| t.map(|c| c + shift));
        let triangles = one.triangles.iter().copied().chain(moved).collect();
        let mesh = TriangleMesh::new(positions, triangles).unwrap().oriented();
        let second = TriangleMesh {
            positions: other.positions,
            triangles: mesh.triangles[12..]
                .iter()
                .map(|t| t.map(|c| c - shift))
                .collect(),
        };
        assert_eq!(mesh.triangles[..12], one.triangles);
        assert_eq!(outward(&second), 0);
    }

    /// Triangles around a fan in which every second shares its side with two others.
    #[test]
    fn what_has_no_two_sides_ends() {
        let book = vec![Vec3::ZERO, Vec3::Z, Vec3::X, Vec3::Y, -Vec3::X];
        let mesh = TriangleMesh::new(book, vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]]).unwrap();
        assert_eq!(mesh.clone().oriented(), mesh);
    }
}
