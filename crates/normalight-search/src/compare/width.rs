//! Networks of equal cost: their width is what is left to choose.
use super::{Body, Entry};
use normalight_model::{LightArchitecture, LightBody, NormalBody, PlainNormal};
use normalight_run::RunError;
use normalight_train::{NetworkRecipe, TrainError, TrainRecipe};

/// Images of the stack whose cost counts.
const IMAGES: usize = 10;

/// Base width of the plain network that ships.
pub(super) const STANDARD: usize = 16;

/// Widest networks.
const WIDEST: usize = 256;

/// How far a network may miss the target where no width can come closer.
const TOLERANCE: f64 = 0.1;

/// Multiply-adds of a recipe's network for a stack of ten images of the recipe's size.
pub(super) fn multiply_adds(recipe: &TrainRecipe) -> u64 {
    recipe.network.multiply_adds(IMAGES, recipe.size)
}

/// The recipe with a plain network of that base width in place of its cells; inputs and classes stay.
pub(super) fn plain(recipe: &TrainRecipe, width: usize) -> TrainRecipe {
    let mut recipe = recipe.clone();
    let widths = [width, 2 * width, 4 * width];
    match &mut recipe.network {
        NetworkRecipe::Light(settings) => {
            let body = &mut settings.architecture.body;
            *body = LightArchitecture::plain().body;
            if let LightBody::Plain(plain) = body {
                plain.widths = widths;
            }
        }
        NetworkRecipe::Normal(settings) => {
            let plain = PlainNormal::new(widths, 2 * width);
            settings.architecture.body = NormalBody::Plain(plain);
        }
    }
    recipe
}

/// The recipe with the entry's network, as wide as brings its multiply-adds closest to the target.
///
/// # Errors
/// A target that no width can meet; those of [`TrainRecipe::with_cells`].
pub(super) fn fitted(
    recipe: &TrainRecipe,
    entry: &Entry,
    target: u64,
) -> Result<TrainRecipe, TrainError> {
    let candidates: Vec<TrainRecipe> = match &entry.body {
        Body::Plain => (1..=WIDEST).map(|width| plain(recipe, width)).collect(),
        Body::Cells(genotypes) => {
            let recipe = recipe.clone().with_cells(genotypes)?;
            let widths = 4..=WIDEST;
            widths.map(|width| with_width(&recipe, width)).collect()
        }
    };
    let costs: Vec<u64> = candidates.iter().map(multiply_adds).collect();
    let closest = candidates
        .into_iter()
        .zip(&costs)
        .min_by_key(|(_, cost)| cost.abs_diff(target));
    let outside = costs.iter().all(|&cost| cost < target) || costs.iter().all(|&c| c > target);
    match closest {
        Some((recipe, &cost))
            if !outside || cost.abs_diff(target) as f64 <= TOLERANCE * target as f64 =>
        {
            Ok(recipe)
        }
        _ => Err(TrainError::Run(RunError::Recipe {
            file: entry.name.clone(),
            reason: format!(
                "multiply-adds: found {target}, expected {} to {}, from its narrowest network to its widest",
                costs.iter().min().unwrap_or(&0),
                costs.iter().max().unwrap_or(&0)
            ),
        })),
    }
}

/// The same cells of another width.
fn with_width(recipe: &TrainRecipe, width: usize) -> TrainRecipe {
    let mut recipe = recipe.clone();
    if let Some(cells) = recipe.network.cell_width_mut() {
        *cells = width;
    }
    recipe
}

#[cfg(test)]
mod tests {
    use super::*;
    use normalight_model::{NormalArchitecture, paper_genotypes};

    fn recipe(network: &str) -> TrainRecipe {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/recipes");
        let path = std::path::Path::new(folder).join(format!("compare-{network}.toml"));
        TrainRecipe::read_without_cells(&path).unwrap()
    }

    fn paper() -> Entry {
        Entry {
            name: "paper".to_owned(),
            random: false,
            body: Body::Cells(Box::new(paper_genotypes())),
        }
    }

    #[test]
    fn no_other_width_is_closer() {
        for (network, entry) in [
            ("light", paper()),
            ("normal", paper()),
            ("light", Entry::plain()),
            ("normal", Entry::plain()),
        ] {
            let recipe = recipe(network);
            for target in [40_000_000, 77_000_000, 300_000_000] {
                let fitted = fitted(&recipe, &entry, target).unwrap();
                let missed = multiply_adds(&fitted).abs_diff(target);
                let chosen = fitted.network.width();
                let cost = |width: usize| match entry.body {
                    Body::Plain => multiply_adds(&plain(&recipe, width)),
                    Body::Cells(_) => multiply_adds(&with_width(&fitted, width)),
                };
                // Costs grow with the width, so that a closer one would be a neighbour: within half a step.
                let (below, above) = (cost(chosen - 1), cost(chosen + 1));
                assert!(below < above);
                let half = (above - multiply_adds(&fitted)) / 2;
                assert!(
                    missed <= half.max((multiply_adds(&fitted) - below) / 2),
                    "{network} {target}"
                );
                assert!(missed <= below.abs_diff(target) && missed <= above.abs_diff(target));
            }
        }
    }

    /// The network that ships, whose cost is counted by hand in the model's tests.
    #[test]
    fn the_standard_plain_network_is_the_one_that_ships() {
        let recipe = recipe("normal");
        let standard = plain(&recipe, STANDARD);
        let NetworkRecipe::Normal(settings) = &standard.network else {
            panic!("a normal network's recipe");
        };
        assert_eq!(settings.architecture, NormalArchitecture::plain());
        let target = multiply_adds(&standard);
        let fitted = fitted(&recipe, &Entry::plain(), target).unwrap();
        assert_eq!(fitted, standard);
        let light = self::recipe("light");
        let plain = plain(&light, STANDARD);
        let [plain, light] = [&plain, &light].map(|recipe| match &recipe.network {
            NetworkRecipe::Light(settings) => &settings.architecture,
            NetworkRecipe::Normal(_) => panic!("a light network's recipe"),
        });
        assert_eq!(plain.body, LightArchitecture::plain().body);
        assert_eq!(plain.bins, light.bins);
    }

    #[test]
    fn targets_out_of_reach_are_refused() {
        for target in [1, u64::MAX] {
            let error = fitted(&recipe("normal"), &paper(), target).unwrap_err();
            let error = error.to_string();
            let found = format!("found {target}, expected");
            assert!(error.contains(&found), "{error}");
        }
    }
}
