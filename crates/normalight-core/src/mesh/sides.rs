use super::TriangleMesh;

/// A side of a triangle, from one corner to the next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// The places it joins, the lower number first.
    pub(super) ends: [u32; 2],
    pub(super) triangle: u32,
    /// Which of the triangle's corners it starts from, 0..3.
    pub(super) corner: u32,
    /// Whether it starts from the first end.
    pub(super) forward: bool,
}

impl Side {
    /// Numbers of its corners at the first and at the second end, `3 * triangle + corner`.
    pub(super) fn corners(&self) -> [u32; 2] {
        let first = 3 * self.triangle;
        let [start, end] = [first + self.corner, first + (self.corner + 1) % 3];
        if self.forward {
            [start, end]
        } else {
            [end, start]
        }
    }
}

impl TriangleMesh {
    /// All sides of all triangles, those that join the same places beside each other. `places`: for each
    /// vertex the one that stands for its place.
    pub(super) fn sides(&self, places: &[u32]) -> Vec<Side> {
        let mut sides = Vec::with_capacity(3 * self.triangles.len());
        for (triangle, vertices) in self.triangles.iter().enumerate() {
            let corners = vertices.map(|vertex| places[vertex as usize]);
            for corner in 0..3 {
                let [start, end] = [corners[corner], corners[(corner + 1) % 3]];
                sides.push(Side {
                    ends: [start.min(end), start.max(end)],
                    triangle: triangle as u32,
                    corner: corner as u32,
                    forward: start < end,
                });
            }
        }
        sides.sort_unstable_by_key(|side| (side.ends, side.triangle, side.corner));
        sides
    }
}
