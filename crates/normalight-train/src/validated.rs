//! Weights files on the unseen objects of a recipe.
use crate::light_task::LightTask;
use crate::normal_task::NormalTask;
use crate::source::Source;
use crate::task::Task;
use crate::{NetworkRecipe, TrainError, TrainRecipe};
use burn::tensor::Device;
use normalight_model::Weights;
use normalight_run::Validation;

/// Errors of each of several networks on the objects that a recipe validates on, as a training by it measures them.
/// `device`: a plain one.
///
/// # Errors
/// [`TrainError::Init`] for weights of another architecture; the files that the recipe names.
pub fn validated(
    recipe: &TrainRecipe,
    several: &[&Weights],
    device: &Device,
) -> Result<Vec<Validation>, TrainError> {
    recipe.validate()?;
    match &recipe.network {
        NetworkRecipe::Light(settings) => of(&LightTask::new(settings), recipe, several, device),
        NetworkRecipe::Normal(settings) => of(&NormalTask::new(settings), recipe, several, device),
    }
}

fn of<T: Task>(
    task: &T,
    recipe: &TrainRecipe,
    several: &[&Weights],
    device: &Device,
) -> Result<Vec<Validation>, TrainError> {
    // What does not fit is said before anything is rendered.
    let networks: Vec<T::Network> = several
        .iter()
        .map(|weights| task.stored(weights, device))
        .collect::<Result<_, _>>()?;
    let source = Source::open(recipe, T::FRAMING)?;
    let pixels = recipe.network.validation_pixels(recipe.size);
    let objects = source.validation_objects(recipe, pixels)?;
    networks
        .iter()
        .map(|network| task.validate(network, &objects, device))
        .collect()
}
