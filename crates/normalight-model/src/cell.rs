use crate::Cell;
use crate::layers::{FactorizedReduce, NormedConv};
use crate::operation::OperationLayer;
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

/// A cell with its weights.
#[derive(Module, Debug)]
pub(crate) struct CellLayer {
    before_last: Preprocess,
    last: Preprocess,
    /// Two operations per node.
    operations: Vec<OperationLayer>,
    /// Input of each operation: 0 and 1 the cell inputs, `2 + k` node `k`.
    from: Vec<usize>,
}

/// What a row of cells needs to know while it is built: widths of the last two outputs.
pub(crate) struct CellRow<'a> {
    pub(crate) before_last: usize,
    pub(crate) last: usize,
    pub(crate) width: usize,
    pub(crate) last_was_reduction: bool,
    pub(crate) folded: bool,
    pub(crate) device: &'a Device,
}

impl<'a> CellRow<'a> {
    /// A row that starts on the output of a stem with `channels` channels.
    pub(crate) fn new(channels: usize, width: usize, folded: bool, device: &'a Device) -> Self {
        Self {
            before_last: channels,
            last: channels,
            width,
            last_was_reduction: false,
            folded,
            device,
        }
    }

    /// Adds a cell that keeps the size.
    pub(crate) fn normal(&mut self, cell: &Cell) -> CellLayer {
        self.add(cell, 1)
    }

    /// Adds a cell that halves the size and doubles the width.
    pub(crate) fn reduction(&mut self, cell: &Cell) -> CellLayer {
        self.width *= 2;
        self.add(cell, 2)
    }

    fn add(&mut self, cell: &Cell, stride: usize) -> CellLayer {
        let pointwise = |channels| {
            Preprocess::Pointwise(NormedConv::pointwise(
                [channels, self.width],
                1,
                self.folded,
                self.device,
            ))
        };
        let before_last = if self.last_was_reduction {
            Preprocess::Reduce(FactorizedReduce::new(
                [self.before_last, self.width],
                self.folded,
                self.device,
            ))
        } else {
            pointwise(self.before_last)
        };
        let last = pointwise(self.last);
        let edges = cell.nodes.iter().flatten();
        let operations = edges
            .clone()
            .map(|edge| {
                let stride = if edge.from < 2 { stride } else { 1 };
                OperationLayer::new(edge.operation, self.width, stride, self.folded, self.device)
            })
            .collect();
        let layer = CellLayer {
            before_last,
            last,
            operations,
            from: edges.map(|edge| edge.from).collect(),
        };
        self.before_last = self.last;
        self.last = cell.nodes.len() * self.width;
        self.last_was_reduction = stride == 2;
        layer
    }
}

impl CellLayer {
    /// # Shapes
    /// - inputs: the outputs of the cell before the last and of the last
    /// - output: `[batch, height / stride, width / stride, nodes * width]`
    fn forward(&self, before_last: Tensor<4>, last: Tensor<4>) -> Tensor<4> {
        let mut states = vec![
            self.before_last.forward(before_last),
            self.last.forward(last),
        ];
        for (operations, from) in self.operations.chunks(2).zip(self.from.chunks(2)) {
            let first = operations[0].forward(states[from[0]].clone());
            let second = operations[1].forward(states[from[1]].clone());
            states.push(first + second);
        }
        Tensor::cat(states.split_off(2), 3)
    }

    pub(crate) fn folded(&self) -> Self {
        Self {
            before_last: self.before_last.folded(),
            last: self.last.folded(),
            operations: self.operations.iter().map(OperationLayer::folded).collect(),
            from: self.from.clone(),
        }
    }
}

/// Runs a row of cells; both inputs of the first are the stem's output.
pub(crate) fn forward_row(cells: &[CellLayer], stem: Tensor<4>) -> Tensor<4> {
    let (mut before_last, mut last) = (stem.clone(), stem);
    for cell in cells {
        let output = cell.forward(before_last, last.clone());
        (before_last, last) = (last, output);
    }
    last
}
