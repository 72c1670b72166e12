//! Searches of whole networks, on tiny ones.
use crate::common::{LIGHT, NORMAL, alone, text};
use burn::tensor::Device;
use normalight_model::{LayerKind, Meeting};
use normalight_run::{Caller, RunEvent, RunState};
use normalight_search::{
    Candidate, NetworkBody, NetworkSearchEvent, NetworkSearchRecipe, NetworkSearchResult,
    NetworkSearchRun, RoundPart, search_networks, search_part,
};
use normalight_train::{TrainError, TrainRecipe};
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::path::Path;

fn recipe(text: &str) -> NetworkSearchRecipe {
    NetworkSearchRecipe::parse("recipe.toml", text).unwrap()
}

fn tiny(goal: &str) -> NetworkSearchRecipe {
    let networks = "widths = [8]\nmost_layers = 1\nmost_halvings = 1\npixel_widths = [0, 8]\n";
    recipe(&format!(
        "{NORMAL}steps = 2\nvalidate_every = 2\n[search]\nspace = \"network\"\ngoal = \"{goal}\"\n\
         candidates = 3\nkeep = [2, 1]\ngrowth = 2\n[search.networks]\n{networks}"
    ))
}

fn search(folder: &Path, recipe: &NetworkSearchRecipe) -> NetworkSearchRun {
    NetworkSearchRun {
        recipe: recipe.clone(),
        folder: folder.to_owned(),
        caller: Caller {
            command: "normalight search".to_owned(),
            exit_codes: None,
        },
    }
}

/// Runs a search until the training step of that number.
fn run(
    folder: &Path,
    recipe: &NetworkSearchRecipe,
    stop_after: Option<usize>,
) -> Result<(NetworkSearchResult, usize), TrainError> {
    let run = search(folder, recipe);
    let mut steps = 0;
    let _alone = alone();
    let result = search_networks(&run, &Device::flex(), |event| {
        if let NetworkSearchEvent::Training(RunEvent::Step(_)) = event {
            steps += 1;
            if Some(steps) == stop_after {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    })?;
    Ok((result, steps))
}

#[test]
fn candidates_fill_the_space_and_keep_within_the_bounds() {
    let search = "[search]\nspace = \"network\"\ncandidates = 60\nkeep = []\n";
    let bounds = "multiply_adds = [10_000_000, 200_000_000]\nparameters = [0, 300_000]\n";
    let recipe = recipe(&format!("{NORMAL}steps = 1\n{search}{bounds}"));
    let found = recipe.candidates().unwrap();
    assert_eq!(found, recipe.candidates().unwrap());
    let distinct: HashSet<&Candidate> = found.iter().collect();
    assert_eq!(distinct.len(), 60);
    let mut seen = HashSet::new();
    for candidate in &found {
        let training = candidate.trained_as(&recipe.training).unwrap();
        training.validate().unwrap();
        assert!(training.parameters() <= 300_000);
        let cost = training.network.multiply_adds(10, training.size);
        assert!((10_000_000..=200_000_000).contains(&cost));
        let NetworkBody::Normal(staged) = &candidate.body else {
            panic!("a light network")
        };
        let stages = || staged.down.iter().chain(&staged.up).chain(&staged.fused);
        seen.extend(stages().map(|stage| format!("{:?}", stage.kind)));
        seen.extend(stages().map(|stage| format!("residual {}", stage.residual)));
        seen.insert(format!("{:?} {}", staged.meeting, staged.exchanges));
        seen.insert(format!("halvings {}", staged.down.len() - 1));
        seen.insert(format!("pixels {}", staged.pixels.is_some()));
    }
    for kind in LayerKind::SEARCHED {
        assert!(seen.contains(&format!("{kind:?}")));
    }
    for (meeting, exchanges) in [(Meeting::Max, 0), (Meeting::Max, 1), (Meeting::MaxMean, 0)] {
        assert!(
            seen.contains(&format!("{meeting:?} {exchanges}")),
            "{seen:?}"
        );
    }
    for word in [
        "halvings 1",
        "halvings 2",
        "halvings 3",
        "pixels true",
        "pixels false",
    ] {
        assert!(seen.contains(word), "{word}");
    }
    let lights = self::recipe(&format!("{LIGHT}steps = 1\n{search}"));
    for candidate in lights.candidates().unwrap() {
        candidate
            .trained_as(&lights.training)
            .unwrap()
            .validate()
            .unwrap();
    }
}

#[test]
fn pictures_may_have_other_sizes() {
    let search = "[search]\nspace = \"network\"\ncandidates = 12\nkeep = []\n[search.networks]\n";
    let normals = recipe(&format!("{NORMAL}steps = 1\n{search}sizes = [16, 32]\n"));
    let recipes = normals.candidates().unwrap();
    let recipes = recipes
        .iter()
        .map(|one| one.trained_as(&normals.training).unwrap());
    // As many pixels a batch, of which there must be one picture at least: two of 16 x 16 are half of one of 32 x 32.
    let found: HashSet<(usize, usize)> =
        recipes.map(|recipe| (recipe.size, recipe.batch)).collect();
    assert_eq!(found, HashSet::from([(16, 2), (32, 1)]));
    let lights = recipe(&format!("{LIGHT}steps = 1\n{search}sizes = [64, 96]\n"));
    for candidate in lights.candidates().unwrap() {
        let recipe = candidate.trained_as(&lights.training).unwrap();
        assert_eq!(Some(recipe.size), candidate.size);
        recipe.validate().unwrap();
    }
}

#[test]
fn a_search_goes_on_where_it_was_and_finds_the_same() {
    let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let recipe = tiny("multiply-adds");
    let (expected, steps) = run(whole.path(), &recipe, None).unwrap();
    // Three of two steps, two of four, one of eight.
    assert_eq!(
        (expected.state, steps),
        (RunState::Finished, 3 * 2 + 2 * 4 + 8)
    );
    let counts: Vec<usize> = expected
        .rounds
        .iter()
        .map(|rung| rung.candidates.len())
        .collect();
    assert_eq!(counts, [3, 2, 1]);
    assert!(expected.rounds[1].tau.is_some());
    let mut done = 0;
    let found = loop {
        let (found, more) = run(parts.path(), &recipe, Some(5)).unwrap();
        done += more;
        assert!(done < 100);
        if found.state == RunState::Finished {
            break found;
        }
        assert_eq!(found.state, RunState::Interrupted);
    };
    assert_eq!(errors(&expected), errors(&found));
    assert!(
        errors(&found)
            .iter()
            .all(|(_, degrees, _)| degrees.is_some())
    );
    // What is on the front can be trained.
    let last = &expected.rounds[2].candidates[0];
    let front = whole.path().join(format!("front-{}.toml", last.number));
    let training = TrainRecipe::read(&front).unwrap();
    assert_eq!(training.parameters(), last.parameters);
    assert!(text(whole.path(), "search.json").contains("\"finished\""));
    assert!(expected.to_text().contains("round 3: 8 steps"));
    // Another search does not mix with it.
    let mut other = recipe;
    other.training.seed = 9;
    let error = run(whole.path(), &other, None).unwrap_err().to_string();
    assert!(error.contains("seed"), "{error}");
}

/// Errors and fronts, without times.
fn errors(result: &NetworkSearchResult) -> Vec<(usize, Option<f64>, bool)> {
    let candidates = result.rounds.iter().flat_map(|rung| &rung.candidates);
    candidates
        .map(|one| (one.number, one.degrees, one.on_front))
        .collect()
}

#[test]
fn rounds_may_be_shared_by_several_machines() {
    let (whole, parts) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let recipe = tiny("time");
    let (expected, _) = run(whole.path(), &recipe, None).unwrap();
    let part = |round, index| {
        let _alone = alone();
        let part = RoundPart {
            round,
            index,
            of: 2,
        };
        let run = search(parts.path(), &recipe);
        search_part(&run, part, &Device::flex(), |_| ControlFlow::Continue(()))
    };
    let numbers = |result: &NetworkSearchResult| -> Vec<usize> {
        let candidates = result.rounds.iter().flat_map(|rung| &rung.candidates);
        candidates.map(|one| one.number).collect()
    };
    let refused = |round, index| part(round, index).unwrap_err().to_string();
    assert!(refused(2, 1).contains("waits for part 1 of round 1"));
    assert!(refused(4, 1).contains("round is 4"));
    assert!(refused(1, 3).contains("part is 3"));
    assert_eq!(numbers(&part(1, 2).unwrap()), [2]);
    // Measured times differ from one folder to the other, and with them who is left.
    std::fs::copy(
        whole.path().join("times.json"),
        parts.path().join("times.json"),
    )
    .unwrap();
    assert!(refused(2, 2).ends_with("waits for round 1, network 1, 3"));
    assert_eq!(numbers(&part(1, 1).unwrap()), [1, 3]);
    assert!(refused(3, 1).contains("waits for round 2, network"));
    for (round, index) in [(2, 1), (2, 2), (3, 1), (3, 2)] {
        let found = part(round, index).unwrap();
        assert_eq!(
            (found.state, found.rounds[0].round),
            (RunState::Finished, round)
        );
    }
    let (found, steps) = run(parts.path(), &recipe, None).unwrap();
    assert_eq!((steps, errors(&found)), (0, errors(&expected)));
}

#[test]
fn times_are_measured_once() {
    let place = tempfile::tempdir().unwrap();
    let recipe = tiny("time");
    let (first, _) = run(place.path(), &recipe, None).unwrap();
    let kept = text(place.path(), "times.json");
    let (again, steps) = run(place.path(), &recipe, None).unwrap();
    assert_eq!((steps, kept), (0, text(place.path(), "times.json")));
    assert_eq!(first.rounds, again.rounds);
    let times = first.rounds[0]
        .candidates
        .iter()
        .map(|one| one.milliseconds);
    assert!(times.clone().count() == 3 && times.flatten().all(|ms| ms > 0.0));
}

#[test]
fn recipes_that_make_no_sense_are_named() {
    let refused = |search: &str| {
        let text = format!("{NORMAL}steps = 1\n[search]\nspace = \"network\"\n{search}");
        let parsed = NetworkSearchRecipe::parse("r.toml", &text);
        let error = parsed.and_then(|recipe| recipe.candidates()).unwrap_err();
        error.to_string()
    };
    for (search, word) in [
        ("keep = [24, 3]", "search.keep"),
        ("keep = [8, 0]", "search.keep"),
        ("candidates = 0", "search.candidates"),
        ("multiply_adds = [1, 2]", "search.multiply_adds"),
        ("depth = 3", "depth"),
        ("[search.networks]\nwidths = []", "search.widths"),
        ("[search.networks]\nkinds = [\"round\"]", "round"),
    ] {
        let error = refused(search);
        assert!(error.contains(word), "{search}: {error}");
    }
    let cells = format!("{NORMAL}steps = 1\n[search]\nnodes = 2\n");
    assert!(!NetworkSearchRecipe::is_one("r.toml", &cells).unwrap());
    assert!(NetworkSearchRecipe::parse("r.toml", &cells).is_err());
}
