use normalight_model::{Cell, CellWeights, Edge, Operation, SearchSpace};

/// Weight of a chosen edge and where it stands in the table.
#[derive(Debug, Clone, Copy)]
struct Chosen {
    edge: Edge,
    weight: f32,
    row: usize,
}

/// The cell that the weights speak for (Liu et al. 2019): the strongest operation other than zero on every edge, the two
/// strongest edges of every node. With more skips than `most_skips` the weakest skip gives way to the next strongest choice.
pub(super) fn derive(
    space: &SearchSpace,
    weights: &CellWeights,
    most_skips: Option<usize>,
) -> Cell {
    let mut table = weights.operations.clone();
    loop {
        let chosen = strongest(space, &table, &weights.edges);
        let skips = chosen.iter().flatten().filter(|one| is_skip(one.edge));
        let most = most_skips.unwrap_or(usize::MAX);
        let weakest = skips.clone().min_by(|a, b| a.weight.total_cmp(&b.weight));
        match (weakest, skip_column(space)) {
            (Some(weakest), Some(column)) if skips.count() > most => {
                table[weakest.row][column] = f32::NEG_INFINITY;
            }
            _ => {
                let nodes = chosen.iter().map(|pair| pair.map(|one| one.edge));
                return Cell {
                    nodes: nodes.collect(),
                };
            }
        }
    }
}

fn is_skip(edge: Edge) -> bool {
    edge.operation == Operation::Skip
}

fn skip_column(space: &SearchSpace) -> Option<usize> {
    let mut operations = space.operations.iter();
    operations.position(|one| *one == Operation::Skip)
}

/// The two strongest edges of every node, in the order of their inputs.
fn strongest(space: &SearchSpace, table: &[Vec<f32>], shares: &[f32]) -> Vec<[Chosen; 2]> {
    let mut edges: Vec<Vec<Chosen>> = vec![Vec::new(); space.nodes];
    for (row, (node, from)) in space.edges().enumerate() {
        let operations = space.operations.iter().zip(&table[row]);
        let strongest = operations
            .filter(|(operation, _)| **operation != Operation::Zero)
            .max_by(|a, b| a.1.total_cmp(b.1));
        if let Some((&operation, weight)) = strongest {
            edges[node].push(Chosen {
                edge: Edge { operation, from },
                weight: weight * shares[row],
                row,
            });
        }
    }
    let pair = |mut edges: Vec<Chosen>| {
        // Stable: of equal edges the earlier input wins.
        edges.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        let mut pair = [edges[0], edges[1]];
        pair.sort_by_key(|one| one.edge.from);
        pair
    };
    edges.into_iter().map(pair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use Operation::{Separable3, Separable5, Skip, Zero};

    fn space(nodes: usize) -> SearchSpace {
        SearchSpace {
            operations: vec![Separable3, Separable5, Skip, Zero],
            nodes,
            channel_divisor: 1,
        }
    }

    fn edge(operation: Operation, from: usize) -> Edge {
        Edge { operation, from }
    }

    /// By hand: the second node's edge from the first cell input is almost only zero and drops out.
    #[test]
    fn two_strongest_edges_and_never_zero() {
        let weights = CellWeights {
            operations: vec![
                vec![0.4, 0.1, 0.3, 0.2],
                vec![0.1, 0.2, 0.3, 0.4],
                vec![0.1, 0.0, 0.0, 0.9],
                vec![0.2, 0.3, 0.2, 0.3],
                vec![0.1, 0.2, 0.5, 0.2],
            ],
            edges: vec![0.5, 0.5, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
        };
        let cell = derive(&space(2), &weights, None);
        let expected = [
            [edge(Separable3, 0), edge(Skip, 1)],
            [edge(Separable5, 1), edge(Skip, 2)],
        ];
        assert_eq!(cell.nodes, expected);
        // One skip: the weaker one (0.3 / 2 against 0.5 / 3) becomes a separable 5x5.
        let cell = derive(&space(2), &weights, Some(1));
        assert_eq!(cell.nodes[0], [edge(Separable3, 0), edge(Separable5, 1)]);
        assert_eq!(cell.nodes[1], expected[1]);
        let cell = derive(&space(2), &weights, Some(0));
        assert_eq!(cell.nodes[1], [edge(Separable5, 1), edge(Separable5, 2)]);
        // An edge with a small share of its node loses.
        let mut weights = weights;
        weights.edges[4] = 0.01;
        let cell = derive(&space(2), &weights, None);
        assert_eq!(cell.nodes[1], [edge(Separable3, 0), edge(Separable5, 1)]);
    }
}
