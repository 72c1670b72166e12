use crate::layers::{FactorizedReduce, Form, NormedConv};
use crate::mixed_edge::MixedEdge;
use crate::operation::OperationLayer;
use crate::relaxation::Mixture;
use crate::{Cell, SearchSpace};
use burn::module::Module;
use burn::tensor::{Device, Tensor, activation};

/// Brings the output of an earlier cell to this cell's width: ReLU, 1x1, batch norm; a factorised
/// reduction where that output is twice as large.
#[derive(Module, Debug)]
enum Preprocess {
    Pointwise(NormedConv),
    Reduce(FactorizedReduce),
}

impl Preprocess {
    fn forward(&self, input: Tensor<4>) -> Tensor<4> {
        match self {
            Self::Pointwise(conv) => conv.forward(activation::relu(input)),
            Self::Reduce(reduce) => reduce.forward(input),
        }
    }

    fn folded(&self) -> Self {
        match self {
            Self::Pointwise(conv) => Self::Pointwise(conv.folded()),
            Self::Reduce(reduce) => Self::Reduce(reduce.folded()),
        }
    }
}

/// What a cell is made from.
#[derive(Debug, Clone, Copy)]
pub(crate) enum CellPlan<'a> {
    /// Two chosen edges a node.
    Chosen(&'a Cell),
    /// All edges with all operations; their weights are the relaxation's for this cell of the genotype.
    Relaxed(&'a SearchSpace, usize),
}

/// A cell with its weights.
#[derive(Module, Debug)]
pub(crate) struct CellLayer {
    before_last: Preprocess,
    last: Preprocess,
    edges: Edges,
}

#[derive(Module, Debug)]
enum Edges {
    Chosen(ChosenEdges),
    Mixed(MixedEdges),
}

#[derive(Module, Debug)]
struct ChosenEdges {
    /// Two operations per node.
    operations: Vec<OperationLayer>,
    /// Input of each operation: 0 and 1 the cell inputs, `2 + k` node `k`.
    from: Vec<usize>,
}

#[derive(Module, Debug)]
struct MixedEdges {
    /// Of the first node from both cell inputs, of the second from those and the first, and so on.
    edges: Vec<MixedEdge>,
    nodes: usize,
    /// Which cell of the genotype this is.
    cell: usize,
}

/// What a row of cells needs to know while it is built: widths of the last two outputs.
pub(crate) struct CellRow<'a> {
    pub(crate) before_last: usize,
    pub(crate) last: usize,
    pub(crate) width: usize,
    pub(crate) last_was_reduction: bool,
    pub(crate) form: Form,
    pub(crate) device: &'a Device,
}

impl<'a> CellRow<'a> {
    /// A row that starts on the output of a stem with `channels` channels.
    pub(crate) fn new(channels: usize, width: usize, form: Form, device: &'a Device) -> Self {
        Self {
            before_last: channels,
            last: channels,
            width,
            last_was_reduction: false,
            form,
            device,
        }
    }

    /// Adds a cell that keeps the size.
    pub(crate) fn normal(&mut self, plan: CellPlan) -> CellLayer {
        self.add(plan, 1)
    }

    /// Adds a cell that halves the size and doubles the width.
    pub(crate) fn reduction(&mut self, plan: CellPlan) -> CellLayer {
        self.width *= 2;
        self.add(plan, 2)
    }

    /// Adds a normal cell, then a reduction and a normal cell so many times: N R N R N for two.
    pub(crate) fn features(
        &mut self,
        normal: CellPlan,
        reduction: CellPlan,
        reductions: usize,
    ) -> Vec<CellLayer> {
        let mut cells = vec![self.normal(normal)];
        for _ in 0..reductions {
            cells.push(self.reduction(reduction));
            cells.push(self.normal(normal));
        }
        cells
    }

    fn add(&mut self, plan: CellPlan, stride: usize) -> CellLayer {
        let pointwise = |channels| {
            Preprocess::Pointwise(NormedConv::pointwise(
                [channels, self.width],
                1,
                self.form,
                self.device,
            ))
        };
        let before_last = if self.last_was_reduction {
            Preprocess::Reduce(FactorizedReduce::new(
                [self.before_last, self.width],
                self.form,
                self.device,
            ))
        } else {
            pointwise(self.before_last)
        };
        let last = pointwise(self.last);
        let (nodes, edges) = match plan {
            CellPlan::Chosen(cell) => (cell.nodes.len(), Edges::Chosen(self.chosen(cell, stride))),
            CellPlan::Relaxed(space, cell) => (
                space.nodes,
                Edges::Mixed(MixedEdges {
                    edges: self.mixed(space, stride),
                    nodes: space.nodes,
                    cell,
                }),
            ),
        };
        let layer = CellLayer {
            before_last,
            last,
            edges,
        };
        self.before_last = self.last;
        self.last = nodes * self.width;
        self.last_was_reduction = stride == 2;
        layer
    }

    fn chosen(&self, cell: &Cell, stride: usize) -> ChosenEdges {
        let edges = cell.nodes.iter().flatten();
        let operations = edges.clone().map(|edge| {
            let stride = if edge.from < 2 { stride } else { 1 };
            OperationLayer::new(edge.operation, self.width, stride, self.form, self.device)
        });
        ChosenEdges {
            operations: operations.collect(),
            from: edges.map(|edge| edge.from).collect(),
        }
    }

    fn mixed(&self, space: &SearchSpace, stride: usize) -> Vec<MixedEdge> {
        let edges = space.edges().map(|(_, from)| {
            let stride = if from < 2 { stride } else { 1 };
            MixedEdge::new(space, self.width, stride, self.device)
        });
        edges.collect()
    }
}

impl CellLayer {
    /// # Shapes
    /// - inputs: the outputs of the cell before the last and of the last
    /// - output: `[batch, height / stride, width / stride, nodes * width]`
    fn forward(
        &self,
        before_last: Tensor<4>,
        last: Tensor<4>,
        mixture: Option<&Mixture>,
    ) -> Tensor<4> {
        let mut states = vec![
            self.before_last.forward(before_last),
            self.last.forward(last),
        ];
        match (&self.edges, mixture) {
            (Edges::Chosen(chosen), _) => {
                let edges = chosen.operations.chunks(2).zip(chosen.from.chunks(2));
                for (operations, from) in edges {
                    let first = operations[0].forward(states[from[0]].clone());
                    let second = operations[1].forward(states[from[1]].clone());
                    states.push(first + second);
                }
            }
            (Edges::Mixed(mixed), Some(mixture)) => {
                let mut edges = mixed.edges.iter().zip(mixture.edges(mixed.cell));
                for node in 0..mixed.nodes {
                    let sources = states[..2 + node].iter();
                    let outputs = sources.zip(edges.by_ref());
                    let sum = outputs
                        .map(|(state, (edge, weights))| edge.forward(state.clone(), weights))
                        .reduce(|sum, output| sum + output);
                    states.extend(sum);
                }
            }
            (Edges::Mixed(_), None) => unreachable!("a relaxed network has a relaxation"),
        }
        Tensor::cat(states.split_off(2), 3)
    }

    /// Only cells of chosen edges are stored.
    pub(crate) fn folded(&self) -> Self {
        let edges = match &self.edges {
            Edges::Chosen(chosen) => Edges::Chosen(ChosenEdges {
                operations: chosen
                    .operations
                    .iter()
                    .map(OperationLayer::folded)
                    .collect(),
                from: chosen.from.clone(),
            }),
            Edges::Mixed(_) => return self.clone(),
        };
        Self {
            before_last: self.before_last.folded(),
            last: self.last.folded(),
            edges,
        }
    }
}

/// Runs a row of cells; both inputs of the first are the stem's output. `mixture`: needed by relaxed cells.
pub(crate) fn forward_row(
    cells: &[CellLayer],
    stem: Tensor<4>,
    mixture: Option<&Mixture>,
) -> Tensor<4> {
    let (mut before_last, mut last) = (stem.clone(), stem);
    for cell in cells {
        let output = cell.forward(before_last, last.clone(), mixture);
        (before_last, last) = (last, output);
    }
    last
}
