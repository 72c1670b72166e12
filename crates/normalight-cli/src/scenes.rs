//! From a recipe's name or file to a renderer.
use crate::args::LibraryArgs;
use anyhow::{Context, Result};
use normalight_synth::{MeshFolder, Preset, Renderer, SceneRecipe};
use std::path::Path;

/// Share of measured materials when a file of them is given and the recipe asks for none; measured to
/// train well.
const MEASURED_SHARE: f32 = 0.7;
/// Weight of meshes among the other shapes, whose weights sum to about one.
const MESH_WEIGHT: f32 = 0.5;

/// Reads the recipe and the files that it or the user names.
pub(crate) fn renderer(recipe: &str, library: &LibraryArgs) -> Result<Renderer> {
    let mut scene = read(recipe)?;
    if let Some(file) = &library.merl {
        scene.materials.measured_file = Some(file.clone());
        if scene.materials.measured_share == 0.0 {
            scene.materials.measured_share = MEASURED_SHARE;
        }
    }
    if !library.meshes.is_empty() {
        scene.shapes.mesh_folders = library.meshes.iter().map(MeshFolder::new).collect();
        if scene.shapes.mesh == 0.0 {
            scene.shapes.mesh = MESH_WEIGHT;
        }
    }
    Renderer::new(scene).with_context(|| format!("recipe {recipe}"))
}

fn read(recipe: &str) -> Result<SceneRecipe> {
    match recipe {
        "world" => return Ok(Preset::World.recipe()),
        "classic" => return Ok(Preset::Classic.recipe()),
        _ => {}
    }
    let path = Path::new(recipe);
    let text = std::fs::read_to_string(path).with_context(|| {
        format!("recipe {recipe}: neither world nor classic nor a readable file")
    })?;
    Ok(SceneRecipe::from_toml(path, &text)?)
}
