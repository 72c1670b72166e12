use super::SearchRecipe;
use burn::tensor::Tensor;
use normalight_model::{Cell, CellSite, Operation, Relaxation, SearchSpace, operation_cost};
use normalight_run::check;
use normalight_run::{RunError, read_text};
use normalight_train::{TrainError, TrainRecipe};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Images of the stack whose cost counts.
const IMAGES: usize = 10;

/// What a searched network may cost: the loss grows by `weight` for every hundred percent above the target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// What is counted, over the edges of all cells.
    pub measure: Measure,
    /// How much of it, for a stack of ten images of the recipe's size.
    pub target: f64,
    /// Strength of the pull below the target.
    pub weight: f32,
    /// Table of times, where time is what counts: from `normalight bench ops`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub times: Option<PathBuf>,
}

/// What a cost is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Trainable parameters.
    Parameters,
    /// Multiply-adds.
    MultiplyAdds,
    /// Milliseconds of a forward pass, from a table.
    Time,
    /// Milliseconds of a forward and a backward pass, from a table.
    TrainingTime,
}

/// How long every operation takes on one device; the file that `normalight bench ops` writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OperationTimes {
    /// What was measured.
    pub device: String,
    /// Threads of it.
    pub threads: usize,
    /// All cases.
    pub times: Vec<OperationTime>,
}

/// How long one operation takes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OperationTime {
    /// The operation.
    pub operation: Operation,
    /// Channels in and out.
    pub width: usize,
    /// Pixels of its output.
    pub area: usize,
    /// 2 where it halves the size.
    pub stride: usize,
    /// Milliseconds for one image.
    pub forward_ms: f64,
    /// Milliseconds for one image, forward and backward.
    pub training_ms: f64,
}

impl Budget {
    pub(super) fn validate(&self) -> Result<(), TrainError> {
        let field = "search.budget.target";
        check(field, self.target, 1e-9..=1e15, "above 0")?;
        check("search.budget.weight", self.weight, 0.0..=1e3, "0 to 1000")?;
        let timed = matches!(self.measure, Measure::Time | Measure::TrainingTime);
        if timed && self.times.is_none() {
            return Err(TrainError::Run(RunError::Value {
                field: "search.budget.times",
                found: "nothing".into(),
                expected: "the file of times that `normalight bench ops` writes",
            }));
        }
        Ok(())
    }
}

impl OperationTimes {
    /// Reads a file of times.
    ///
    /// # Errors
    /// [`RunError::File`], or [`RunError::Recipe`] for other contents.
    pub fn read(path: &Path) -> Result<Self, TrainError> {
        let text = read_text(path)?;
        let failed = |reason: String| {
            TrainError::Run(RunError::Recipe {
                file: path.display().to_string(),
                reason,
            })
        };
        let times: Self = serde_json::from_str(&text).map_err(|error| failed(error.to_string()))?;
        for one in &times.times {
            let good = |ms: f64| ms.is_finite() && ms >= 0.0;
            if !good(one.forward_ms) || !good(one.training_ms) {
                let reason = format!("{one:?} is no time, 0 ms or more expected");
                return Err(failed(reason));
            }
        }
        Ok(times)
    }
}

/// A budget and what everything costs by its measure.
pub(super) struct Costs {
    budget: Budget,
    /// `[cells][edges][operations]`: the sum over the places where a cell of the genotype stands.
    table: Vec<Vec<Vec<f32>>>,
}

impl Costs {
    /// Of a recipe that has a budget.
    ///
    /// # Errors
    /// The file of times; a time that it lacks.
    pub(super) fn of(recipe: &SearchRecipe) -> Result<Option<Self>, TrainError> {
        let Some(budget) = &recipe.search.budget else {
            return Ok(None);
        };
        let table = edge_costs(budget, &recipe.training, &recipe.search.space())?;
        Ok(Some(Self {
            budget: budget.clone(),
            table,
        }))
    }

    /// What chosen cells cost.
    pub(super) fn of_cells(&self, space: &SearchSpace, cells: &[Cell]) -> f64 {
        let mut sum = 0.0;
        for (cell, table) in cells.iter().zip(&self.table) {
            for ((node, from), costs) in space.edges().zip(table) {
                let chosen = cell.nodes[node].iter().filter(|edge| edge.from == from);
                for edge in chosen {
                    let mut operations = space.operations.iter();
                    let column = operations.position(|one| *one == edge.operation);
                    sum += column.map_or(0.0, |column| f64::from(costs[column]));
                }
            }
        }
        sum
    }

    /// Whether chosen cells keep within the budget.
    pub(super) fn admit(&self, space: &SearchSpace, cells: &[Cell]) -> bool {
        self.of_cells(space, cells) <= self.budget.target
    }

    /// Expected cost of what will be derived, relative to the target: `[1]`, differentiable.
    pub(super) fn expected(&self, relaxation: &Relaxation) -> Tensor<1> {
        relaxation.expected_cost(&self.table) / self.budget.target
    }

    /// What the budget adds to the loss: `[1]`, differentiable.
    pub(super) fn penalty(&self, relaxation: &Relaxation) -> Tensor<1> {
        (self.expected(relaxation) - 1.0).clamp_min(0.0) * self.budget.weight
    }
}

fn edge_costs(
    budget: &Budget,
    recipe: &TrainRecipe,
    space: &SearchSpace,
) -> Result<Vec<Vec<Vec<f32>>>, TrainError> {
    let times = budget
        .times
        .as_deref()
        .map(OperationTimes::read)
        .transpose()?;
    let places = recipe.network.cell_sites(recipe.size);
    let cells = 1 + places.iter().map(|place| place.cell).max().unwrap_or(0);
    let mut costs = vec![vec![vec![0.0; space.operations.len()]; space.edges().count()]; cells];
    for place in &places {
        let stacks = if place.per_image { IMAGES } else { 1 } as f64;
        for ((_, from), edge) in space.edges().zip(&mut costs[place.cell]) {
            for (&operation, sum) in space.operations.iter().zip(edge) {
                let cost = operation_cost(operation, place, from);
                *sum += match budget.measure {
                    Measure::Parameters => cost.parameters as f64,
                    Measure::MultiplyAdds => cost.multiply_adds as f64 * stacks,
                    Measure::Time => {
                        time(budget, &times, operation, place, from)?.forward_ms * stacks
                    }
                    Measure::TrainingTime => {
                        time(budget, &times, operation, place, from)?.training_ms * stacks
                    }
                } as f32;
            }
        }
    }
    Ok(costs)
}

fn time(
    budget: &Budget,
    times: &Option<OperationTimes>,
    operation: Operation,
    place: &CellSite,
    from: usize,
) -> Result<OperationTime, TrainError> {
    let stride = if place.reduces && from < 2 { 2 } else { 1 };
    let (width, area) = (place.width, place.area);
    if operation == Operation::Zero {
        return Ok(OperationTime {
            operation,
            width,
            area,
            stride,
            forward_ms: 0.0,
            training_ms: 0.0,
        });
    }
    let found = times.iter().flat_map(|times| &times.times).find(|one| {
        (one.operation, one.width, one.area, one.stride) == (operation, width, area, stride)
    });
    found.copied().ok_or_else(|| TrainError::Run(RunError::Recipe {
        file: budget
            .times
            .as_deref()
            .unwrap_or(Path::new(""))
            .display()
            .to_string(),
        reason: format!(
            "no time of {} with {width} channels, {area} pixels and stride {stride}; measure it by \
             `normalight bench ops --recipe` with this recipe",
            operation.name()
        ),
    }))
}
