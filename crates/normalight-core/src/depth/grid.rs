use super::pairing::Links;

/// A weighted graph whose nodes are the pixels of a rectangle and whose links join neighbours, and its
/// Laplacian: `(A x)_i = sum over neighbours j of w_ij (x_i - x_j)`.
///
/// Nodes of the outermost rows and columns have no links.
#[derive(Debug)]
pub(super) struct Grid {
    /// Length of a row.
    pub(super) stride: usize,
    /// Weights of the links to the next node of the row.
    pub(super) right: Vec<f32>,
    /// Weights of the links to the node below.
    pub(super) below: Vec<f32>,
    /// One over the sum of a node's weights; zero for a node without links.
    inverse: Vec<f32>,
}

impl Grid {
    /// No links yet.
    pub(super) fn new(stride: usize, count: usize) -> Self {
        Self {
            stride,
            right: vec![0.0; count],
            below: vec![0.0; count],
            inverse: vec![0.0; count],
        }
    }

    /// To be called when weights have changed.
    pub(super) fn update(&mut self) {
        let stride = self.stride;
        for node in self.inner() {
            let sum = self.right[node]
                + self.right[node - 1]
                + self.below[node]
                + self.below[node - stride];
            self.inverse[node] = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        }
    }

    /// All nodes but those of the first and last row.
    fn inner(&self) -> std::ops::Range<usize> {
        self.stride..self.right.len() - self.stride
    }

    /// `out = A x`. Differences come first: heights are large compared with what they differ by.
    pub(super) fn multiply(&self, x: &[f32], out: &mut [f32]) {
        let (stride, count) = (self.stride, self.right.len());
        for start in (stride..count - stride).step_by(stride) {
            let here = &x[start..start + stride];
            let (left, next) = (&x[start - 1..][..stride], &x[start + 1..][..stride]);
            let (above, below) = (&x[start - stride..start], &x[start + stride..][..stride]);
            let (to_left, to_right) = (
                &self.right[start - 1..][..stride],
                &self.right[start..][..stride],
            );
            let (to_above, to_below) = (
                &self.below[start - stride..start],
                &self.below[start..][..stride],
            );
            for (k, out) in out[start..start + stride].iter_mut().enumerate() {
                *out = to_right[k] * (here[k] - next[k])
                    + to_left[k] * (here[k] - left[k])
                    + to_below[k] * (here[k] - below[k])
                    + to_above[k] * (here[k] - above[k]);
            }
        }
    }

    /// One sweep of Gauss-Seidel forwards from zero, and what it leaves: `residual = b - A x`, for which
    /// only the later neighbours count.
    pub(super) fn first_sweep(&self, b: &[f32], x: &mut [f32], residual: &mut [f32]) {
        let stride = self.stride;
        for node in self.inner() {
            let known =
                self.right[node - 1] * x[node - 1] + self.below[node - stride] * x[node - stride];
            x[node] = (b[node] + known) * self.inverse[node];
        }
        for node in self.inner() {
            residual[node] = self.right[node] * x[node + 1] + self.below[node] * x[node + stride];
        }
    }

    /// One sweep of Gauss-Seidel backwards.
    pub(super) fn last_sweep(&self, b: &[f32], x: &mut [f32]) {
        let stride = self.stride;
        for node in self.inner().rev() {
            let known = self.right[node] * x[node + 1]
                + self.right[node - 1] * x[node - 1]
                + self.below[node] * x[node + stride]
                + self.below[node - stride] * x[node - stride];
            x[node] = (b[node] + known) * self.inverse[node];
        }
    }
}

impl Links for Grid {
    fn count(&self) -> usize {
        self.right.len()
    }

    fn each(&self, node: usize, mut take: impl FnMut(usize, f32)) {
        if !self.inner().contains(&node) {
            return;
        }
        let stride = self.stride;
        for (other, weight) in [
            (node + 1, self.right[node]),
            (node + stride, self.below[node]),
            (node - 1, self.right[node - 1]),
            (node - stride, self.below[node - stride]),
        ] {
            if weight > 0.0 {
                take(other, weight);
            }
        }
    }
}
