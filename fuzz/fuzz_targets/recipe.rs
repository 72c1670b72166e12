//! Recipes of scenes; those that name no files are checked, too.
#![no_main]
use libfuzzer_sys::fuzz_target;
use normalight_synth::{Renderer, SceneRecipe};
use std::path::Path;

fuzz_target!(|text: &str| {
    let Ok(recipe) = SceneRecipe::from_toml(Path::new("recipe.toml"), text) else {
        return;
    };
    let shapes = &recipe.shapes;
    let no_files = shapes.mesh_folders.is_empty() && shapes.validation_meshes.is_empty();
    if no_files && recipe.materials.measured_file.is_none() {
        let _ = Renderer::new(recipe);
    }
});
