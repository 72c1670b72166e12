//! `model-card.md`: what weights are, where they come from and how good they are.
use crate::{Network, TrainRecipe};
use normalight_run::{Best, Summary};
use std::fmt::Write as _;

/// The card of a finished run. `command`: what started it.
pub fn model_card(recipe: &TrainRecipe, summary: &Summary, command: &str) -> String {
    let (title, what) = match recipe.network.kind() {
        Network::Light => ("Light calibration network", "light directions"),
        Network::Normal => ("Normal estimation network", "normals"),
    };
    let mut card = format!("# {title}\n\n| | |\n| --- | --- |\n");
    let mut row = |name: &str, value: &str| card += &self::row(name, value);
    row("data", &data(recipe));
    row("command", &format!("`{command}`"));
    if let Some(init) = &recipe.init {
        row("started from", &format!("`{}`", init.display()));
    }
    row("seed", &summary.seed.to_string());
    row(
        "steps",
        &format!("{} of {} samples", summary.steps, recipe.batch),
    );
    row("hours", &format!("{:.2}", summary.hours));
    row("parameters", &summary.parameters.to_string());
    row("version", &summary.version);
    let hash = summary.weights_sha256.as_deref().unwrap_or("none");
    row("SHA-256 of the weights", &format!("`{hash}`"));
    if let Some(best) = &summary.best {
        let objects = recipe.validation_objects;
        let _ = write!(
            card,
            "\n## Validation\n\nOn {objects} whole objects that were not trained on, the best of the \
             run, after step {}:\n\n{}",
            best.step,
            figures(best, what)
        );
    }
    let text = recipe.to_toml().unwrap_or_default();
    let _ = write!(card, "\n## Recipe\n\n```toml\n{text}```\n");
    card
}

fn figures(best: &Best, what: &str) -> String {
    let mut table = format!(
        "| measure | value |\n| --- | --- |\n| mean error of the {what} | {:.2} degrees |\n",
        best.degrees
    );
    for (name, value) in &best.figures {
        let _ = match name.as_str() {
            "under_11_25" => writeln!(
                table,
                "| pixels under 11.25 degrees | {:.1} % |",
                100.0 * value
            ),
            "under_22_5" => writeln!(
                table,
                "| pixels under 22.5 degrees | {:.1} % |",
                100.0 * value
            ),
            "under_30" => writeln!(
                table,
                "| pixels under 30 degrees | {:.1} % |",
                100.0 * value
            ),
            "intensity_error" => {
                writeln!(table, "| relative error of the intensities | {value:.4} |")
            }
            other => writeln!(table, "| {other} | {value:.4} |"),
        };
    }
    table
}

/// A line of a card's table.
pub fn row(name: &str, value: &str) -> String {
    format!("| {name} | {} |\n", value.replace('|', "\\|"))
}

/// Where the samples of a recipe come from, in words.
pub fn data(recipe: &TrainRecipe) -> String {
    let [fewest, most] = recipe.images;
    let images = format!("{fewest} to {most} images of {0}x{0} pixels", recipe.size);
    match (&recipe.published, &recipe.cache) {
        (Some(set), _) => format!("`{}`, {images}", set.folder.display()),
        (None, Some(cache)) => format!("{} rendered scenes, {images}", cache.scenes),
        (None, None) => format!("scenes rendered while training, {images}"),
    }
}
