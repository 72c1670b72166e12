use super::budget::Costs;
use super::{SearchRecipe, SearchTask};
use normalight_model::{Cell, Edge, Genotypes, Operation, SearchSpace};
use normalight_run::RunError;
use normalight_synth::scrambled;
use normalight_train::{LightTask, Network, NormalTask, TrainError};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// Draws until one is within the budget, at most.
const MOST_DRAWS: usize = 100_000;

/// Genotypes drawn uniformly from the recipe's space, and within its budget if it has one: two different inputs a node
/// and any operation but zero on each. Genotype `k` depends on recipe, seed and `k` alone.
///
/// # Errors
/// Those of the recipe; [`RunError::Value`] when the budget admits nearly none.
pub fn random_genotypes(recipe: &SearchRecipe, count: usize) -> Result<Vec<Genotypes>, TrainError> {
    recipe.validate()?;
    match recipe.training.network.kind() {
        Network::Light => draw::<LightTask>(recipe, count),
        Network::Normal => draw::<NormalTask>(recipe, count),
    }
}

fn draw<T: SearchTask>(recipe: &SearchRecipe, count: usize) -> Result<Vec<Genotypes>, TrainError> {
    let space = recipe.search.space();
    let costs = Costs::of(recipe)?;
    let numbers = 0..count as u64;
    numbers
        .map(|number| {
            let seed = scrambled((recipe.training.seed << 32) + number);
            let mut random = Pcg32::new(seed, 0);
            let source = format!(
                "random, number {} of seed {}",
                number + 1,
                recipe.training.seed
            );
            for _ in 0..MOST_DRAWS {
                let cells: Vec<Cell> = (0..T::CELLS.len())
                    .map(|_| cell(&space, &mut random))
                    .collect();
                if costs
                    .as_ref()
                    .is_none_or(|costs| costs.admit(&space, &cells))
                {
                    return Ok(T::genotypes(source, cells));
                }
            }
            Err(TrainError::Run(RunError::Value {
                field: "search.budget.target",
                found: format!("fewer than one in {MOST_DRAWS} random genotypes within it"),
                expected: "a target that more genotypes meet",
            }))
        })
        .collect()
}

fn cell(space: &SearchSpace, random: &mut Pcg32) -> Cell {
    let operations = space.operations.iter().copied();
    let operations: Vec<_> = operations.filter(|one| *one != Operation::Zero).collect();
    let nodes = (0..space.nodes).map(|node| {
        let first = below(2 + node, random);
        let second = below(1 + node, random);
        // Any of the others.
        let second = second + usize::from(second >= first);
        [first.min(second), first.max(second)].map(|from| Edge {
            operation: operations[below(operations.len(), random)],
            from,
        })
    });
    Cell {
        nodes: nodes.collect(),
    }
}

/// A number from 0 to before `end`; the bias of so few values is nothing.
pub(super) fn below(end: usize, random: &mut Pcg32) -> usize {
    random.next_u32() as usize % end
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn recipe(more: &str) -> SearchRecipe {
        let text = format!(
            "network = \"normal\"\nsteps = 1\nsize = 32\n[normal.architecture]\nmask_channel = false\n\
             [normal.architecture.body]\nkind = \"cells\"\nwidth = 4\nstem_strides = [1, 2]\n\
             upsampling = \"nearest\"\nfused_convolutions = 1\n{more}"
        );
        SearchRecipe::parse("r.toml", &text).unwrap()
    }

    /// Every operation and every pair of inputs about equally often: 400 genotypes of 3 cells.
    #[test]
    fn all_choices_are_equally_likely() {
        let found = random_genotypes(&recipe(""), 400).unwrap();
        assert_eq!(found[..5], random_genotypes(&recipe(""), 5).unwrap());
        let mut operations = BTreeMap::<_, usize>::new();
        let mut pairs = BTreeMap::<_, usize>::new();
        for genotype in &found {
            let normal = genotype.normal.as_ref().unwrap();
            normal.validate().unwrap();
            for cell in normal.cells() {
                for edge in cell.nodes.iter().flatten() {
                    *operations.entry(edge.operation.name()).or_default() += 1;
                }
                let pair = cell.nodes[3].map(|edge| edge.from);
                *pairs.entry(pair).or_default() += 1;
            }
        }
        assert_eq!((operations.len(), pairs.len()), (5, 10));
        // 9600 edges and 1200 pairs: within five deviations of the mean.
        for count in operations.values() {
            assert!(
                (1920.0 - *count as f64).abs() < 5.0 * 39.2,
                "{operations:?}"
            );
        }
        for count in pairs.values() {
            assert!((120.0 - *count as f64).abs() < 5.0 * 10.4, "{pairs:?}");
        }
    }

    #[test]
    fn the_budget_is_kept() {
        let budget = |target: f64| {
            recipe(&format!(
                "[search.budget]\nmeasure = \"parameters\"\ntarget = {target}\nweight = 1.0\n"
            ))
        };
        let costs = Costs::of(&budget(1.0)).unwrap().unwrap();
        let space = SearchSpace::default();
        let cost = |genotype: &Genotypes| {
            let cells = genotype.normal.as_ref().unwrap().cells().map(Clone::clone);
            costs.of_cells(&space, &cells)
        };
        let free = random_genotypes(&recipe(""), 51).unwrap();
        let mut found: Vec<f64> = free.iter().map(cost).collect();
        found.sort_by(f64::total_cmp);
        // Half of the free ones cost more.
        let bound = random_genotypes(&budget(found[25]), 50).unwrap();
        assert!(bound.iter().all(|one| cost(one) <= found[25]));
        assert!(bound.iter().any(|one| cost(one) > found[0]));
        let error = random_genotypes(&budget(1.0), 1).unwrap_err().to_string();
        assert!(error.contains("search.budget.target"), "{error}");
    }
}
