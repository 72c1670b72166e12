//! The weights of a relaxed network over the steps of a search.
use normalight_model::{CellWeights, SearchSpace};
use normalight_run::{NamedTensors, put, take};
use std::fmt::Write as _;

/// Name of its part of a checkpoint.
const HISTORY: &str = "history";

/// Weights of all cells after some steps.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct History {
    points: Vec<(usize, Vec<CellWeights>)>,
}

impl History {
    pub(super) fn add(&mut self, step: usize, weights: Vec<CellWeights>) {
        self.points.push((step, weights));
    }

    /// Of one cell.
    pub(super) fn of(&self, cell: usize) -> Vec<(usize, CellWeights)> {
        let points = self.points.iter();
        points
            .map(|(step, cells)| (*step, cells[cell].clone()))
            .collect()
    }

    /// A line for every number: step, cell, node, input, operation, weight; `edge` stands for the edge's own share of its
    /// node.
    pub(super) fn to_csv(&self, space: &SearchSpace, names: &[&str]) -> String {
        let mut text = String::from("step,cell,node,input,operation,weight\n");
        for (step, cells) in &self.points {
            for (name, weights) in names.iter().zip(cells) {
                for (row, (node, from)) in space.edges().enumerate() {
                    let mut line = |what: &str, weight: f32| {
                        let _ = writeln!(text, "{step},{name},{node},{from},{what},{weight:.6}");
                    };
                    for (operation, weight) in space.operations.iter().zip(&weights.operations[row])
                    {
                        line(operation.name(), *weight);
                    }
                    line("edge", weights.edges[row]);
                }
            }
        }
        text
    }

    /// Adds it to a checkpoint.
    pub(super) fn save(&self, state: &mut NamedTensors) {
        let points = self.points.iter().map(|(step, cells)| {
            let numbers = cells.iter().flat_map(|cell| {
                let operations = cell.operations.iter().flatten();
                operations.chain(&cell.edges).copied()
            });
            (step.to_string(), numbers.collect())
        });
        put(state, HISTORY, points.collect());
    }

    /// Takes it out of a checkpoint.
    ///
    /// # Errors
    /// What does not fit.
    pub(super) fn load(
        state: &mut NamedTensors,
        space: &SearchSpace,
        cells: usize,
    ) -> Result<Self, String> {
        let (edges, operations) = (space.edges().count(), space.operations.len());
        let size = edges * (operations + 1);
        let mut points = Vec::new();
        for (step, numbers) in take(state, HISTORY) {
            let parsed = step.parse::<usize>().ok();
            let (Some(at), true) = (parsed, numbers.len() == cells * size) else {
                return Err(format!("{HISTORY}/{step} is of another search"));
            };
            let weights = numbers.chunks(size).map(|numbers| {
                let (table, shares) = numbers.split_at(edges * operations);
                CellWeights {
                    operations: table.chunks(operations).map(<[f32]>::to_vec).collect(),
                    edges: shares.to_vec(),
                }
            });
            points.push((at, weights.collect()));
        }
        points.sort_by_key(|point| point.0);
        Ok(Self { points })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_comes_back_from_a_checkpoint() {
        let space = SearchSpace {
            nodes: 1,
            ..SearchSpace::default()
        };
        let weights = |first: f32| CellWeights {
            operations: vec![vec![first, 0.1, 0.2, 0.3, 0.4, 0.0]; 2],
            edges: vec![0.25, 0.75],
        };
        let mut history = History::default();
        for step in [5, 10, 100] {
            history.add(step, vec![weights(step as f32), weights(0.5)]);
        }
        let mut state = NamedTensors::new();
        history.save(&mut state);
        let mut other = state.clone();
        assert_eq!(History::load(&mut state, &space, 2).unwrap(), history);
        assert!(History::load(&mut other, &space, 3).is_err());
        let csv = history.to_csv(&space, &["a", "b"]);
        assert_eq!(csv.lines().count(), 1 + 3 * 2 * 2 * 7);
        assert!(csv.contains("\n10,b,0,1,edge,0.750000\n"), "{csv}");
        assert!(csv.contains("\n100,a,0,0,separable_1x1,100.000000\n"));
    }
}
