//! One of the two networks as a learner: its weights, their optimiser and their average.
use crate::batch::Batch;
use crate::data_parallel::Replicas;
use crate::samples::first_scene;
use crate::task::Task;
use crate::{Devices, TrainError, TrainRecipe};
use burn::module::Module;
use burn::tensor::Device;
use normalight_model::Weights;
use normalight_run::{
    Average, Learner, NamedTensors, Optimiser, StepOutcome, Validation, collect, fill, put, scalar,
    seeded, take,
};
use normalight_synth::Sample;

/// Name of the file that holds the best weights.
pub const RESULT: &str = "weights.safetensors";

/// Names of the parts of a checkpoint.
const WEIGHT: &str = "weight";
const AVERAGE: &str = "average";

/// A network in training.
pub struct NetworkLearner<'a, T: Task> {
    task: T,
    recipe: &'a TrainRecipe,
    /// For validation.
    device: &'a Device,
    /// The same with gradients.
    training: Device,
    network: T::Network,
    /// Other devices that compute a part of the gradients.
    replicas: Option<Replicas<T>>,
    optimiser: Optimiser,
    average: Option<Average>,
    /// Unseen.
    objects: Vec<Sample>,
}

impl<'a, T: Task> NetworkLearner<'a, T> {
    /// A network with random weights of the recipe's seed. `devices`: plain ones.
    ///
    /// # Errors
    /// An architecture that breaks a rule.
    pub fn new(task: T, recipe: &'a TrainRecipe, devices: Devices<'a>) -> Result<Self, TrainError> {
        let device = devices.main;
        let training = device.clone().autodiff();
        let network = seeded(&training, recipe.seed, || task.network(&training))?;
        let steps_on = devices.steps_on;
        let average = Average::new(recipe.optimiser.average, steps_on, &network.valid());
        let others: Vec<Device> = devices
            .others
            .iter()
            .map(|device| device.clone().autodiff())
            .collect();
        let replicas = (!others.is_empty()).then(|| Replicas::new(&task, &training, &others));
        Ok(Self {
            task,
            recipe,
            device,
            training,
            network,
            replicas,
            optimiser: Optimiser::new(steps_on),
            average,
            objects: Vec::new(),
        })
    }

    /// Replaces the random weights.
    pub fn start_from(&mut self, weights: &Weights) -> Result<(), TrainError> {
        let network = self.network.clone();
        self.network = self.task.start_from(network, weights, self.device)?;
        let decay = self.recipe.optimiser.average;
        self.average = Average::new(decay, self.optimiser.place(), &self.network.valid());
        Ok(())
    }

    /// What to validate on.
    pub fn validate_on(&mut self, objects: Vec<Sample>) {
        self.objects = objects;
    }

    /// The network as it is validated and kept: without gradients, with averaged weights.
    fn eval_network(&self) -> T::Network {
        let network = self.network.valid();
        match &self.average {
            None => network,
            Some(average) => fill(network, &mut average.values())
                .expect("the average holds what the network holds"),
        }
    }
}

impl<T: Task> Learner for NetworkLearner<'_, T> {
    type Batch = Batch;
    type Error = TrainError;

    fn learn(&mut self, batch: &Batch, step: usize) -> Result<StepOutcome, TrainError> {
        let (loss, gradients) = match &mut self.replicas {
            Some(replicas) => replicas.gradients(&self.network, batch),
            None => {
                let loss = self.task.loss(&self.network, batch, &self.training);
                let gradients = loss.backward();
                (scalar(loss), gradients)
            }
        };
        let gradients = self.optimiser.gradients(&self.network, &gradients);
        let learned = StepOutcome {
            loss,
            gradient_norm: gradients.norm(),
        };
        if learned.failure().is_none() {
            let optimiser = &self.recipe.optimiser;
            let network = self.network.clone();
            self.network = self
                .optimiser
                .step(network, gradients, self.rate(step), optimiser);
            if let Some(average) = &mut self.average {
                average.add(step + 1, &self.network.valid());
            }
        }
        Ok(learned)
    }

    fn validate(&mut self, _step: usize) -> Result<Validation, TrainError> {
        self.task
            .validate(&self.eval_network(), &self.objects, self.device)
    }

    fn result(&self) -> Result<Option<Vec<u8>>, TrainError> {
        let bytes = self.task.bytes(&self.eval_network())?;
        // Weights that leave the range of half precision become infinite in the file.
        Ok(Weights::from_bytes(RESULT, &bytes).is_ok().then_some(bytes))
    }

    fn state(&self) -> NamedTensors {
        let mut state = NamedTensors::new();
        put(&mut state, WEIGHT, collect(&self.network.valid()));
        self.optimiser.save(&mut state);
        if let Some(average) = &self.average {
            put(&mut state, AVERAGE, average.values());
        }
        state
    }

    fn restore(&mut self, mut state: NamedTensors, step: usize) -> Result<(), String> {
        let mut weights = take(&mut state, WEIGHT);
        self.network = fill(self.network.clone(), &mut weights)?;
        if let Some(name) = weights.keys().next() {
            return Err(format!("weight {name} is of another network"));
        }
        self.optimiser.load(&mut state, step, self.device)?;
        if let Some(average) = &mut self.average {
            let values = take(&mut state, AVERAGE);
            fill(self.network.valid(), &mut values.clone())
                .map_err(|reason| format!("average: {reason}"))?;
            average.restore(values, self.device);
        }
        Ok(())
    }

    fn rate(&self, step: usize) -> f32 {
        self.recipe.rate(step)
    }

    fn batch_seed(&self, step: usize) -> u64 {
        first_scene(self.recipe, T::FRAMING, step)
    }
}
