//! DiLiGenT objects with their true lights and normals, for evaluation.
use crate::folder::{self, display, read_file};
use crate::limits::{MAX_FILE_BYTES, MAX_TEXT_BYTES};
use crate::stack::read_text;
use crate::{IoError, StackInput, StackOptions};
use matfile::{MatFile, NumericData};
use normalight_core::{Light, NormalMap, Vec3};
use std::path::{Path, PathBuf};

/// One object of the benchmark.
#[derive(Debug, Clone)]
pub struct DiligentObject {
    /// Its name, without the `PNG` that its folder's name ends with.
    pub name: String,
    /// Images and mask.
    pub input: StackInput,
    /// The true light of each image, intensities per colour channel.
    pub lights: Vec<Light>,
    /// The true normals, zero where unknown.
    pub normals: NormalMap,
}

/// The object folders below a folder: those that its `objects.txt` names, or the folder itself.
///
/// # Errors
/// [`IoError::Read`]; [`IoError::ListedFileMissing`] for an object without a folder;
/// [`IoError::TruthFormat`] for a folder that is neither.
pub fn list_objects(folder: &Path) -> Result<Vec<PathBuf>, IoError> {
    let list = folder.join("objects.txt");
    if !list.is_file() {
        if folder.join("Normal_gt.mat").is_file() {
            return Ok(vec![folder.to_owned()]);
        }
        return Err(IoError::TruthFormat {
            name: display(folder),
            found: "neither".to_owned(),
            expected: "objects.txt (a benchmark) or Normal_gt.mat (an object)".to_owned(),
        });
    }
    let text = read_text(&display(&list), &read_file(&list, MAX_TEXT_BYTES)?)?;
    text.lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .map(|entry| {
            let object = folder.join(entry);
            if object.is_dir() {
                return Ok(object);
            }
            Err(IoError::ListedFileMissing {
                list: display(&list),
                entry: entry.to_owned(),
            })
        })
        .collect()
}

/// Reads an object's folder: images (linear), mask, lights and true normals; `images` keeps only
/// that many, evenly spaced, with their lights.
///
/// # Errors
/// Those of [`folder::read`] and [`folder::read_lights`]; [`IoError::TruthFormat`].
pub fn read_object(folder: &Path, images: Option<usize>) -> Result<DiligentObject, IoError> {
    let options = StackOptions {
        images,
        ..StackOptions::default()
    };
    let input = folder::read(&[folder.to_owned()], options)?;
    let all_lights = folder::read_lights(&folder.join("light_directions.txt"), input.found, &[])?;
    let lights = input
        .picked
        .iter()
        .map(|&index| all_lights[index])
        .collect();
    let truth = folder.join("Normal_gt.mat");
    let (width, height) = (input.stack.width(), input.stack.height());
    let bytes = read_file(&truth, MAX_FILE_BYTES)?;
    let normals = parse_normals(&display(&truth), &bytes, width, height)?;
    let folder_name = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let folder_name = folder_name
        .file_name()
        .unwrap_or_default()
        .to_string_lossy();
    let name = folder_name.strip_suffix("PNG").unwrap_or(&folder_name);
    Ok(DiligentObject {
        name: name.to_owned(),
        input,
        lights,
        normals,
    })
}

/// True normals from a MATLAB file: the variable `Normal_gt`, `[height, width, 3]`.
fn parse_normals(
    name: &str,
    bytes: &[u8],
    width: usize,
    height: usize,
) -> Result<NormalMap, IoError> {
    let wrong = |found: String| IoError::TruthFormat {
        name: name.to_owned(),
        found,
        expected: format!("a variable Normal_gt of {height} x {width} x 3 real numbers"),
    };
    let file = MatFile::parse(bytes).map_err(|_| wrong("no MATLAB 5 file".to_owned()))?;
    let array = file
        .find_by_name("Normal_gt")
        .ok_or_else(|| wrong("no variable of that name".to_owned()))?;
    let values: Vec<f32> = match array.data() {
        NumericData::Double { real, imag: None } => real.iter().map(|&v| v as f32).collect(),
        NumericData::Single { real, imag: None } => real.clone(),
        _ => return Err(wrong("another type of numbers".to_owned())),
    };
    let area = width * height;
    if *array.size() != [height, width, 3] || values.len() != 3 * area {
        return Err(wrong(format!("the size {:?}", array.size())));
    }
    // MATLAB stores columns first.
    let normals = (0..area)
        .map(|pixel| {
            let index = pixel / width + height * (pixel % width);
            Vec3::new(
                values[index],
                values[area + index],
                values[2 * area + index],
            )
        })
        .collect();
    Ok(NormalMap::new(width, height, normals))
}
