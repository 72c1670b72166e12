//! Files and folders: the only part of this crate that touches the file system.
use crate::format::{READ_FORMATS, format_of_extension, split_extension};
use crate::limits::{MAX_FILE_BYTES, MAX_TEXT_BYTES};
use crate::plan::{find_list, plan_stack};
use crate::stack::{assemble, read_text};
use crate::{
    IoError, NamedBytes, StackInput, StackOptions, combine_lights, parse_directions,
    parse_intensities,
};
use normalight_core::Light;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Reads a stack: one folder, or several image files. One file is in memory at a time.
///
/// In a folder, files that are no images are ignored and a list or a mask counts, see
/// [`plan_stack`]. A file that is given must be an image.
///
/// # Errors
/// Those of [`read_stack`](crate::read_stack), [`IoError::Read`], and [`IoError::NotAnImage`] for a
/// given file that is none.
pub fn read(paths: &[PathBuf], options: StackOptions) -> Result<StackInput, IoError> {
    if let [folder] = paths
        && folder.is_dir()
    {
        return read_folder(folder, options);
    }
    for path in paths {
        fs::metadata(path).map_err(|source| read_error(path, source))?;
        let name = display(path);
        let found = if path.is_dir() {
            "a folder among several paths".to_owned()
        } else if format_of_extension(&name).is_none() {
            format!("a file with extension {:?}", split_extension(&name).1)
        } else {
            continue;
        };
        return Err(IoError::NotAnImage {
            name,
            found,
            expected: READ_FORMATS,
        });
    }
    let names: Vec<String> = paths.iter().map(|path| file_name(path)).collect();
    let plan = plan_stack(&names, None)?;
    assemble("the given files", &names, plan, options, |index| {
        read_file(&paths[index], MAX_FILE_BYTES)
    })
}

fn read_folder(folder: &Path, options: StackOptions) -> Result<StackInput, IoError> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(|source| read_error(folder, source))? {
        let path = entry.map_err(|source| read_error(folder, source))?.path();
        if path.is_file() {
            paths.push(path);
        }
    }
    // The system hands names out in any order.
    paths.sort();
    let names: Vec<String> = paths.iter().map(|path| file_name(path)).collect();
    let list = find_list(&names, |index| {
        let bytes = read_file(&paths[index], MAX_TEXT_BYTES)?;
        read_text(&names[index], &bytes)
    })?;
    let list_path = list.as_ref().map(|(index, _)| display(&paths[*index]));
    let list = list_path
        .as_deref()
        .zip(list.as_ref().map(|(_, text)| text.as_str()));
    let plan = plan_stack(&names, list)?;
    assemble(&display(folder), &names, plan, options, |index| {
        read_file(&paths[index], MAX_FILE_BYTES)
    })
}

/// Reads a file as [`NamedBytes`], for example a mask that was given.
///
/// # Errors
/// [`IoError::Read`] or [`IoError::FileTooLarge`].
pub fn read_named(path: &Path) -> Result<NamedBytes, IoError> {
    Ok(NamedBytes {
        name: file_name(path),
        bytes: read_file(path, MAX_FILE_BYTES)?,
    })
}

/// Reads a light file, see [`read_lights`](crate::read_lights); a file `light_directions.txt` is
/// completed by `light_intensities.txt` beside it when there is one.
///
/// # Errors
/// [`IoError::Read`], [`IoError::LightCount`] or [`IoError::LightFormat`].
pub fn read_lights(
    path: &Path,
    expected_count: usize,
    file_names: &[String],
) -> Result<Vec<Light>, IoError> {
    let bytes = read_file(path, MAX_TEXT_BYTES)?;
    let name = display(path);
    let sibling = path.with_file_name("light_intensities.txt");
    if file_name(path) != "light_directions.txt" || !sibling.is_file() {
        return crate::read_lights(&name, &bytes, expected_count, file_names);
    }
    let directions = parse_directions(&name, &bytes)?;
    if directions.len() != expected_count {
        return Err(IoError::LightCount {
            name,
            found: directions.len(),
            expected: expected_count,
        });
    }
    let sibling_name = display(&sibling);
    let intensities = parse_intensities(&sibling_name, &read_file(&sibling, MAX_TEXT_BYTES)?)?;
    combine_lights(&directions, &sibling_name, &intensities)
}

/// Writes files into a folder, which is made when missing. Names must be plain file names.
///
/// All files are first written aside in the same folder and then renamed, so an interrupted run
/// leaves no half-written file under a final name. Existing files are replaced.
///
/// # Errors
/// [`IoError::Write`] naming the folder or the file.
pub fn write_files(folder: &Path, files: &[NamedBytes]) -> Result<(), IoError> {
    fs::create_dir_all(folder).map_err(|source| write_error(folder, source))?;
    let mut written = Vec::with_capacity(files.len());
    for NamedBytes { name, bytes } in files {
        let path = folder.join(name);
        if path.file_name() != Some(name.as_ref()) {
            let plain = "a plain file name is expected";
            let source = std::io::Error::new(std::io::ErrorKind::InvalidInput, plain);
            return Err(write_error(&path, source));
        }
        let mut aside = new_temporary(folder).map_err(|source| write_error(folder, source))?;
        aside
            .write_all(bytes)
            .and_then(|()| aside.as_file().sync_all())
            .map_err(|source| write_error(&path, source))?;
        written.push((aside, path));
    }
    for (aside, path) in written {
        aside
            .persist(&path)
            .map_err(|error| write_error(&path, error.error))?;
    }
    Ok(())
}

fn new_temporary(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".normalight-");
    // Temporary files are private by default; results are not, beyond what the umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

pub(crate) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, IoError> {
    let failed = |source| read_error(path, source);
    let file = fs::File::open(path).map_err(failed)?;
    let found = file.metadata().map_err(failed)?.len();
    let too_large = |found| IoError::FileTooLarge {
        name: display(path),
        found,
        limit,
    };
    if found > limit {
        return Err(too_large(found));
    }
    let mut bytes = Vec::with_capacity(found as usize);
    // Pipes and growing files do not tell their size.
    file.take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(too_large(bytes.len() as u64));
    }
    Ok(bytes)
}

pub(crate) fn display(path: &Path) -> String {
    path.display().to_string()
}

fn file_name(path: &Path) -> String {
    path.file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

fn read_error(path: &Path, source: std::io::Error) -> IoError {
    IoError::Read {
        name: display(path),
        source,
    }
}

fn write_error(path: &Path, source: std::io::Error) -> IoError {
    IoError::Write {
        name: display(path),
        source,
    }
}
