//! Recipes as text.

use normalight_synth::{Framing, Preset, Renderer, SceneRecipe, SynthError};
use std::path::Path;

fn parsed(text: &str) -> SceneRecipe {
    SceneRecipe::from_toml(Path::new("recipe.toml"), text).unwrap()
}

fn message(text: &str) -> String {
    let recipe = SceneRecipe::from_toml(Path::new("recipe.toml"), text);
    recipe
        .and_then(Renderer::new)
        .map(|_| ())
        .unwrap_err()
        .to_string()
}

#[test]
fn presets_are_sound_and_survive_writing() {
    for preset in [Preset::World, Preset::Classic] {
        let recipe = preset.recipe();
        assert!(recipe.validate().is_ok());
        let text = toml::to_string(&recipe).unwrap();
        assert_eq!(parsed(&text), recipe);
    }
}

#[test]
fn what_a_file_leaves_out_comes_from_its_preset() {
    assert_eq!(parsed(""), Preset::World.recipe());
    let recipe = parsed("preset = \"classic\"\n[lights]\ncap_degrees = [30.0, 40.0]\n");
    assert_eq!(recipe.lights.cap_degrees, [30.0, 40.0]);
    assert_eq!(recipe.lights.ring, 0.0);
    assert_eq!(recipe.materials, Preset::Classic.recipe().materials);
    // Whole numbers are numbers, too.
    assert_eq!(parsed("[shapes]\nplate = 1\n").shapes.plate, 1.0);
}

#[test]
fn paths_start_at_the_recipe() {
    let text = "[materials]\nmeasured_file = \"merl.npz\"\n";
    let recipe = SceneRecipe::from_toml(Path::new("some/where/recipe.toml"), text).unwrap();
    let expected = Path::new("some/where/merl.npz");
    assert_eq!(recipe.materials.measured_file.unwrap(), expected);
}

#[test]
fn unknown_keys_and_presets_are_named() {
    for (text, expected) in [
        ("[lights]\nazimuth = 3.0\n", "unknown field `azimuth`"),
        ("lamps = 3\n", "unknown field `lamps`"),
        ("preset = \"moon\"\n", "unknown variant `moon`"),
        ("[lights\n", "recipe.toml: "),
        ("[lights]\nring = \"yes\"\n", "invalid type"),
    ] {
        let found = message(text);
        assert!(found.contains(expected), "{found}");
        assert!(found.starts_with("recipe.toml: "), "{found}");
    }
}

#[test]
fn numbers_out_of_range_say_what_is_expected() {
    assert_eq!(
        message("[lights]\ncap_degrees = [50.0, 40.0]\n"),
        "lights.cap_degrees: [50, 40] found, [low, high] with 1 <= low <= high <= 85 degrees \
         expected"
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
    assert_eq!(
        message("[sampling]\ncrops_per_scene = 33\n"),
        "sampling.crops_per_scene: 33 found, 1..=32 expected"
    );
    let shares = "[lights]\nequal_share = 0.8\nmild_share = 0.8\n";
    assert!(message(shares).contains("at most 1 expected"));
    let shares = "[camera]\nlinear_8_bit_share = 0.9\nsrgb_8_bit_share = 0.9\n";
    assert!(message(shares).contains("at most 1 expected"));
}

#[test]
fn a_choice_needs_a_positive_weight() {
    let text = "[lights]\nrectangle = 0.0\ncap = 0.0\nring = 0.0\ndome = 0.0\npath = 0.0\n";
    let error = parsed(text).validate().unwrap_err();
    assert!(matches!(error, SynthError::NoWeight { field: "lights" }));
}

#[test]
fn files_that_are_needed_must_be_named_and_there() {
    assert!(
        message("[materials]\nmeasured_share = 0.5\n")
            .starts_with("materials.measured_file: nothing")
    );
    assert!(message("[shapes]\nmesh = 0.5\n").starts_with("shapes.mesh_folder: nothing"));
    let text = "[materials]\nmeasured_share = 0.5\nmeasured_file = \"none.npz\"\n";
    assert!(message(text).contains("none.npz"));
    let text = "[shapes]\nmesh = 0.5\nmesh_folder = \"no-meshes\"\n";
    assert!(message(text).contains("no-meshes"));
}

#[test]
fn broken_meshes_are_named() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        ("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        let mut recipe = Preset::World.recipe();
        recipe.shapes.mesh = 1.0;
        recipe.shapes.mesh_folder = Some(folder.path().to_owned());
        let error = Renderer::new(recipe).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
        std::fs::remove_file(path).unwrap();
    }
}

/// Each half shows the meshes of its own: the same samples as from a folder that holds no others.
#[test]
fn halves_share_no_mesh() {
    let box_of = |height: f32| {
        let corners = (0..8).map(|corner: usize| {
            let at = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0f32 };
            format!("v {} {} {}\n", at(0), height * at(1), at(2))
        });
        let faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
        corners.collect::<String>() + faces
    };
    let recipe = |folder: &std::path::Path| {
        let mut recipe = Preset::World.recipe();
        // Nothing else, nearly.
        recipe.shapes.mesh = 1e6;
        recipe.shapes.mesh_folder = Some(folder.to_owned());
        recipe
    };
    let both = tempfile::tempdir().unwrap();
    let alone = [1.0, 3.0].map(|height| {
        let folder = tempfile::tempdir().unwrap();
        let name = format!("box{height}.obj");
        for place in [&both, &folder] {
            std::fs::write(place.path().join(&name), box_of(height)).unwrap();
        }
        folder
    });
    let halves = Renderer::halves(recipe(both.path())).unwrap();
    let sample = |renderer: &Renderer| renderer.sample(7, 3, 32, Framing::WholeObject).normals;
    let found = halves.each_ref().map(sample);
    let expected = alone
        .each_ref()
        .map(|folder| sample(&Renderer::new(recipe(folder.path())).unwrap()));
    assert_eq!(found, expected);
    assert_ne!(found[0], found[1]);
    let error = Renderer::halves(recipe(alone[0].path())).err().unwrap();
    assert!(error.to_string().contains("1 found, 2 or more"), "{error}");
}
