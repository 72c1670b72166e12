use super::below::{entries, one_in_each};
use super::disk::DiskFiles;
use super::files::{display, file_name, read_error, read_file};
use super::inside::read_folder_inside;
use crate::archive::{ArchiveKind, HEAD};
use crate::format::{READ_FORMATS, format_of_extension, is_image_content, not_an_image};
use crate::light_file::GivenLights;
use crate::light_file::LightFile;
use crate::limits::MAX_TEXT_BYTES;
use crate::source::{FileSource, read_files};
use crate::{IoError, LightAxes, Notice, ReadOptions, StackInput};
use normalight_core::Light;
use std::fs;
use std::path::{Path, PathBuf};

/// Reads a stack: one folder, one archive, or several files. One file is in memory at a time (all
/// of a tar.gz archive), and only the picked images are read.
///
/// In a folder, files that are no images are ignored and a list or a mask counts, see
/// [`plan_stack`](crate::plan_stack). A file that is given must be an image or an archive; what an archive is and what
/// of it counts, [`read_stack`](crate::read_stack) says. A path may lead to a folder in an archive:
/// `capture.zip/photos`.
///
/// # Errors
/// Those of [`read_stack`](crate::read_stack), [`IoError::Read`], and [`IoError::NotAnImage`] for a
/// given file that is neither image nor archive.
pub fn read_paths(paths: &[PathBuf], options: &ReadOptions) -> Result<StackInput, IoError> {
    if let [path] = paths {
        if path.is_dir() {
            return read_folder(path, options);
        }
        if !path.exists()
            && let Some(input) = read_folder_inside(path, options)
        {
            return input;
        }
    }
    for path in paths {
        fs::metadata(path).map_err(|reason| read_error(path, reason))?;
        if path.is_dir() {
            return Err(IoError::NotAnImage {
                name: display(path),
                found: "a folder among several paths".to_owned(),
                expected: READ_FORMATS,
            });
        }
    }
    let mut files = DiskFiles::new(paths.to_vec(), options.limits);
    for (index, path) in paths.iter().enumerate() {
        let name = display(path);
        let head = files.head(index, HEAD)?;
        // The name of an archive promises enough: what is wrong with it is said when it is opened.
        let is_known = format_of_extension(&name).is_some()
            || ArchiveKind::of_extension(&name).is_some()
            || is_image_content(&name, &head)
            || ArchiveKind::of_content(&head).is_some();
        if !is_known {
            return Err(not_an_image(&name));
        }
    }
    read_files(Some("the given files"), Box::new(files), options)
}

fn read_folder(folder: &Path, options: &ReadOptions) -> Result<StackInput, IoError> {
    let failed = |reason| read_error(folder, reason);
    let (files, folders) = entries(folder).map_err(failed)?;
    options.limits.check_files(&display(folder), files.len())?;
    let below = one_in_each(&files, &folders).map_err(failed)?;
    let is_below = below.is_some();
    let mut paths = below.unwrap_or(files);
    // The system hands names out in any order.
    paths.sort();
    let files = DiskFiles::of_folder(folder.to_owned(), paths, options.limits);
    let mut input = read_files(Some(&display(folder)), Box::new(files), options)?;
    if is_below {
        input.plan.notices.insert(0, Notice::OneInEachFolder);
    }
    Ok(input)
}

/// Reads a light file, see [`read_lights`](crate::read_lights); `light_directions.txt` is completed
/// by `light_intensities.txt` beside it when there is one.
///
/// # Errors
/// [`IoError::Read`] and those of [`read_lights`](crate::read_lights).
pub fn read_lights_path(path: &Path, file_names: &[String]) -> Result<Vec<Light>, IoError> {
    Ok(open_lights(path)?.for_images(file_names)?.lights)
}

impl StackInput {
    /// As [`read_lights_path`], for the images of this stack; a file without names may have a line
    /// for each of them or for each image found.
    ///
    /// # Errors
    /// Those of [`read_lights_path`].
    pub fn read_lights_path(&self, path: &Path) -> Result<Vec<Light>, IoError> {
        Ok(self.given_lights_path(path, LightAxes::default())?.lights)
    }

    /// As [`StackInput::read_lights_path`], for a file with these axes, and with what there is to
    /// say.
    ///
    /// # Errors
    /// Those of [`read_lights_path`].
    pub fn given_lights_path(&self, path: &Path, axes: LightAxes) -> Result<GivenLights, IoError> {
        open_lights(path)?.with_axes(axes).for_input(self)
    }
}

fn open_lights(path: &Path) -> Result<LightFile, IoError> {
    let lights = LightFile::parse(&display(path), &read_file(path, MAX_TEXT_BYTES)?)?;
    let sibling = path.with_file_name("light_intensities.txt");
    if file_name(path) != "light_directions.txt" || !sibling.is_file() {
        return Ok(lights);
    }
    lights.with_intensities(&display(&sibling), &read_file(&sibling, MAX_TEXT_BYTES)?)
}
