//! The card of a search: `model-card.md`.
use super::{Order, SearchRecipe};
use normalight_run::Summary;
use normalight_train::{data, row};

/// The card of a finished search. `command`: what started it.
pub(super) fn card(recipe: &SearchRecipe, summary: &Summary, command: &str) -> String {
    let (training, search) = (&recipe.training, &recipe.search);
    let mut card = format!(
        "# Cells of the {} network\n\nFound by search; `genotype.json` holds them.\n\n| | |\n| --- | --- |\n",
        training.network.kind().name()
    );
    let operations: Vec<_> = search.operations.iter().map(|one| one.name()).collect();
    let mut cures = Vec::new();
    if search.auxiliary_skip > 0.0 {
        cures.push(format!("auxiliary skip from {}", search.auxiliary_skip));
    }
    if search.channel_divisor > 1 {
        cures.push(format!("one in {} channels", search.channel_divisor));
    }
    if let Some(most) = search.most_skips {
        cures.push(format!("at most {most} skips a cell"));
    }
    if cures.is_empty() {
        cures.push("none".to_owned());
    }
    let order = match search.order {
        Order::First => "first order",
        Order::Second => "second order",
    };
    let steps = format!("{} of twice {} samples", summary.steps, training.batch);
    for (name, value) in [
        ("data", data(training)),
        ("command", format!("`{command}`")),
        ("seed", summary.seed.to_string()),
        ("operations", operations.join(", ")),
        ("nodes of a cell", search.nodes.to_string()),
        ("gradient of the architecture", order.to_owned()),
        ("against skips", cures.join(", ")),
        ("steps", steps),
        ("hours", format!("{:.2}", summary.hours)),
        ("parameters while searching", summary.parameters.to_string()),
        ("version", summary.version.clone()),
        (
            "SHA-256 of the genotype",
            format!("`{}`", summary.weights_sha256.as_deref().unwrap_or("none")),
        ),
    ] {
        card += &row(name, &value);
    }
    let text = recipe.to_toml().unwrap_or_default();
    card + &format!("\n## Recipe\n\n```toml\n{text}```\n")
}
