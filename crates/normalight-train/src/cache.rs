//! Rendered scenes in a folder, shared by all runs whose scenes are the same.
use crate::{CacheRecipe, TrainError, TrainRecipe};
use normalight_io::write_files;
use normalight_run::RunError;
use normalight_run::sha256;
use normalight_synth::{Framing, Renderer, Scene};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What a cache says about itself.
const MARK: &str = "cache.json";
/// Changes when stored or rendered scenes do.
const VERSION: u32 = 3;

/// A folder with one file a scene.
pub(crate) struct SceneCache {
    folder: PathBuf,
    scenes: u64,
    lamps: usize,
}

/// What must be the same for scenes to be shared.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Mark {
    version: u32,
    /// SHA-256 of the scene's settings but for the camera, the number of crops and the meshes of validation,
    /// which do not change what is stored.
    scene: String,
    /// Whole objects or crops.
    view: String,
    /// Side of the samples in pixels.
    size: usize,
    /// Lamps of a scene.
    lamps: usize,
}

impl Mark {
    fn new(recipe: &TrainRecipe, framing: Framing) -> Result<Self, TrainError> {
        let mut scene = recipe.scene.clone();
        scene.camera = Default::default();
        scene.sampling.crops_per_scene = 1;
        scene.shapes.validation_meshes.clear();
        let text = toml::to_string(&scene).map_err(|error| {
            TrainError::Run(RunError::Recipe {
                file: "scene".into(),
                reason: error.to_string(),
            })
        })?;
        let most = recipe.images[1];
        let (view, lamps) = match framing {
            Framing::WholeObject => ("whole objects", most),
            Framing::Crop => ("crops", most.max(recipe.scene.sampling.lights_per_scene)),
        };
        Ok(Self {
            version: VERSION,
            scene: sha256(text.as_bytes()),
            view: view.to_owned(),
            size: recipe.size,
            lamps,
        })
    }

    /// In which way another cache differs.
    fn difference(&self, found: &Self) -> Option<String> {
        let differs = |what: &str, found: String, expected: String| {
            (found != expected).then(|| format!("{what} {found}, {expected} expected"))
        };
        let (version, expected) = (found.version.to_string(), self.version.to_string());
        differs("version", version, expected)
            .or_else(|| differs("scenes for", found.view.clone(), self.view.clone()))
            .or_else(|| {
                let (found, expected) = (found.size.to_string(), self.size.to_string());
                differs("size", found, expected)
            })
            .or_else(|| {
                let (found, expected) = (found.lamps.to_string(), self.lamps.to_string());
                differs("lamps", found, expected)
            })
            .or_else(|| {
                let other = "other settings of [scene] than the recipe's".to_owned();
                (found.scene != self.scene).then_some(other)
            })
    }
}

impl SceneCache {
    /// Opens the folder, or begins it.
    ///
    /// # Errors
    /// [`TrainError::Cache`] for a cache of other scenes.
    pub(crate) fn open(
        cache: &CacheRecipe,
        recipe: &TrainRecipe,
        framing: Framing,
    ) -> Result<Self, TrainError> {
        let mark = Mark::new(recipe, framing)?;
        let path = cache.folder.join(MARK);
        let refused = |reason: String| TrainError::Cache {
            path: path.clone(),
            reason,
        };
        if path.exists() {
            let bytes = std::fs::read(&path).map_err(|reason| {
                TrainError::Run(RunError::File {
                    path: path.clone(),
                    reason,
                })
            })?;
            let found: Mark =
                serde_json::from_slice(&bytes).map_err(|error| refused(error.to_string()))?;
            if let Some(difference) = mark.difference(&found) {
                return Err(refused(difference));
            }
        } else {
            let bytes =
                serde_json::to_vec_pretty(&mark).map_err(|error| refused(error.to_string()))?;
            write_files(&cache.folder, &[(MARK, bytes)])?;
        }
        Ok(Self {
            folder: cache.folder.clone(),
            scenes: cache.scenes,
            lamps: mark.lamps,
        })
    }

    /// The scene that stands for scene `number`, for samples of `size` pixels; rendered and kept where
    /// it is not there yet. Several runs may fill a cache at once: what one writes is what any other
    /// would have written.
    pub(crate) fn scene(
        &self,
        renderer: &Renderer,
        number: u64,
        size: usize,
        framing: Framing,
    ) -> Result<Scene, TrainError> {
        let kept = number % self.scenes;
        let name = format!("scene-{kept:08}.safetensors");
        let path = self.folder.join(&name);
        let scene = match std::fs::read(&path) {
            Ok(bytes) => {
                let crop = (framing == Framing::Crop).then_some(size);
                Scene::from_bytes(renderer.recipe(), &path.display().to_string(), &bytes, crop)?
            }
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                let scene = match framing {
                    Framing::WholeObject => renderer.whole_scene(kept, self.lamps, size),
                    Framing::Crop => renderer.crop_scene(kept, self.lamps, size),
                };
                write_files(&self.folder, &[(name, scene.to_bytes()?)])?;
                scene
            }
            Err(reason) => return Err(TrainError::Run(RunError::File { path, reason })),
        };
        Ok(scene.reseeded(number))
    }
}
