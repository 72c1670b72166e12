use super::pairing::{Links, NONE};

/// A weighted graph by lists of links, and its Laplacian as in [`Grid`](super::grid::Grid).
#[derive(Debug)]
pub(super) struct Graph {
    /// Where the links of each node begin; one more than there are nodes.
    starts: Vec<u32>,
    links: Vec<(u32, f32)>,
    /// One over the sum of a node's weights; zero for a node without links.
    inverse: Vec<f32>,
}

impl Graph {
    /// No nodes yet.
    pub(super) fn with_capacity(nodes: usize) -> Self {
        let mut starts = Vec::with_capacity(nodes + 1);
        starts.push(0);
        Self {
            starts,
            links: Vec::with_capacity(5 * nodes),
            inverse: Vec::with_capacity(nodes),
        }
    }

    /// One more node with all its links.
    pub(super) fn push(&mut self, links: &[(u32, f32)]) {
        self.links.extend_from_slice(links);
        self.starts.push(self.links.len() as u32);
        let sum: f32 = links.iter().map(|(_, weight)| weight).sum();
        self.inverse.push(if sum > 0.0 { 1.0 / sum } else { 0.0 });
    }

    /// For each node the number of the connected part it belongs to, and the nodes of each part.
    pub(super) fn parts(&self) -> (Vec<u32>, Vec<u32>) {
        let mut parts = vec![NONE; self.count()];
        let mut sizes = Vec::new();
        let mut open = Vec::new();
        for start in 0..self.count() {
            if parts[start] != NONE {
                continue;
            }
            let part = sizes.len() as u32;
            sizes.push(0);
            parts[start] = part;
            open.push(start);
            while let Some(node) = open.pop() {
                sizes[part as usize] += 1;
                for &(other, _) in self.links(node) {
                    let other = other as usize;
                    if parts[other] == NONE {
                        parts[other] = part;
                        open.push(other);
                    }
                }
            }
        }
        (parts, sizes)
    }

    fn links(&self, node: usize) -> &[(u32, f32)] {
        &self.links[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    fn sum(&self, node: usize, x: &[f32], counts: impl Fn(usize) -> bool) -> f32 {
        let links = self.links(node).iter();
        let links = links.filter(|(other, _)| counts(*other as usize));
        links
            .map(|&(other, weight)| weight * x[other as usize])
            .sum()
    }

    /// `out = A x`.
    pub(super) fn multiply(&self, x: &[f32], out: &mut [f32]) {
        for (node, out) in out.iter_mut().enumerate() {
            let links = self.links(node).iter();
            *out = links
                .map(|&(other, weight)| weight * (x[node] - x[other as usize]))
                .sum();
        }
    }

    /// One sweep of Gauss-Seidel forwards from zero, and what it leaves: `residual = b - A x`.
    pub(super) fn first_sweep(&self, b: &[f32], x: &mut [f32], residual: &mut [f32]) {
        for node in 0..b.len() {
            let known = self.sum(node, x, |other| other < node);
            x[node] = (b[node] + known) * self.inverse[node];
        }
        for (node, residual) in residual.iter_mut().enumerate() {
            *residual = self.sum(node, x, |other| other > node);
        }
    }

    /// One sweep of Gauss-Seidel backwards.
    pub(super) fn last_sweep(&self, b: &[f32], x: &mut [f32]) {
        for node in (0..b.len()).rev() {
            let known = self.sum(node, x, |_| true);
            x[node] = (b[node] + known) * self.inverse[node];
        }
    }
}

impl Links for Graph {
    fn count(&self) -> usize {
        self.inverse.len()
    }

    fn each(&self, node: usize, mut take: impl FnMut(usize, f32)) {
        for &(other, weight) in self.links(node) {
            take(other as usize, weight);
        }
    }
}
