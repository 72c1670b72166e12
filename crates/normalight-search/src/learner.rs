use super::bilevel::{Alpha, first_order, second_order};
use super::budget::Costs;
use super::derive::derive;
use super::drawing::{cell_svg, weights_svg};
use super::history::History;
use super::samples::SplitBatch;
use super::{Order, SearchRecipe, SearchTask};
use burn::module::Module;
use burn::tensor::{Device, Tensor};
use normalight_model::{Cell, CellWeights, Genotypes, Operation, SearchSpace};
use normalight_run::{
    Learner, NamedTensors, Optimiser, OptimiserRecipe, StepGradients, StepOutcome, StepsOn,
    Validation, collect, fill, put, scalar, seeded, take,
};
use normalight_synth::Sample;
use normalight_train::{Batch, TrainError, first_scene};

/// Name of the file that holds the cells.
pub(super) const RESULT: &str = "genotype.json";

/// Names of the parts of a checkpoint.
const WEIGHT: &str = "weight";
const ALPHA: &str = "alpha";

/// A relaxed network: its weights learn on one half of the data, its architecture on the other, in turns.
pub(super) struct SearchLearner<'a, T: SearchTask> {
    task: T,
    recipe: &'a SearchRecipe,
    space: SearchSpace,
    /// For validation.
    device: &'a Device,
    /// The same with gradients.
    training: Device,
    network: T::Network,
    /// Which of its parameters are the architecture's.
    alpha: Alpha,
    /// Of the weights.
    weight_optimiser: Optimiser,
    /// Of the architecture.
    alpha_optimiser: Optimiser,
    alpha_recipe: OptimiserRecipe,
    costs: Option<Costs>,
    history: History,
    /// Unseen by both halves.
    objects: Vec<Sample>,
}

impl<'a, T: SearchTask> SearchLearner<'a, T> {
    /// A relaxed network with random weights of the recipe's seed. `device`: a plain one.
    pub(super) fn new(
        task: T,
        recipe: &'a SearchRecipe,
        device: &'a Device,
        steps_on: StepsOn,
    ) -> Result<Self, TrainError> {
        let training = device.clone().autodiff();
        let space = recipe.search.space();
        let costs = Costs::of(recipe)?;
        let network = seeded(&training, recipe.training.seed, || {
            task.relaxed(&space, &training)
        })?;
        let alpha = Alpha::of(&network, T::relaxation(&network));
        Ok(Self {
            task,
            recipe,
            space,
            device,
            training,
            network,
            alpha,
            weight_optimiser: Optimiser::new(steps_on),
            // Few numbers, from gradients in double precision on the host.
            alpha_optimiser: Optimiser::new(StepsOn::Host),
            alpha_recipe: recipe.search.alpha.optimiser(),
            costs,
            history: History::default(),
            objects: Vec::new(),
        })
    }

    /// What it searches for.
    pub(super) fn task(&self) -> &T {
        &self.task
    }

    /// What to validate on.
    pub(super) fn validate_on(&mut self, objects: Vec<Sample>) {
        self.objects = objects;
    }

    /// Number of weights that are trained, those of the architecture included.
    pub(super) fn parameters(&self) -> usize {
        self.network.num_params()
    }

    /// Weight of the auxiliary skip at a step: from the recipe's to zero along a line (Chu et al. 2021).
    fn auxiliary_skip(&self, step: usize) -> f32 {
        let done = step as f32 / self.recipe.training.steps as f32;
        self.recipe.search.auxiliary_skip * (1.0 - done).max(0.0)
    }

    fn loss(&self, network: &T::Network, batch: &Batch) -> Tensor<1> {
        self.task.loss(network, batch, &self.training)
    }

    /// Loss of the architecture and its gradient.
    fn alpha_gradients(&self, batch: &SplitBatch, step: usize) -> (f32, StepGradients) {
        let validation = |network: &T::Network| {
            let loss = self.loss(network, &batch.validation);
            match &self.costs {
                Some(costs) => loss + costs.penalty(T::relaxation(network)),
                None => loss,
            }
        };
        let slope = match self.recipe.search.order {
            Order::First => first_order(&self.network, &self.alpha, validation),
            Order::Second => {
                let training = |network: &T::Network| self.loss(network, &batch.training);
                let rate = f64::from(self.rate(step));
                second_order(&self.network, &self.alpha, rate, training, validation)
            }
        };
        let gradient = slope.gradient.into_iter();
        let gradient = gradient
            .map(|(name, values)| (name, values.iter().map(|&value| value as f32).collect()));
        (
            slope.loss as f32,
            StepGradients::from_values(gradient.collect()),
        )
    }

    /// A step of the architecture, and what it gave.
    fn learn_alpha(&mut self, batch: &SplitBatch, step: usize) -> StepOutcome {
        let (loss, gradients) = self.alpha_gradients(batch, step);
        let learned = StepOutcome {
            loss,
            gradient_norm: gradients.norm(),
        };
        if learned.failure().is_none() {
            let rate = self.alpha_recipe.learning_rate;
            let network = self.network.clone();
            self.network = self
                .alpha_optimiser
                .step(network, gradients, rate, &self.alpha_recipe);
        }
        learned
    }

    fn weights(&self) -> Vec<CellWeights> {
        T::relaxation(&self.network).weights()
    }

    /// The cells as they would be chosen now.
    pub(super) fn cells(&self) -> Vec<Cell> {
        let most_skips = self.recipe.search.most_skips;
        let weights = self.weights();
        let cells = weights
            .iter()
            .map(|weights| derive(&self.space, weights, most_skips));
        cells.collect()
    }

    fn genotypes(&self) -> Genotypes {
        let training = &self.recipe.training;
        let source = format!(
            "search of the {} network, {} steps, seed {}",
            training.network.kind().name(),
            training.steps,
            training.seed
        );
        T::genotypes(source, self.cells())
    }

    /// How far the choice is made, and what it would cost.
    fn figures(&self, validation: &mut Validation) {
        let mut add = |name: &str, value: f32| {
            validation.figures.insert(name.to_owned(), value);
        };
        let weights = self.weights();
        let rows = weights.iter().flat_map(|cell| &cell.operations);
        let entropy = |row: &Vec<f32>| row.iter().map(|&p| -p * p.max(1e-12).ln()).sum::<f32>();
        let most = (self.space.operations.len() as f32).ln().max(1e-6);
        let count = rows.clone().count().max(1) as f32;
        add("entropy", rows.map(entropy).sum::<f32>() / count / most);
        let cells = self.cells();
        let edges = cells.iter().flat_map(|cell| cell.nodes.iter().flatten());
        let skips = edges
            .clone()
            .filter(|edge| edge.operation == Operation::Skip);
        add("skips", skips.count() as f32 / edges.count().max(1) as f32);
        if let Some(costs) = &self.costs {
            let network = self.network.valid();
            add("cost", scalar(costs.expected(T::relaxation(&network))));
        }
    }
}

impl<T: SearchTask> Learner for SearchLearner<'_, T> {
    type Batch = SplitBatch;
    type Error = TrainError;

    const KEEPS_NEWEST: bool = true;

    fn learn(&mut self, batch: &SplitBatch, step: usize) -> Result<StepOutcome, TrainError> {
        let skip = self.auxiliary_skip(step);
        T::relaxation_mut(&mut self.network).set_auxiliary_skip(skip);
        let before = (self.network.clone(), self.alpha_optimiser.clone());
        if step >= self.recipe.search.warm_up {
            let learned = self.learn_alpha(batch, step);
            if learned.failure().is_some() {
                return Ok(learned);
            }
        }
        let loss = self.loss(&self.network, &batch.training);
        let gradients = loss.backward();
        let gradients = self.weight_optimiser.gradients(&self.network, &gradients);
        let gradients = gradients.only(|name| !self.alpha.contains(name));
        let learned = StepOutcome {
            loss: scalar(loss),
            gradient_norm: gradients.norm(),
        };
        if learned.failure().is_some() {
            (self.network, self.alpha_optimiser) = before;
            return Ok(learned);
        }
        let rate = self.rate(step);
        let optimiser = &self.recipe.training.optimiser;
        let network = self.network.clone();
        self.network = self
            .weight_optimiser
            .step(network, gradients, rate, optimiser);
        Ok(learned)
    }

    fn validate(&mut self, step: usize) -> Result<Validation, TrainError> {
        let network = self.network.valid();
        let mut validation = self.task.validate(&network, &self.objects, self.device)?;
        self.figures(&mut validation);
        self.history.add(step, self.weights());
        Ok(validation)
    }

    fn result(&self) -> Result<Option<Vec<u8>>, TrainError> {
        let json = serde_json::to_string_pretty(&self.genotypes());
        // Names and numbers always become JSON.
        Ok(Some((json.unwrap_or_default() + "\n").into_bytes()))
    }

    fn drawings(&self) -> Vec<(String, Vec<u8>)> {
        let csv = self.history.to_csv(&self.space, T::CELLS);
        let mut files = vec![("alpha.csv".to_owned(), csv.into_bytes())];
        let network = self.recipe.training.network.kind().name();
        for (index, (name, cell)) in T::CELLS.iter().zip(self.cells()).enumerate() {
            let title = format!("{network} network, {} cell", name.replace('_', " "));
            files.push((format!("cell-{name}.svg"), cell_svg(&title, &cell)));
            let weights = weights_svg(&title, &self.space, &self.history.of(index));
            files.push((format!("alpha-{name}.svg"), weights));
        }
        files
    }

    fn state(&self) -> NamedTensors {
        let mut state = NamedTensors::new();
        put(&mut state, WEIGHT, collect(&self.network.valid()));
        self.weight_optimiser.save(&mut state);
        let mut alpha = NamedTensors::new();
        self.alpha_optimiser.save(&mut alpha);
        put(&mut state, ALPHA, alpha);
        self.history.save(&mut state);
        state
    }

    fn restore(&mut self, mut state: NamedTensors, step: usize) -> Result<(), String> {
        let mut weights = take(&mut state, WEIGHT);
        self.network = fill(self.network.clone(), &mut weights)?;
        if let Some(name) = weights.keys().next() {
            return Err(format!("weight {name} is of another network"));
        }
        let alpha_steps = step.saturating_sub(self.recipe.search.warm_up);
        self.alpha_optimiser
            .load(&mut take(&mut state, ALPHA), alpha_steps, self.device)?;
        self.weight_optimiser.load(&mut state, step, self.device)?;
        self.history = History::load(&mut state, &self.space, T::CELLS.len())?;
        Ok(())
    }

    fn rate(&self, step: usize) -> f32 {
        self.recipe.training.rate(step)
    }

    fn batch_seed(&self, step: usize) -> u64 {
        first_scene(&self.recipe.training, T::FRAMING, step)
    }
}
