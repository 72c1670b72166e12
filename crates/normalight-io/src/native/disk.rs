//! Files on a disk, as an input.
use super::below::look_below;
use super::files::{display, file_name, read_error, read_file};
use crate::IoError;
use crate::archive::Source;
use crate::limits::Limits;
use crate::source::{FileSource, LooseFiles};
use crate::text::read_text;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

/// Files of a folder, or files that were given.
pub(super) struct DiskFiles {
    pub(super) paths: Vec<PathBuf>,
    names: Vec<String>,
    limits: Limits,
    /// The folder, when all of its files are meant.
    folder: Option<PathBuf>,
}

impl DiskFiles {
    pub(super) fn new(paths: Vec<PathBuf>, limits: Limits) -> Self {
        Self {
            names: names_of(&paths),
            paths,
            limits,
            folder: None,
        }
    }

    pub(super) fn of_folder(folder: PathBuf, paths: Vec<PathBuf>, limits: Limits) -> Self {
        Self {
            folder: Some(folder),
            ..Self::new(paths, limits)
        }
    }
}

/// Names of the files, with as many of their folders as tell those of one name apart.
fn names_of(paths: &[PathBuf]) -> Vec<String> {
    let names: Vec<String> = paths.iter().map(|path| file_name(path)).collect();
    let mut sorted: Vec<&String> = names.iter().collect();
    sorted.sort();
    if sorted.windows(2).all(|pair| pair[0] != pair[1]) {
        return names;
    }
    let shared = |path: &Path| {
        let mut folders = path.ancestors().skip(1).map(Path::to_owned);
        folders.find(|folder| paths.iter().all(|other| other.starts_with(folder)))
    };
    let shared = paths.first().and_then(|first| shared(first));
    let below = |path: &PathBuf| {
        let rest = shared
            .as_ref()
            .and_then(|shared| path.strip_prefix(shared).ok());
        display(rest.unwrap_or(path))
    };
    paths.iter().map(below).collect()
}

impl FileSource for DiskFiles {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn label(&self, index: usize) -> String {
        display(&self.paths[index])
    }

    fn text(&mut self, index: usize) -> Result<String, IoError> {
        let bytes = read_file(&self.paths[index], self.limits.text_bytes)?;
        read_text(&self.names[index], &bytes)
    }

    fn take(&mut self, index: usize) -> Result<Vec<u8>, IoError> {
        read_file(&self.paths[index], self.limits.file_bytes)
    }

    fn head(&mut self, index: usize, length: usize) -> Result<Vec<u8>, IoError> {
        let path = &self.paths[index];
        let mut head = Vec::new();
        // What a pipe has given is gone.
        if path.is_file() {
            File::open(path)
                .and_then(|file| file.take(length as u64).read_to_end(&mut head))
                .map_err(|reason| read_error(path, reason))?;
        }
        Ok(head)
    }
}

impl LooseFiles for DiskFiles {
    fn open(&mut self, index: usize) -> Result<Box<dyn Source>, IoError> {
        let path = &self.paths[index];
        let file = File::open(path).map_err(|reason| read_error(path, reason))?;
        Ok(Box::new(BufReader::new(file)))
    }

    fn look(&mut self, index: usize, at: &mut dyn FnMut(&[u8])) -> Result<(), IoError> {
        at(&read_file(&self.paths[index], self.limits.file_bytes)?);
        Ok(())
    }

    fn look_elsewhere(&self) -> Result<(), IoError> {
        self.folder.as_deref().map_or(Ok(()), look_below)
    }
}
