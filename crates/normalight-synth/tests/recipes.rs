//! Recipes from text: what is accepted, and what is said about the rest.

use normalight_synth::{SceneRecipe, SynthError};

fn parsed(text: &str) -> SceneRecipe {
    toml::from_str(text).unwrap()
}

#[test]
fn defaults_are_valid_and_survive_toml() {
    let recipe = SceneRecipe::default();
    recipe.validate().unwrap();
    assert_eq!(parsed(""), recipe);
    assert_eq!(parsed(&toml::to_string(&recipe).unwrap()), recipe);
}

#[test]
fn one_key_changes_one_field() {
    let recipe = parsed("[lights]\ncap_degrees = [30.0, 50.0]\n");
    let mut expected = SceneRecipe::default();
    expected.lights.cap_degrees = [30.0, 50.0];
    assert_eq!(recipe, expected);
}

#[test]
fn unknown_keys_are_named() {
    let error = toml::from_str::<SceneRecipe>("[lights]\ncap_degree = 3.0\n").unwrap_err();
    assert!(error.to_string().contains("cap_degree"), "{error}");
    assert!(toml::from_str::<SceneRecipe>("[light]\n").is_err());
}

#[test]
fn errors_name_field_found_and_expected() {
    let message = |text: &str| parsed(text).validate().unwrap_err().to_string();
    assert_eq!(
        message("[materials]\nmetal_share = 1.5\n"),
        "materials.metal_share: 1.5 found, 0..=1 expected"
    );
    assert_eq!(
        message("[materials]\nalbedo = [0.9, 0.1]\n"),
        "materials.albedo: [0.9, 0.1] found, [low, high] with 0 <= low <= high <= 1 expected"
    );
    assert_eq!(
        message("[shapes]\nmax_tilt_degrees = nan\n"),
        "shapes.max_tilt_degrees: NaN found, 0..=60 degrees expected"
    );
    assert_eq!(
        message("[lights]\nring = -1.0\n"),
        "lights.ring: -1 found, a weight in 0..=1000000 expected"
    );
    assert_eq!(
        message("[camera]\nmean = [0.0, 0.5]\n"),
        "camera.mean: [0, 0.5] found, [low, high] with 0.001 <= low <= high <= 1 expected"
    );
}

#[test]
fn a_choice_needs_a_positive_weight() {
    let recipe = parsed("[lights]\nrectangle = 0.0\ncap = 0.0\nring = 0.0\n");
    assert_eq!(
        recipe.validate(),
        Err(SynthError::NoWeight { field: "lights" })
    );
}
