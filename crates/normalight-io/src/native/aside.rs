//! What is written aside before it takes its name, and what is left of it where the writer was killed.
//!
//! Whoever writes holds a lock on a file, which the system lets go when the process ends, however it ends: what nobody
//! holds is a leftover.
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// How names of what is written aside begin: hidden, and of use to nobody.
const PREFIX: &str = ".normalight-";

/// What the name of a folder aside has after that of the file which is locked for it.
const FOLDER: &str = ".folder";

/// A file to fill before it takes its place in `folder`; it goes when dropped.
///
/// # Errors
/// A folder in which no file can be made.
pub(super) fn new_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    // Temporary files are private by default; results are not, beyond what the umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    loop {
        let file = builder.tempfile_in(folder)?;
        // File systems without locks have none to respect either: nothing is swept there.
        let _ = file.as_file().lock();
        // Somebody who swept between the two lines took it for a leftover.
        if file.path().exists() {
            return Ok(file);
        }
    }
}

/// A folder to fill before it takes its place; it goes when dropped, with all in it.
#[derive(Debug)]
pub(super) struct FolderAside {
    path: PathBuf,
    /// Held as long as the folder is in use.
    _lock: NamedTempFile,
}

impl FolderAside {
    /// In `folder`.
    ///
    /// # Errors
    /// A folder in which nothing can be made.
    pub(super) fn new(folder: &Path) -> io::Result<Self> {
        let lock = new_file(folder)?;
        let mut path = lock.path().as_os_str().to_owned();
        path.push(FOLDER);
        let path = PathBuf::from(path);
        fs::create_dir(&path)?;
        Ok(Self { path, _lock: lock })
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for FolderAside {
    fn drop(&mut self) {
        // What stays behind goes with the next sweep.
        let _ = fs::remove_dir_all(&self.path);
    }
}

/// Takes away what killed processes left half written in a folder. What cannot be removed does no harm and stays.
pub fn sweep_leftovers(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let ours = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(PREFIX));
    for path in ours.map(|entry| entry.path()) {
        if path.is_dir() {
            if !is_held(&lock_of(&path)) {
                let _ = fs::remove_dir_all(&path);
            }
        } else if !is_held(&path) {
            let _ = fs::remove_file(&path);
        }
    }
}

/// The file that is locked while this folder is in use.
fn lock_of(folder: &Path) -> PathBuf {
    match folder.extension() {
        Some(_) if folder.to_string_lossy().ends_with(FOLDER) => folder.with_extension(""),
        _ => folder.to_owned(),
    }
}

/// Whether somebody holds this file, or that cannot be known. Nobody holds one that is not there.
fn is_held(path: &Path) -> bool {
    match File::open(path) {
        Ok(file) => file.try_lock().is_err(),
        Err(error) => error.kind() != io::ErrorKind::NotFound,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.collect()
    }

    #[test]
    fn leftovers_go_and_what_is_in_use_stays() {
        let place = tempfile::tempdir().unwrap();
        let (file, folder) = (
            new_file(place.path()).unwrap(),
            FolderAside::new(place.path()).unwrap(),
        );
        fs::write(folder.path().join("half"), "x").unwrap();
        // As a killed process leaves them: nobody holds a lock.
        let left = place.path().join(".normalight-killed");
        fs::write(&left, "half").unwrap();
        let left_folder = place.path().join(".normalight-dead.folder");
        fs::create_dir(&left_folder).unwrap();
        fs::write(left_folder.join("half"), "x").unwrap();
        fs::write(place.path().join("result.png"), "whole").unwrap();
        sweep_leftovers(place.path());
        assert!(!left.exists() && !left_folder.exists());
        assert!(file.path().exists() && folder.path().join("half").exists());
        drop((file, folder));
        assert_eq!(names(place.path()), ["result.png"]);
        sweep_leftovers(place.path());
        assert_eq!(names(place.path()), ["result.png"]);
    }
}
