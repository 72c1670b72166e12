//! The continuous relaxation of a search space (Liu et al. 2019): weights of all operations on all edges.
use crate::{Operation, SearchSpace};
use burn::module::{Module, Param};
use burn::tensor::{Device, Distribution, Tensor, TensorData, activation};

/// Deviation of the first values of the architecture's parameters, as in DARTS.
const DEVIATION: f64 = 1e-3;

/// The architecture's parameters of a relaxed network, one table for each cell of its genotype.
///
/// Operations on an edge are weighted by the softmax of the edge's row.
#[derive(Module, Debug)]
pub struct Relaxation {
    /// `[edges, operations]` each.
    operations: Vec<Param<Tensor<2>>>,
    /// `[edges]` each, where only some channels go through the operations (Xu et al. 2020): edges are then weighted,
    /// too, by the softmax over the edges of a node.
    edges: Option<Vec<Param<Tensor<1>>>>,
    /// Weight of the auxiliary skip on every edge.
    auxiliary_skip: f32,
    #[module(skip)]
    space: SearchSpace,
}

/// Weights of a cell's edges on the host.
#[derive(Debug, Clone, PartialEq)]
pub struct CellWeights {
    /// `[edges][operations]`; those of an edge sum to one.
    pub operations: Vec<Vec<f32>>,
    /// `[edges]`; those of a node sum to one.
    pub edges: Vec<f32>,
}

impl Relaxation {
    /// Nearly equal weights for `cells` cells.
    pub(crate) fn new(space: &SearchSpace, cells: usize, device: &Device) -> Self {
        let (edges, operations) = (space.edges().count(), space.operations.len());
        let noise = Distribution::Normal(0.0, DEVIATION);
        let table = |_| Param::from_tensor(Tensor::random([edges, operations], noise, device));
        let row = |_| Param::from_tensor(Tensor::random([edges], noise, device));
        Self {
            operations: (0..cells).map(table).collect(),
            edges: (space.channel_divisor > 1).then(|| (0..cells).map(row).collect()),
            auxiliary_skip: 0.0,
            space: space.clone(),
        }
    }

    /// The search space.
    pub fn space(&self) -> &SearchSpace {
        &self.space
    }

    /// Sets the weight of a skip that is added on every edge beside the weighted ones (Chu et al. 2021).
    pub fn set_auxiliary_skip(&mut self, weight: f32) {
        self.auxiliary_skip = weight;
    }

    /// The weights as they are now.
    pub fn weights(&self) -> Vec<CellWeights> {
        let host = |tensor: Tensor<1>| tensor.into_data().iter::<f32>().collect::<Vec<_>>();
        let cells = 0..self.operations.len();
        cells
            .map(|cell| {
                let table = host(self.softmax(cell).flatten(0, 1));
                let columns = self.space.operations.len();
                CellWeights {
                    operations: table.chunks(columns).map(<[f32]>::to_vec).collect(),
                    edges: host(self.edge_shares(cell)),
                }
            })
            .collect()
    }

    /// Expected cost of the network that will be derived, two edges a node: the sum over the weights times what
    /// each costs, `[cells][edges][operations]`.
    ///
    /// # Shapes
    /// - output: `[1]`, differentiable
    pub fn expected_cost(&self, costs: &[Vec<Vec<f32>>]) -> Tensor<1> {
        let device = self.operations[0].val().device();
        let mut sum = Tensor::zeros([1], &device);
        for (cell, costs) in costs.iter().enumerate() {
            let size = [costs.len(), self.space.operations.len()];
            let costs = TensorData::new(costs.concat(), size);
            let costs = Tensor::<2>::from_data(costs, &device);
            let of_edges = (self.softmax(cell) * costs).sum_dim(1).reshape([size[0]]);
            sum = sum + (of_edges * self.edge_shares(cell) * 2.0).sum();
        }
        sum
    }

    /// `[edges, operations]`.
    fn softmax(&self, cell: usize) -> Tensor<2> {
        activation::softmax(self.operations[cell].val(), 1)
    }

    /// `[edges]`; without weights of their own, equal shares for all edges of a node.
    fn edge_shares(&self, cell: usize) -> Tensor<1> {
        let nodes = 0..self.space.nodes;
        let Some(edges) = &self.edges else {
            let shares = self.space.edges().map(|(node, _)| 1.0 / (2 + node) as f32);
            let shares: Vec<f32> = shares.collect();
            let count = shares.len();
            let device = self.operations[cell].val().device();
            return Tensor::from_data(TensorData::new(shares, [count]), &device);
        };
        let all = edges[cell].val();
        let first = |node: usize| (0..node).map(|before| 2 + before).sum::<usize>();
        let rows = nodes.map(|node| {
            let row = first(node)..first(node) + 2 + node;
            activation::softmax(all.clone().slice(row), 0)
        });
        Tensor::cat(rows.collect(), 0)
    }

    /// What a forward pass needs.
    pub(crate) fn mixture(&self) -> Mixture {
        let skip = self.space.operations.iter();
        let skip = skip.clone().position(|one| *one == Operation::Skip);
        let cells = 0..self.operations.len();
        let cells = cells.map(|cell| {
            let table = self.softmax(cell);
            let shares = self.edges.is_some().then(|| self.edge_shares(cell));
            let [edges, operations] = table.dims();
            let number = |edge: usize, operation: usize| {
                let at = [edge..edge + 1, operation..operation + 1];
                table.clone().slice(at).reshape([1])
            };
            let edge = |edge: usize| {
                let mut weights: Vec<Tensor<1>> =
                    (0..operations).map(|one| number(edge, one)).collect();
                if let Some(skip) = skip
                    && self.auxiliary_skip > 0.0
                {
                    // The auxiliary skip is the same map as the weighted one.
                    weights[skip] = weights[skip].clone() + self.auxiliary_skip;
                }
                let share = shares
                    .as_ref()
                    .map(|shares| shares.clone().narrow(0, edge, 1));
                EdgeWeights {
                    operations: weights,
                    share,
                }
            };
            (0..edges).map(edge).collect()
        });
        Mixture(cells.collect())
    }
}

/// Weights of all edges, as small tensors of one forward pass.
pub(crate) struct Mixture(Vec<Vec<EdgeWeights>>);

impl Mixture {
    pub(crate) fn edges(&self, cell: usize) -> &[EdgeWeights] {
        &self.0[cell]
    }
}

/// Weights of one edge.
pub(crate) struct EdgeWeights {
    /// `[1]` each.
    pub(crate) operations: Vec<Tensor<1>>,
    /// `[1]`, among the edges of its node.
    pub(crate) share: Option<Tensor<1>>,
}
