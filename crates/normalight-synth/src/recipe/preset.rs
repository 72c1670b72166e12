use super::{
    CameraRecipe, LightRecipe, MaterialRecipe, SamplingRecipe, SceneRecipe, ShapeRecipe,
    TransportRecipe,
};
use crate::SynthError;
use serde::{Deserialize, Deserializer, Serialize};
use std::path::Path;
use toml::{Table, Value};

/// A distribution known by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// What the published sets contain: smooth blobs and statues of one material, lights within a wide
    /// cap and all of one intensity, cast shadows, an ideal camera.
    Classic,
    /// As people photograph things: all shapes and materials, patterns, bounced light, real cameras.
    #[default]
    World,
}

impl Preset {
    /// The recipe behind the name.
    pub fn recipe(self) -> SceneRecipe {
        match self {
            Self::World => SceneRecipe::default(),
            Self::Classic => classic(),
        }
    }
}

/// After the description of the Blobby and Sculpture sets (Chen, Han & Wong 2018): orthographic views,
/// one measured material per object, lights within about 90 degrees around the viewing axis; shadows
/// and inter-reflections are as their renderer gave them, textures and camera effects absent.
/// `materials.measured_share` is 0 because the measured materials come in a file of the user's.
fn classic() -> SceneRecipe {
    SceneRecipe {
        shapes: ShapeRecipe {
            sphere: 0.0,
            ellipsoid: 0.0,
            blob: 0.5,
            lathe: 0.0,
            statue: 0.5,
            plate: 0.0,
            tumbled_share: 0.7,
            strong_relief_share: 0.4,
            mesh_relief_share: 0.0,
            fine_relief_share: 0.0,
            open_vessel_share: 0.0,
            perspective_share: 0.0,
            ..ShapeRecipe::default()
        },
        materials: MaterialRecipe {
            broad_metal_share: 0.0,
            dark_stone_share: 0.0,
            mixed_share: 0.0,
            textured_share: 0.0,
            rough_texture_share: 0.0,
            brushed_share: 0.0,
            ..MaterialRecipe::default()
        },
        lights: LightRecipe {
            rectangle: 0.0,
            cap: 1.0,
            ring: 0.0,
            dome: 0.0,
            path: 0.0,
            cap_degrees: [85.0, 85.0],
            shift_share: 0.0,
            equal_share: 1.0,
            mild_share: 0.0,
            colour_share: 0.0,
            near_share: 0.0,
            ..LightRecipe::default()
        },
        transport: TransportRecipe {
            cast_shadow_share: 1.0,
            bounce_share: 0.0,
            ambient_share: 0.0,
            ..TransportRecipe::default()
        },
        camera: CameraRecipe {
            clip_share: 0.0,
            noise: [0.0, 0.0],
            linear_8_bit_share: 1.0,
            srgb_8_bit_share: 0.0,
            jpeg_share: 0.0,
            shift_share: 0.0,
            blur_share: 0.0,
            ..CameraRecipe::default()
        },
        sampling: SamplingRecipe::default(),
    }
}

impl SceneRecipe {
    /// Reads a recipe from TOML text; see the type for the format. `file` is named in errors, and paths
    /// in the recipe are taken relative to its folder.
    ///
    /// # Errors
    /// [`SynthError::Recipe`]: not TOML, an unknown key or a value of the wrong type.
    pub fn from_toml(file: &Path, text: &str) -> Result<Self, SynthError> {
        let mut recipe: Self = toml::from_str(text).map_err(|error| SynthError::Recipe {
            file: file.to_owned(),
            message: in_one_line(&error, text),
        })?;
        recipe.resolve_paths(file.parent().unwrap_or(Path::new("")));
        Ok(recipe)
    }

    /// Takes the relative paths in the recipe to start at `folder`.
    pub fn resolve_paths(&mut self, folder: &Path) {
        let shapes = &mut self.shapes;
        let meshes = shapes.mesh_folders.iter_mut();
        let meshes = meshes.chain(&mut shapes.validation_meshes);
        let paths = meshes.map(|meshes| &mut meshes.path);
        for path in paths.chain(&mut self.materials.measured_file) {
            *path = folder.join(&*path);
        }
    }
}

/// Line and kind of a mistake; the line only where it is known.
fn in_one_line(error: &toml::de::Error, text: &str) -> String {
    let message = error.message().replace('\n', " ");
    match error.span() {
        Some(span) if span != (0..text.len()) => {
            let line = 1 + text[..span.start.min(text.len())].matches('\n').count();
            format!("line {line}: {message}")
        }
        _ => message,
    }
}

/// All parts of a recipe as they stand in a file once the preset is filled in.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parts {
    shapes: ShapeRecipe,
    materials: MaterialRecipe,
    lights: LightRecipe,
    transport: TransportRecipe,
    camera: CameraRecipe,
    sampling: SamplingRecipe,
}

impl<'de> Deserialize<'de> for SceneRecipe {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        use serde::de::Error;
        let mut given = Table::deserialize(deserializer)?;
        let preset = match given.remove("preset") {
            Some(name) => Preset::deserialize(name).map_err(D::Error::custom)?,
            None => Preset::default(),
        };
        if let Some(Value::Table(shapes)) = given.get_mut("shapes") {
            one_folder_as_list(shapes).map_err(D::Error::custom)?;
        }
        let mut filled = Table::try_from(preset.recipe()).map_err(D::Error::custom)?;
        overlay(&mut filled, given);
        let parts: Parts = filled.try_into().map_err(D::Error::custom)?;
        Ok(Self {
            shapes: parts.shapes,
            materials: parts.materials,
            lights: parts.lights,
            transport: parts.transport,
            camera: parts.camera,
            sampling: parts.sampling,
        })
    }
}

/// Takes `mesh_folder = "x"`, one folder alone, as the list of one that it is.
fn one_folder_as_list(shapes: &mut Table) -> Result<(), &'static str> {
    let Some(path) = shapes.remove("mesh_folder") else {
        return Ok(());
    };
    if shapes.contains_key("mesh_folders") {
        return Err("mesh_folder beside mesh_folders found, one of them expected");
    }
    if !path.is_str() {
        return Err(
            "mesh_folder: a path expected; several folders are named by \
                    mesh_folders = [{ path = \"x\", weight = 1.0 }]",
        );
    }
    let folder = Table::from_iter([("path".to_owned(), path)]);
    shapes.insert("mesh_folders".to_owned(), vec![Value::Table(folder)].into());
    Ok(())
}

fn overlay(base: &mut Table, given: Table) {
    for (key, value) in given {
        match (base.get_mut(&key), value) {
            (Some(Value::Table(base)), Value::Table(value)) => overlay(base, value),
            (_, value) => {
                base.insert(key, value);
            }
        }
    }
}
