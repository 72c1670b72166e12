use super::aside::{new_file, sweep_leftovers};
use super::files::display;
use crate::IoError;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A folder for results, made and tried out before the work that leads to them.
///
/// Dropped without results, it takes the folders it made away again.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
    /// Folders that were not there before, innermost first.
    made: Vec<PathBuf>,
}

impl OutputFolder {
    /// Makes the folder when it is missing, takes away what killed processes left half written in it, and tries whether a
    /// file can be made there.
    ///
    /// # Errors
    /// [`IoError::Write`] naming the folder.
    pub fn prepare(path: &Path) -> Result<Self, IoError> {
        // The empty path is the current folder to some calls and nothing to others.
        let path = if path.as_os_str().is_empty() {
            Path::new(".")
        } else {
            path
        };
        let missing = path
            .ancestors()
            .take_while(|folder| !folder.as_os_str().is_empty() && !folder.exists());
        let folder = Self {
            path: path.to_owned(),
            made: missing.map(Path::to_owned).collect(),
        };
        fs::create_dir_all(path)
            .and_then(|()| new_file(path))
            .map_err(|reason| write_error(path, reason))?;
        sweep_leftovers(path);
        Ok(folder)
    }

    /// Writes files (name, content) into the folder. Names must be plain file names.
    ///
    /// All files are first written aside in the same folder and then renamed in the given order, so
    /// a failed or interrupted run leaves no half-written file under a final name. Existing files
    /// are replaced, but only once all new ones are complete.
    ///
    /// # Errors
    /// [`IoError::Write`] naming the folder or the file.
    pub fn write<N, B>(self, files: &[(N, B)]) -> Result<(), IoError>
    where
        N: AsRef<str>,
        B: AsRef<[u8]>,
    {
        let mut written = Vec::with_capacity(files.len());
        for (name, bytes) in files {
            let path = self.path.join(name.as_ref());
            let refused = |kind, reason: &str| write_error(&path, io::Error::new(kind, reason));
            if path.file_name() != Some(name.as_ref().as_ref()) {
                let kind = io::ErrorKind::InvalidInput;
                return Err(refused(kind, "a plain file name is expected"));
            }
            if path.is_dir() {
                return Err(refused(io::ErrorKind::IsADirectory, "it is a folder"));
            }
            let mut aside =
                new_file(&self.path).map_err(|reason| write_error(&self.path, reason))?;
            aside
                .write_all(bytes.as_ref())
                .and_then(|()| aside.as_file().sync_all())
                .map_err(|reason| write_error(&path, reason))?;
            written.push((aside, path));
        }
        for (aside, path) in written {
            aside
                .persist(&path)
                .map_err(|error| write_error(&path, error.error))?;
        }
        Ok(())
    }
}

impl Drop for OutputFolder {
    fn drop(&mut self) {
        for folder in &self.made {
            // Fails on folders with something in them, and so keeps all results.
            if fs::remove_dir(folder).is_err() {
                break;
            }
        }
    }
}

/// Writes files into a folder at once, see [`OutputFolder`].
///
/// # Errors
/// Those of [`OutputFolder::prepare`] and [`OutputFolder::write`].
pub fn write_files<N, B>(folder: &Path, files: &[(N, B)]) -> Result<(), IoError>
where
    N: AsRef<str>,
    B: AsRef<[u8]>,
{
    OutputFolder::prepare(folder)?.write(files)
}

pub(crate) fn write_error(path: &Path, reason: io::Error) -> IoError {
    IoError::Write {
        name: display(path),
        reason,
    }
}
