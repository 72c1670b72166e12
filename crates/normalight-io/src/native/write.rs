use super::files::display;
use crate::IoError;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use tempfile::NamedTempFile;

/// Writes files (name, content) into a folder, which is made when missing. Names must be plain
/// file names.
///
/// All files are first written aside in the same folder and then renamed, so an interrupted run
/// leaves no half-written file under a final name. Existing files are replaced.
///
/// # Errors
/// [`IoError::Write`] naming the folder or the file.
pub fn write_files<N, B>(folder: &Path, files: &[(N, B)]) -> Result<(), IoError>
where
    N: AsRef<str>,
    B: AsRef<[u8]>,
{
    fs::create_dir_all(folder).map_err(|reason| write_error(folder, reason))?;
    let mut written = Vec::with_capacity(files.len());
    for (name, bytes) in files {
        let path = folder.join(name.as_ref());
        if path.file_name() != Some(name.as_ref().as_ref()) {
            let plain = "a plain file name is expected";
            let reason = io::Error::new(io::ErrorKind::InvalidInput, plain);
            return Err(write_error(&path, reason));
        }
        let mut aside = new_temporary(folder).map_err(|reason| write_error(folder, reason))?;
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

fn new_temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".normalight-");
    // Temporary files are private by default; results are not, beyond what the umask says.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn write_error(path: &Path, reason: io::Error) -> IoError {
    IoError::Write {
        name: display(path),
        reason,
    }
}
