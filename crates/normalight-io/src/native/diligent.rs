//! DiLiGenT objects with their true lights and normals, for evaluation.
use super::files::{display, file_name, read_error, read_file};
use super::read::read_paths;
use crate::limits::{MAX_FILE_BYTES, MAX_TEXT_BYTES};
use crate::text::read_text;
use crate::truth::read_truth;
use crate::{ColorMode, IoError, ReadOptions, StackInput, Truth};
use normalight_core::{Light, NormalMap};
use std::path::{Path, PathBuf};

/// The file of an object's true normals in DiLiGenT.
const TRUTH: &str = "Normal_gt.mat";

/// That of LUCES; elsewhere a map of this name is anybody's result, but not beside photographs, a mask and nothing else.
const LUCES_TRUTH: &str = "normals.png";

/// True directions of the lights.
const DIRECTIONS: &str = "light_directions.txt";

/// One object of the benchmark.
#[derive(Debug, Clone)]
pub struct DiligentObject {
    /// Its name, without the `PNG` that its folder's name ends with.
    pub name: String,
    /// Images and mask.
    pub input: StackInput,
    /// The true light of each image, intensities per colour channel; `None` where they are withheld, or lamps stood so near
    /// that they have no one direction.
    pub lights: Option<Vec<Light>>,
    /// The true normals, zero where unknown; `None` where they are withheld.
    pub normals: Option<NormalMap>,
    /// The file of the true normals.
    pub normals_file: Option<String>,
}

/// The object folders of a benchmark folder: those that its `objects.txt` names, whether they exist
/// or not; without such a list all object folders in it, by name; or the folder itself when it is
/// one.
///
/// # Errors
/// [`IoError::Read`]; [`IoError::TruthFormat`] for a folder that is nothing of this.
pub fn list_diligent_objects(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let list = folder.join("objects.txt");
    let objects = if list.is_file() {
        let text = read_text(&display(&list), &read_file(&list, MAX_TEXT_BYTES)?)?;
        let entries = text.lines().map(str::trim).filter(|line| !line.is_empty());
        entries.map(|entry| folder.join(entry)).collect()
    } else if is_object(folder) {
        vec![folder.to_owned()]
    } else {
        objects_in(folder)?
    };
    if objects.is_empty() {
        return Err(IoError::TruthFormat {
            name: display(folder),
            found: "no object".to_owned(),
            expected: "objects.txt (a benchmark), folders of objects, or Normal_gt.mat or light_directions.txt (an object)"
                    .to_owned(),
        });
    }
    Ok(objects)
}

fn is_object(folder: &Path) -> bool {
    let has = |name: &str| folder.join(name).is_file();
    has(TRUTH) || has(DIRECTIONS) || (has(LUCES_TRUTH) && has("mask.png"))
}

fn objects_in(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let failed = |reason| read_error(folder, reason);
    let mut objects = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if is_object(&path) {
            objects.push(path);
        }
    }
    objects.sort();
    Ok(objects)
}

/// Reads an object's folder: images (linear), mask, and what there is of lights and true normals; `images` keeps only that
/// many, spread over them, with their lights.
///
/// Lights are those of `light_directions.txt` and `light_intensities.txt`. True normals are `Normal_gt.mat`; without it a
/// picture or array that says that it is the truth; without one `normals.png` as LUCES has it.
///
/// # Errors
/// Those of [`read_paths`] and [`read_lights_path`](super::read_lights_path); [`IoError::Read`] for directions without
/// intensities; [`IoError::TruthFormat`].
pub fn read_diligent_object(
    folder: &Path,
    images: Option<usize>,
) -> Result<DiligentObject, IoError> {
    let options = ReadOptions {
        images,
        color: ColorMode::Linear,
        ..ReadOptions::default()
    };
    let mut input = read_paths(&[folder.to_owned()], &options)?;
    let directions = folder.join(DIRECTIONS);
    let lights = if directions.is_file() {
        // Without their intensities the lights are no truth.
        let intensities = folder.join("light_intensities.txt");
        std::fs::metadata(&intensities).map_err(|reason| read_error(&intensities, reason))?;
        Some(input.read_lights_path(&directions)?)
    } else {
        None
    };
    let size = (input.stack.width(), input.stack.height());
    // What is there and wrong was only a notice beside photographs.
    let read = |name: &str| -> Result<Option<Truth>, IoError> {
        let path = folder.join(name);
        if !path.is_file() {
            return Ok(None);
        }
        let bytes = read_file(&path, MAX_FILE_BYTES)?;
        Ok(Some(Truth {
            file: name.to_owned(),
            normals: read_truth(&display(&path), &bytes, size)?,
        }))
    };
    let said = input.truth.take();
    let found = match said {
        Some(truth) if truth.file == TRUTH => Some(truth),
        // A damaged one is an error, not a reason to take another.
        said => match (read(TRUTH)?, said) {
            (None, None) => read(LUCES_TRUTH)?,
            (truth, said) => truth.or(said),
        },
    };
    let (normals_file, normals) = found.map(|truth| (truth.file, truth.normals)).unzip();
    let folder_name = file_name(&folder.canonicalize().unwrap_or_else(|_| folder.to_owned()));
    let name = folder_name.strip_suffix("PNG").unwrap_or(&folder_name);
    Ok(DiligentObject {
        name: name.to_owned(),
        input,
        lights,
        normals,
        normals_file,
    })
}
