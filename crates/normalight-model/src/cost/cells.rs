//! What searched cells and the operations on their edges cost.

use super::layers::{Cost, pointwise};
use crate::cell_site::CellSite;
use crate::{Cell, Operation};

/// Channels that a row of cells leaves.
pub(crate) fn last_channels(row: &[CellSite], cells: &[&Cell]) -> usize {
    let Some(last) = row.last() else { return 0 };
    let nodes = cells.get(last.cell).map_or(0, |cell| cell.nodes.len());
    nodes * last.width
}

/// A row of cells on a stem of three times their first width.
pub(super) fn cell_row(row: &[CellSite], cells: &[&Cell]) -> Cost {
    let stem = row.first().map_or(0, |first| 3 * first.width);
    let (mut before_last, mut last) = (stem, stem);
    let mut total = Cost::default();
    for place in row {
        let Some(Cell { nodes }) = cells.get(place.cell) else {
            continue;
        };
        // Both preprocessings, at the size that comes in: a 1x1 convolution (or two half ones).
        let area = place.input_area();
        total = total + pointwise(before_last, place.width, area);
        total = total + pointwise(last, place.width, area);
        let edges = nodes
            .iter()
            .flatten()
            .map(|edge| operation_cost(edge.operation, place, edge.from));
        total = total + edges.sum();
        (before_last, last) = (last, nodes.len() * place.width);
    }
    total
}

/// What an operation costs on an edge from `from` of a cell that stands there.
pub fn operation_cost(operation: Operation, place: &CellSite, from: usize) -> Cost {
    let strided = place.reduces && from < 2;
    self::operation(operation, place.width, strided, place.area)
}

fn operation(operation: Operation, width: usize, strided: bool, area: usize) -> Cost {
    let separable = |kernel: usize| {
        let depthwise = Cost {
            parameters: kernel * kernel * width,
            multiply_adds: (kernel * kernel * width * area) as u64,
        };
        (depthwise + pointwise(width, width, area)) * 2
    };
    match operation {
        Operation::Separable1 => separable(1),
        Operation::Separable3 => separable(3),
        Operation::Separable5 => separable(5),
        Operation::Convolution3 => Cost {
            parameters: 9 * width * width + 2 * width,
            multiply_adds: (9 * width * width * area) as u64,
        },
        Operation::Skip if strided => pointwise(width, width, area),
        Operation::Skip | Operation::Zero => Cost::default(),
    }
}
