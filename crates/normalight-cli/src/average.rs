//! `normalight average`.
use crate::args::AverageArgs;
use crate::output_file::place;
use crate::search::named;
use crate::terminal::{note, print};
use crate::{Outcome, device};
use anyhow::Result;
use normalight_model::Weights;
use normalight_train::{TrainRecipe, read_weights, validated};
use serde::Serialize;
use std::path::Path;

/// Cosine between the weights of two networks below which they hardly began as one: those of trainings that went on from one
/// start are above 0.9, those of different random numbers below 0.1.
const CLOSE: f64 = 0.5;

/// Mean errors in degrees on objects that training does not see.
#[derive(Debug, Serialize)]
struct Measured {
    /// Number of objects.
    objects: usize,
    /// Of each network.
    networks: Vec<Network>,
    /// Of the average.
    average: f32,
}

/// One of the networks.
#[derive(Debug, Serialize)]
struct Network {
    weights: String,
    sha256: String,
    degrees: f32,
}

/// Weights in, their mean out, and what each and the mean reach on unseen objects.
pub(crate) fn run(args: &AverageArgs) -> Result<Outcome> {
    let several: Vec<Weights> = args
        .weights
        .iter()
        .map(|path| read_weights(path))
        .collect::<Result<_, _>>()?;
    let bytes = Weights::average(&several)?;
    let (folder, name) = place(&args.out)?;
    let report = args.report.as_deref().map(place).transpose()?;
    let mean = Weights::from_bytes(&args.out.display().to_string(), &bytes)?;
    if !args.quiet {
        tell_strangers(&several)?;
    }
    let measured = match &args.recipe {
        Some(recipe) => Some(measured(args, recipe, &several, &mean)?),
        None => None,
    };
    folder.write(&[(name, bytes)])?;
    let Some(measured) = measured else {
        return Ok(Outcome::Done);
    };
    if let Some((folder, name)) = report {
        let json = serde_json::to_string_pretty(&measured)? + "\n";
        folder.write(&[(name, json)])?;
    }
    if !args.quiet {
        print(&measured.to_text())?;
        if measured
            .networks
            .iter()
            .any(|one| one.degrees <= measured.average)
        {
            note("one of the networks alone is as good as their average, or better");
        }
    }
    Ok(Outcome::Done)
}

fn measured(
    args: &AverageArgs,
    recipe: &Path,
    several: &[Weights],
    mean: &Weights,
) -> Result<Measured> {
    let recipe = named(recipe, TrainRecipe::read(recipe))?;
    let device = device::open(args.device)?.device;
    let all: Vec<&Weights> = several.iter().chain([mean]).collect();
    let errors = validated(&recipe, &all, &device)?;
    let average = errors.last().map_or(f32::NAN, |error| error.degrees);
    let networks = several.iter().zip(errors).map(|(weights, error)| Network {
        weights: weights.name().to_owned(),
        sha256: weights.hash().to_owned(),
        degrees: error.degrees,
    });
    Ok(Measured {
        objects: recipe.validation_objects,
        networks: networks.collect(),
        average,
    })
}

impl Measured {
    fn to_text(&self) -> String {
        let line = |degrees: f32, name: &str| format!("{degrees:8.3} degrees  {name}\n");
        let networks = self.networks.iter();
        let networks: String = networks
            .map(|one| line(one.degrees, &one.weights))
            .collect();
        format!(
            "mean error on {} objects that training does not see:\n{networks}{}",
            self.objects,
            line(self.average, "their average")
        )
    }
}

/// Says which networks did not begin as the first one.
fn tell_strangers(several: &[Weights]) -> Result<()> {
    let Some((first, others)) = several.split_first() else {
        return Ok(());
    };
    for other in others {
        let closeness = first.closeness(other)?;
        if closeness < CLOSE {
            note(&format!(
                "{} and {} were not trained from one start (cosine of their weights {closeness:.2}): \
                 their average is seldom any good",
                first.name(),
                other.name()
            ));
        }
    }
    Ok(())
}
