//! Recipes as text.
#![allow(clippy::unwrap_used, reason = "what fails here fails a test")]

use normalight_synth::{Framing, MeshFolder, Preset, Renderer, SceneRecipe, SynthError};
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
    let text = "[materials]\nmeasured_file = \"merl.npz\"\n[shapes]\n\
                mesh_folders = [{ path = \"statues\" }, { path = \"cups.txt\", weight = 2 }]\n\
                validation_meshes = [{ path = \"others\" }]\n";
    let recipe = SceneRecipe::from_toml(Path::new("some/where/recipe.toml"), text).unwrap();
    let expected = Path::new("some/where/merl.npz");
    assert_eq!(recipe.materials.measured_file.unwrap(), expected);
    let mut cups = MeshFolder::new("some/where/cups.txt");
    cups.weight = 2.0;
    let statues = MeshFolder::new("some/where/statues");
    assert_eq!(recipe.shapes.mesh_folders, [statues, cups]);
    let others = MeshFolder::new("some/where/others");
    assert_eq!(recipe.shapes.validation_meshes, [others]);
}

#[test]
fn one_folder_of_meshes_may_be_named_alone() {
    let recipe = parsed("[shapes]\nmesh_folder = \"statues\"\n");
    assert_eq!(recipe.shapes.mesh_folders, [MeshFolder::new("statues")]);
    let both = "[shapes]\nmesh_folder = \"a\"\nmesh_folders = []\n";
    assert!(message(both).contains("one of them expected"));
    let list = "[shapes]\nmesh_folder = [\"a\"]\n";
    assert!(message(list).contains("mesh_folders = [{ path"));
}

#[test]
fn weights_of_folders_are_checked() {
    let folders = |weight: &str| {
        let folder = format!("{{ path = \"a\", weight = {weight} }}");
        message(&format!("[shapes]\nmesh = 1\nmesh_folders = [{folder}]\n"))
    };
    let expected = "shapes.mesh_folders: -1 found, a weight in 0..=1000000 expected";
    assert_eq!(folders("-1"), expected);
    assert!(folders("nan").starts_with("shapes.mesh_folders: NaN found"));
    assert!(folders("0").starts_with("shapes.mesh_folders: all weights are 0"));
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
    assert!(message("[shapes]\nmesh = 0.5\n").starts_with("shapes.mesh_folders: nothing"));
    let text = "[materials]\nmeasured_share = 0.5\nmeasured_file = \"none.npz\"\n";
    assert!(message(text).contains("none.npz"));
    for meshes in [
        "mesh_folder = \"none\"",
        "mesh_folders = [{ path = \"none\" }]",
    ] {
        let text = format!("[shapes]\nmesh = 0.5\n{meshes}\n");
        let found = message(&text);
        assert!(found.contains("none"), "{found}");
    }
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
        recipe.shapes.mesh_folders = vec![MeshFolder::new(folder.path())];
        let error = Renderer::new(recipe).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
        std::fs::remove_file(path).unwrap();
    }
}

/// A box as OBJ, two wide and deep.
fn box_of(height: f32) -> String {
    let corners = (0..8).map(|corner: usize| {
        let at = |bit: usize| if corner >> bit & 1 == 1 { 1.0 } else { -1.0f32 };
        format!("v {} {} {}\n", at(0), height * at(1), at(2))
    });
    let faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    corners.collect::<String>() + faces
}

/// A folder with one box in a folder of its own.
fn folder_of(height: f32) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let deeper = folder.path().join("deeper");
    std::fs::create_dir(&deeper).unwrap();
    std::fs::write(deeper.join(format!("box{height}.obj")), box_of(height)).unwrap();
    folder
}

/// Meshes and nothing else, nearly.
fn recipe_of(folders: &[&Path]) -> SceneRecipe {
    let mut recipe = Preset::World.recipe();
    recipe.shapes.mesh = 1e6;
    recipe.shapes.mesh_folders = folders.iter().map(|f| MeshFolder::new(*f)).collect();
    recipe
}

fn normals(renderer: &Renderer, number: u64) -> Vec<[f32; 3]> {
    let normals = renderer.sample(number, 3, 32, Framing::WholeObject).normals;
    normals.iter().map(|normal| normal.to_array()).collect()
}

/// Each half shows the meshes of its own: the same samples as from a folder that holds no others.
#[test]
fn halves_share_no_mesh() {
    let alone = [1.0, 3.0].map(folder_of);
    let paths = alone.each_ref().map(|folder| folder.path());
    let halves = Renderer::halves(recipe_of(&paths)).unwrap();
    let found = halves.each_ref().map(|half| normals(half, 7));
    let expected = paths.map(|path| normals(&Renderer::new(recipe_of(&[path])).unwrap(), 7));
    assert_eq!(found, expected);
    assert_ne!(found[0], found[1]);
    let error = Renderer::halves(recipe_of(&paths[..1])).err().unwrap();
    assert!(error.to_string().contains("1 found, 2 or more"), "{error}");
}

/// How often either of two boxes is drawn, told by what each looks like alone.
#[test]
fn folders_are_drawn_by_their_weight() {
    let alone = [1.0, 3.0].map(folder_of);
    let paths = alone.each_ref().map(|folder| folder.path());
    let mut recipe = recipe_of(&paths);
    recipe.shapes.mesh_folders[1].weight = 3.0;
    let both = Renderer::new(recipe).unwrap();
    let single = Renderer::new(recipe_of(&paths[..1])).unwrap();
    let first = (0..200).filter(|&k| normals(&both, k) == normals(&single, k));
    // 50 expected, with a deviation of 6.
    let count = first.count();
    assert!((30..70).contains(&count), "{count} of 200");
}

#[test]
fn validation_has_meshes_of_its_own() {
    let folders = [1.0, 3.0].map(folder_of);
    let [ours, others] = folders.each_ref().map(|folder| folder.path());
    let list = ours.join("list.txt");
    std::fs::write(&list, "# boxes\n\ndeeper/box1.obj\n").unwrap();
    let mut recipe = recipe_of(&[&list]);
    let plain = Renderer::new(recipe.clone()).unwrap();
    let validation = plain.validation().unwrap();
    assert_eq!(normals(&validation, 5), normals(&plain, 5));

    recipe.shapes.validation_meshes = vec![MeshFolder::new(others)];
    let renderer = Renderer::new(recipe.clone()).unwrap();
    assert_eq!(normals(&renderer, 5), normals(&plain, 5));
    let validation = renderer.validation().unwrap();
    let expected = Renderer::new(recipe_of(&[others])).unwrap();
    assert_eq!(normals(&validation, 5), normals(&expected, 5));

    // The list names a mesh of the folder.
    recipe.shapes.validation_meshes = vec![MeshFolder::new(ours)];
    let error = Renderer::new(recipe).unwrap().validation().err().unwrap();
    let error = error.to_string();
    assert!(error.starts_with("shapes.validation_meshes: "), "{error}");
    assert!(error.contains("box1.obj found"), "{error}");
}
