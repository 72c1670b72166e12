//! Searches from recipe to genotype, on tiny relaxed networks.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]
/// Tiny trainings, as the training's own tests have them.
#[path = "../../normalight-train/tests/common/mod.rs"]
mod common;
#[path = "search/networks.rs"]
mod networks;

use burn::tensor::Device;
use common::{LIGHT, NORMAL, alone, contents, text, whole};
use normalight_model::Genotypes;
use normalight_run::{Caller, RunEvent, RunState, StepsOn, Summary};
use normalight_search::{SearchRecipe, SearchRun, derive_again, search};
use normalight_train::{TrainError, TrainRecipe};
use std::ops::ControlFlow;
use std::path::Path;

const NORMAL_CELLS: &str = "[normal.architecture]\nmask_channel = false\n\
    [normal.architecture.body]\nkind = \"cells\"\nwidth = 4\nstem_strides = [1, 2]\nreductions = 1\n\
    upsampling = \"nearest\"\nfused_convolutions = 1\n";
const LIGHT_CELLS: &str = "[light.architecture]\ninput_size = 64\n\
    bins = { azimuth = 36, elevation = 36, intensity = { count = 20, low = 0.2, high = 2.0, \
    spacing = \"linear\" } }\n\
    [light.architecture.body]\nkind = \"cells\"\nwidth = 4\nstem_strides = [2, 2]\nreductions = 1\n\
    hidden = 8\n";

fn recipe(text: &str) -> SearchRecipe {
    SearchRecipe::parse("recipe.toml", text).unwrap()
}

fn run(
    folder: &Path,
    recipe: &SearchRecipe,
    resume: bool,
    stop_at: Option<usize>,
) -> Result<(Summary, Vec<f32>), TrainError> {
    let run = SearchRun {
        recipe: recipe.clone(),
        folder: folder.to_owned(),
        resume,
        steps_on: StepsOn::Host,
        caller: Caller {
            command: "normalight search".to_owned(),
            exit_codes: None,
        },
    };
    let mut losses = Vec::new();
    let _alone = alone();
    let summary = search(&run, &Device::flex(), |event| match event {
        RunEvent::Step(report) => {
            losses.push(report.loss);
            match stop_at {
                Some(step) if step == report.step => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        }
        RunEvent::Note(_) => ControlFlow::Continue(()),
    })?;
    Ok((summary, losses))
}

/// Every switch at least once.
fn kinds() -> Vec<(&'static str, String)> {
    let steps = "steps = 6\nvalidate_every = 3\n";
    let two = "[search]\nnodes = 2\nwarm_up = 2\n";
    vec![
        ("default", format!("{NORMAL}{steps}{NORMAL_CELLS}{two}")),
        (
            "Muon",
            format!(
                "{NORMAL}{steps}{NORMAL_CELLS}{two}[optimiser]\nkind = \"muon\"\n\
                 muon = {{ depthwise = \"filters\" }}\n"
            ),
        ),
        (
            "partial channels",
            format!(
                "{NORMAL}{steps}{NORMAL_CELLS}{two}channel_divisor = 2\nauxiliary_skip = 0.0\nmost_skips = 1\n"
            ),
        ),
        (
            "second order",
            format!("{NORMAL}{steps}{NORMAL_CELLS}{two}order = \"second\"\n"),
        ),
        ("light", format!("{LIGHT}{steps}{LIGHT_CELLS}{two}")),
    ]
}

#[test]
fn a_resumed_search_finds_the_same_cells() {
    for (name, text_of) in kinds() {
        let recipe = recipe(&text_of);
        let (straight, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let (summary, all) = run(straight.path(), &recipe, false, None).unwrap();
        assert_eq!(
            (summary.state, all.len()),
            (RunState::Finished, 6),
            "{name}"
        );
        let (first, before) = run(broken.path(), &recipe, false, Some(5)).unwrap();
        assert_eq!(first.state, RunState::Interrupted);
        let (second, after) = run(broken.path(), &recipe, true, None).unwrap();
        assert_eq!([before, after].concat(), all, "{name}");
        assert_eq!(second.best, summary.best, "{name}");
        let (straight, broken) = (contents(straight.path()), contents(broken.path()));
        for file in [
            "genotype.json",
            "alpha.csv",
            "cell-feature_normal.svg",
            "alpha-feature_reduction.svg",
        ] {
            assert!(straight[file] == broken[file], "{name}: {file}");
        }
        let json = std::str::from_utf8(&broken["genotype.json"]).unwrap();
        let found = Genotypes::from_json("genotype.json", json).unwrap();
        let cells = match (&found.light, &found.normal) {
            (Some(light), None) => light.cells().to_vec(),
            (None, Some(normal)) => normal.cells().to_vec(),
            other => panic!("{other:?}"),
        };
        for cell in cells {
            assert_eq!(cell.nodes.len(), 2);
            let edges = cell.nodes.iter().flatten();
            let skips = edges.filter(|edge| edge.operation.name() == "skip").count();
            assert!(recipe.search.most_skips.is_none_or(|most| skips <= most));
        }
    }
}

/// A cap only decides what is chosen: choosing again gives what a search with that cap finds.
#[test]
fn cells_can_be_chosen_again_with_another_cap() {
    let place = tempfile::tempdir().unwrap();
    let free = recipe(&kinds()[0].1);
    let mut capped = free.clone();
    capped.search.most_skips = Some(0);
    for (name, recipe) in [("free", &free), ("capped", &capped)] {
        run(&place.path().join(name), recipe, false, None).unwrap();
    }
    let device = Device::flex();
    let again = derive_again(&place.path().join("free"), Some(0), &device).unwrap();
    let expected = contents(&place.path().join("capped"));
    assert_eq!(again.len(), 1 + 1 + 2 * 3);
    for (name, content) in again {
        assert!(expected[&name] == content, "{name}");
    }
    let genotype = text(&place.path().join("capped"), "genotype.json");
    assert!(!genotype.contains("skip"), "{genotype}");
    assert!(derive_again(&place.path().join("gone"), None, &device).is_err());
}

#[test]
fn training_takes_the_genotype_as_it_is() {
    let place = tempfile::tempdir().unwrap();
    let searched = place.path().join("search");
    run(&searched, &recipe(&kinds()[0].1), false, None).unwrap();
    let file = searched.join("genotype.json");
    let body = format!("{NORMAL_CELLS}genotype = {:?}\n", file.to_str().unwrap());
    let training = TrainRecipe::parse("t.toml", &format!("{NORMAL}steps = 2\n{body}")).unwrap();
    let ran = whole(&place.path().join("train"), &training);
    assert_eq!(ran.summary.state, RunState::Finished);
    // A light network cannot be made of it.
    let body = format!("{LIGHT_CELLS}genotype = {:?}\n", file.to_str().unwrap());
    let error = TrainRecipe::parse("t.toml", &format!("{LIGHT}steps = 2\n{body}")).unwrap_err();
    assert!(
        error.to_string().contains("no cells of a light network"),
        "{error}"
    );
}

/// A strong pull towards half of the first cost brings the expected cost down; without one it stays.
#[test]
fn a_budget_is_approached() {
    let cost = |weight: f32| -> Vec<f32> {
        let text_of = format!(
            "{NORMAL}steps = 12\nvalidate_every = 6\n{NORMAL_CELLS}[search]\nnodes = 2\n\
             [search.alpha]\nlearning_rate = 0.05\n\
             [search.budget]\nmeasure = \"multiply_adds\"\ntarget = 100000\nweight = {weight}\n"
        );
        let folder = tempfile::tempdir().unwrap();
        run(folder.path(), &recipe(&text_of), false, None).unwrap();
        let curves = text(folder.path(), "curves.csv");
        let mut lines = curves.lines();
        let column = lines
            .next()
            .unwrap()
            .split(',')
            .position(|name| name == "cost")
            .unwrap();
        let values = lines.map(|line| line.split(',').nth(column).unwrap().parse().unwrap());
        values.collect()
    };
    let (free, bound) = (cost(0.0), cost(100.0));
    assert!(bound[0] > 1.0, "{bound:?}");
    assert!(bound[1] < 0.9 * bound[0], "{bound:?}");
    assert!(bound[1] < 0.9 * free[1], "{bound:?}, {free:?}");
}

#[test]
fn recipes_come_back_and_bad_ones_are_refused() {
    for (_, text_of) in kinds() {
        let once = recipe(&text_of);
        let written = once.to_toml().unwrap();
        assert!(!written.contains("genotype"), "{written}");
        assert_eq!(recipe(&written), once);
    }
    let good = format!("{NORMAL}steps = 6\n{NORMAL_CELLS}");
    for (more, part) in [
        ("[search]\nnode = 3\n", "unknown field `node`"),
        ("[search]\nnodes = 0\n", "nodes: found 0, expected 1 to 16"),
        (
            "[search]\noperations = [\"pool\"]\n",
            "unknown variant `pool`",
        ),
        ("[search]\noperations = [\"zero\"]\n", "one besides zero"),
        ("[search]\noperations = [\"skip\", \"skip\"]\n", "each once"),
        (
            "[search]\noperations = [\"separable_3x3\"]\n",
            "0 where skip is not among the operations",
        ),
        ("[search]\nwarm_up = 7\n", "search.warm_up is 7"),
        (
            "[search]\nchannel_divisor = 3\n",
            "a multiple of search.channel_divisor",
        ),
        ("[search]\nauxiliary_skip = nan\n", "auxiliary_skip is NaN"),
        (
            "[search.budget]\nmeasure = \"time\"\ntarget = 3\nweight = 1\n",
            "search.budget.times",
        ),
        (
            "[cache]\nfolder = \"c\"\nscenes = 9\n",
            "both halves of a search would show the same shapes",
        ),
    ] {
        let error = SearchRecipe::parse("r.toml", &format!("{good}{more}")).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
    }
    let plain = SearchRecipe::parse("r.toml", &format!("{NORMAL}steps = 6\n")).unwrap_err();
    assert!(
        plain.to_string().contains("cells, to search them"),
        "{plain}"
    );
    // A table of times without the times that are needed: nothing is begun.
    let place = tempfile::tempdir().unwrap();
    let times = place.path().join("times.json");
    std::fs::write(&times, "{\"device\": \"x\", \"threads\": 1, \"times\": []}").unwrap();
    let budget = format!(
        "{good}[search.budget]\nmeasure = \"time\"\ntarget = 3\nweight = 1\ntimes = {:?}\n",
        times.to_str().unwrap()
    );
    let folder = place.path().join("run");
    let error = run(&folder, &recipe(&budget), false, None).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("times.json") && message.contains("separable_1x1 with 4"),
        "{message}"
    );
    assert!(!folder.exists());
}
